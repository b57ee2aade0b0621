#pragma once
/// A report as data: headings, paragraphs, tables and pictures, written as one HTML page that needs nothing
/// beside it.

#include <string>
#include <variant>
#include <vector>

#include "base/text_table.h"

namespace talus::studies {

struct ReportHeading {
  int level = 2;
  std::string text;
};
/// Links to all headings of level 2.
struct ReportContents {};
struct ReportParagraph {
  std::string text;
};
struct ReportList {
  std::vector<std::string> items;
};
struct ReportCommands {
  std::vector<std::string> lines;
};
struct ReportPicture {
  std::string file;  ///< a PNG, by its path from the report's folder
  std::string title;
  std::string caption;
  bool wide = false;  ///< over the whole width of the page
};

using ReportBlock = std::variant<ReportHeading, ReportContents, ReportParagraph, ReportList, ReportCommands,
                                 TextTable, ReportPicture>;

/// Texts are plain; `words between backticks` are set as code.
struct ReportDocument {
  std::string title;
  std::vector<ReportBlock> blocks;
};

/// One page of HTML that needs nothing beside it: pictures are read from `folder` and built in. Throws as
/// read_file does where one cannot be read.
std::string report_html(const ReportDocument& document, const std::string& folder);

}  // namespace talus::studies
