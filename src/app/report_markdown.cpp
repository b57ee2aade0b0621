#include "app/report_document.h"

namespace talus {
namespace {

/// Text as Markdown shows it: characters that would end a cell or begin a tag are escaped outside of code.
std::string escaped(const std::string& text) {
  std::string result;
  bool code = false;
  for (const char c : text) {
    if (c == '`') code = !code;
    if (!code && (c == '|' || c == '<' || c == '*' || c == '_')) result += '\\';
    result += c;
  }
  return result;
}

std::string cell_text(const ReportCell& cell) {
  if (cell.note.empty()) return escaped(cell.text);
  std::string note = escaped(cell.note);
  if (cell.tone == Tone::good) note = std::string("**").append(note).append("**");
  return cell.text.empty() ? note : escaped(cell.text).append("; ").append(note);
}

std::string row_text(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text.append(" ").append(cell).append(" |");
  return text + "\n";
}

std::string block_text(const ReportHeading& heading) {
  return std::string(static_cast<std::size_t>(heading.level), '#') + " " + escaped(heading.text) + "\n";
}

std::string block_text(const ReportParagraph& paragraph) { return escaped(paragraph.text) + "\n"; }

std::string block_text(const ReportList& list) {
  std::string text;
  for (const std::string& item : list.items) text.append("- ").append(escaped(item)).append("\n");
  return text;
}

std::string block_text(const ReportCommands& commands) {
  std::string text;
  for (const std::string& line : commands.lines) text.append("    ").append(line).append("\n");
  return text;
}

std::string block_text(const ReportTable& table) {
  std::vector<std::string> titles, rules;
  for (const ReportTable::Column& column : table.columns) {
    titles.push_back(escaped(column.title));
    rules.emplace_back(column.numbers ? "--:" : "---");
  }
  std::string text = row_text(titles) + row_text(rules);
  for (const auto& row : table.rows) {
    std::vector<std::string> cells;
    for (const ReportCell& cell : row) cells.push_back(cell_text(cell));
    text += row_text(cells);
  }
  return text;
}

std::string block_text(const ReportPicture& picture) {
  return "![" + escaped(picture.title) + "](" + picture.file + ")\n\n**" + escaped(picture.title) + ".** " +
         escaped(picture.caption) + "\n";
}

}  // namespace

std::string report_markdown(const ReportDocument& document) {
  std::string text = std::string("# ").append(escaped(document.title)).append("\n");
  for (const ReportBlock& block : document.blocks)
    text.append("\n").append(std::visit([](const auto& each) { return block_text(each); }, block));
  return text;
}

}  // namespace talus
