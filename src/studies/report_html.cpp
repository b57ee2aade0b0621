#include <cctype>
#include <filesystem>
#include <fmt/core.h>

#include "base/base64.h"
#include "io/durable_file.h"
#include "studies/report_document.h"

namespace talus::studies {
namespace {

constexpr const char* style = R"(
:root { color-scheme: light; }
body { font: 15px/1.5 Georgia, "DejaVu Serif", serif; color: #1a1a1a; background: #fff;
  max-width: 74rem; margin: 2rem auto; padding: 0 1.5rem; }
h1, h2, h3 { font-family: "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; line-height: 1.25; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.3rem; margin-top: 2.4rem; border-bottom: 1px solid #ccc; }
h3 { font-size: 1.05rem; margin-top: 1.6rem; }
p, li { max-width: 46rem; }
nav { border: 1px solid #ddd; background: #fafaf8; padding: 0.6rem 1rem; font-size: 0.92rem; max-width: 44rem; }
nav ol { margin: 0; padding-left: 1.4rem; columns: 2; } nav a { color: #1f4e79; text-decoration: none; }
nav a:hover { text-decoration: underline; }
table { border-collapse: collapse; margin: 1rem 0; font-size: 0.86rem; }
div.wide { overflow-x: auto; }
th { text-align: left; vertical-align: bottom; border-bottom: 1.5px solid #444; font-weight: 600; }
td { vertical-align: top; border-bottom: 1px solid #e4e4e4; }
th, td { padding: 0.3rem 0.7rem 0.3rem 0; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; }
.note { display: block; font-size: 0.82em; color: #666; }
.good .note { color: #1b6b35; font-weight: 600; } .bad .note { color: #9a3412; }
.muted { color: #888; }
code, pre { font: 0.86em/1.5 "DejaVu Sans Mono", Consolas, monospace; }
pre { background: #f6f6f4; padding: 0.7rem 1rem; overflow-x: auto; white-space: pre-wrap; }
figure { margin: 1.5rem 0 2rem; } figure img { width: 100%; max-width: 34rem; height: auto; }
figure.wide img { max-width: 100%; }
figcaption { font-size: 0.9rem; max-width: 46rem; }
@page { size: A4 landscape; margin: 12mm; }
@media print {
  body { font-size: 10pt; max-width: none; margin: 0; padding: 0; } div.wide { overflow: visible; }
  table { font-size: 8pt; } tr, figure, pre { break-inside: avoid; } h2, h3 { break-after: avoid; }
}
)";

std::string escaped(const std::string& text) {
  std::string result;
  bool code = false;
  for (const char c : text) {
    if (c == '`') {
      result += code ? "</code>" : "<code>";
      code = !code;
    } else if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

const char* class_of(Tone tone) {
  switch (tone) {
    case Tone::good:
      return "good";
    case Tone::bad:
      return "bad";
    case Tone::muted:
      return "muted";
    case Tone::plain:
      break;
  }
  return "";
}

std::string element(const std::string& tag, const std::string& inside, const std::string& classes) {
  const std::string attribute = classes.empty() ? "" : fmt::format(" class=\"{}\"", classes);
  return fmt::format("<{0}{1}>{2}</{0}>", tag, attribute, inside);
}

std::string cell_html(const TextCell& cell, bool number) {
  std::string classes = number ? "number" : "";
  if (cell.tone != Tone::plain) classes.append(classes.empty() ? "" : " ").append(class_of(cell.tone));
  std::string inside = escaped(cell.text);
  if (!cell.note.empty()) inside += fmt::format("<span class=\"note\">{}</span>", escaped(cell.note));
  return element("td", inside, classes);
}

/// Returns the anchor of a heading: its letters and digits, with hyphens between words.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const unsigned char c : heading)
    if (std::isalnum(c) != 0)
      anchor += static_cast<char>(std::tolower(c));
    else if (!anchor.empty() && anchor.back() != '-')
      anchor += '-';
  return anchor;
}

/// Writes blocks of one document.
struct HtmlWriter {
  const ReportDocument& document;
  const std::string& folder;

  std::string operator()(const ReportHeading& heading) const {
    return fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", heading.level, anchor_of(heading.text),
                       escaped(heading.text));
  }
  std::string operator()(const ReportContents&) const {
    std::string text = "<nav><ol>\n";
    for (const ReportBlock& block : document.blocks)
      if (const auto* heading = std::get_if<ReportHeading>(&block); heading && heading->level == 2)
        text += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", anchor_of(heading->text),
                            escaped(heading->text));
    return text + "</ol></nav>\n";
  }
  std::string operator()(const ReportParagraph& paragraph) const {
    return fmt::format("<p>{}</p>\n", escaped(paragraph.text));
  }
  std::string operator()(const ReportList& list) const {
    std::string text = "<ul>\n";
    for (const std::string& item : list.items) text += fmt::format("<li>{}</li>\n", escaped(item));
    return text + "</ul>\n";
  }
  std::string operator()(const ReportCommands& commands) const {
    std::string text = "<pre>";
    for (const std::string& line : commands.lines) text += escaped(line) + "\n";
    return text + "</pre>\n";
  }
  std::string operator()(const TextTable& table) const {
    std::string text = "<div class=\"wide\"><table>\n<thead><tr>";
    for (const TextColumn& column : table.columns)
      text += element("th", escaped(column.title), column.numbers ? "number" : "");
    text += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
      text += "<tr>";
      for (std::size_t k = 0; k < row.size(); ++k) text += cell_html(row[k], table.columns[k].numbers);
      text += "</tr>\n";
    }
    return text + "</tbody></table></div>\n";
  }
  std::string operator()(const ReportPicture& picture) const {
    const std::vector<std::byte> bytes =
        io::read_file((std::filesystem::path(folder) / picture.file).string());
    const std::string title = escaped(picture.title);
    return fmt::format(
        "<figure{}><img alt=\"{}\" src=\"data:image/png;base64,{}\">\n"
        "<figcaption><strong>{}.</strong> {}</figcaption></figure>\n",
        picture.wide ? " class=\"wide\"" : "", title, base64(bytes), title, escaped(picture.caption));
  }
};

}  // namespace

std::string report_html(const ReportDocument& document, const std::string& folder) {
  std::string text = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  text += fmt::format(
      "<meta name=\"viewport\" content=\"width=device-width, "
      "initial-scale=1\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n<h1>{}</h1>\n",
      escaped(document.title), style, escaped(document.title));
  for (const ReportBlock& block : document.blocks) text += std::visit(HtmlWriter{document, folder}, block);
  return text + "</body>\n</html>\n";
}

}  // namespace talus::studies
