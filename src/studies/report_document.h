#pragma once
/// Report as data (headings, paragraphs, tables and pictures), written as one self-contained HTML page.

#include <string>
#include <variant>
#include <vector>

#include "base/text_table.h"

namespace talus::studies {

struct ReportHeading {
  int level = 2;
  std::string text;
};
/// List of links to all headings of level 2.
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
  std::string file;  ///< path of a PNG relative to the report's folder
  std::string title;
  std::string caption;
  bool wide = false;  ///< spans the whole width of the page
};

using ReportBlock = std::variant<ReportHeading, ReportContents, ReportParagraph, ReportList, ReportCommands,
                                 TextTable, ReportPicture>;

/// Title and blocks; texts are plain, and `words between backticks` are set as code.
struct ReportDocument {
  std::string title;
  std::vector<ReportBlock> blocks;
};

/// Writes one self-contained HTML page, with the pictures of `folder` built in. Throws as read_file does if a
/// picture cannot be read.
std::string report_html(const ReportDocument& document, const std::string& folder);

}  // namespace talus::studies
