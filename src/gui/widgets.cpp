#include <imgui.h>
#include <imgui_stdlib.h>

#include <cfloat>
#include <cmath>
#include <limits>
#include <string>

#include "gui/panels.h"
#include "render/font.h"

namespace talus::gui {
namespace {

void show_tip(const char* tip) {
  if (tip != nullptr && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
}

/// Returns the length in bytes of the UTF-8 character that begins with this byte.
std::size_t character_size(char lead) {
  const auto byte = static_cast<unsigned char>(lead);
  return byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

/// Calls piece(text, is_subscript, size, width) for each piece of a rich text in order; px.
template <typename Piece>
void for_pieces(std::string_view text, const Piece& piece) {
  const auto pass = [&](std::string_view part, bool subscript) {
    const float size = ImGui::GetFontSize() * (subscript ? static_cast<float>(render::subscript_size) : 1.0f);
    const char* const end = part.data() + part.size();
    piece(part, subscript, size, ImGui::GetFont()->CalcTextSizeA(size, 1e9f, 0.0f, part.data(), end).x);
  };
  while (!text.empty()) {
    const std::size_t mark = text.find('_');
    if (mark > 0) pass(text.substr(0, mark), false);
    if (mark == std::string_view::npos || mark + 1 >= text.size()) return;
    const std::size_t character = character_size(text[mark + 1]);
    pass(text.substr(mark + 1, character), true);
    text.remove_prefix(std::min(text.size(), mark + 1 + character));
  }
}

/// Moves the cursor to the column of values, which aligns the rows.
void move_to_value_column() {
  constexpr float share_of_labels = 0.42f;
  const float before = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x;
  const float values = share_of_labels * ImGui::GetWindowContentRegionMax().x;
  ImGui::SameLine(before + ImGui::GetStyle().ItemInnerSpacing.x < values ? values : 0.0f);
}

/// Draws the label of a row, if any; the widget that follows fills the rest of the width.
void begin_row(const char* label, const char* tip) {
  if (*label == '\0') return;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  add_rich_text(*ImGui::GetWindowDrawList(), {corner.x, corner.y + ImGui::GetStyle().FramePadding.y},
                ImGui::GetColorU32(ImGuiCol_Text), label);
  ImGui::Dummy({rich_width(label), ImGui::GetFrameHeight()});
  show_tip(tip);
  move_to_value_column();
  ImGui::SetNextItemWidth(-FLT_MIN);
}

/// Draws a row with its label and the widget of a hidden name; returns whether the user has used it.
template <typename Widget>
bool draw_row(Gui& gui, const char* name, const char* label, const char* tip, const Widget& widget) {
  begin_row(label, tip);
  const bool used = widget(std::string("##").append(name).c_str());
  note_place(gui, name);
  show_tip(tip);
  return used;
}

}  // namespace

void note_place(Gui& gui, std::string name, const ImVec2& low, const ImVec2& high) {
  gui.places.push_back({std::move(name), low.x, low.y, high.x, high.y});
}

void note_place(Gui& gui, std::string name) {
  note_place(gui, std::move(name), ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
}

bool named_button(Gui& gui, const char* name, const char* label, const char* tip) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = rich_width(label);
  const bool pressed =
      ImGui::Button(std::string("##").append(name).c_str(), {width + 2.0f * style.FramePadding.x, 0.0f});
  note_place(gui, name);
  const ImVec2 corner = ImGui::GetItemRectMin();
  add_rich_text(*ImGui::GetWindowDrawList(),
                {corner.x + style.FramePadding.x, corner.y + style.FramePadding.y},
                ImGui::GetColorU32(ImGuiCol_Text), label);
  show_tip(tip);
  return pressed;
}

bool named_checkbox(Gui& gui, const char* name, const char* label, bool& value, const char* tip) {
  const bool changed = ImGui::Checkbox(std::string(label).append("##").append(name).c_str(), &value);
  note_place(gui, name);
  show_tip(tip);
  return changed;
}

bool named_slider(Gui& gui, const char* name, const char* label, double& value, double low, double high,
                  const char* format, const char* tip, bool logarithmic) {
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
  return draw_row(gui, name, label, tip, [&](const char* id) {
    return ImGui::SliderScalar(id, ImGuiDataType_Double, &value, &low, &high, format, flags);
  });
}

std::optional<double> named_slider_when_done(Gui& gui, const char* name, const char* label, double current,
                                             double low, double high, const char* format, const char* tip) {
  // Value while the slider is held; otherwise NaN.
  float& held =
      *ImGui::GetStateStorage()->GetFloatRef(ImGui::GetID(name), std::numeric_limits<float>::quiet_NaN());
  double value = std::isnan(held) ? current : static_cast<double>(held);
  ImGui::BeginGroup();  // includes its label
  named_slider(gui, name, label, value, low, high, format, tip);
  ImGui::EndGroup();
  const bool done = ImGui::IsItemDeactivatedAfterEdit();
  held = ImGui::IsItemActive() ? static_cast<float>(value) : std::numeric_limits<float>::quiet_NaN();
  return done ? std::optional(value) : std::nullopt;
}

bool named_number(Gui& gui, const char* name, const char* label, double& value, const char* format,
                  const char* tip) {
  return draw_row(gui, name, label, tip,
                  [&](const char* id) { return ImGui::InputDouble(id, &value, 0.0, 0.0, format); });
}

bool named_number(Gui& gui, const char* name, const char* label, std::int64_t& value, const char* tip) {
  return draw_row(gui, name, label, tip,
                  [&](const char* id) { return ImGui::InputScalar(id, ImGuiDataType_S64, &value); });
}

bool named_text(Gui& gui, const char* name, const char* label, std::string& value, const char* tip) {
  return draw_row(gui, name, label, tip, [&](const char* id) { return ImGui::InputText(id, &value); });
}

bool named_choice(Gui& gui, const char* name, const char* label, const std::vector<std::string>& texts,
                  int& chosen) {
  bool changed = false;
  begin_row(label, nullptr);
  const bool open =
      ImGui::BeginCombo(std::string("##").append(name).c_str(),
                        texts[static_cast<std::size_t>(chosen)].c_str(), ImGuiComboFlags_HeightLargest);
  note_place(gui, name);
  if (!open) return false;
  for (int k = 0; k < static_cast<int>(texts.size()); ++k) {
    if (ImGui::Selectable(texts[static_cast<std::size_t>(k)].c_str(), k == chosen)) {
      chosen = k;
      changed = true;
    }
    note_place(gui, std::string(name).append(": ").append(texts[static_cast<std::size_t>(k)]));
  }
  if (key_pressed(key_escape, false)) ImGui::CloseCurrentPopup();
  ImGui::EndCombo();
  return changed;
}

float rich_width(std::string_view text) {
  float width = 0.0f;
  for_pieces(text, [&](std::string_view, bool, float, float piece_width) { width += piece_width; });
  return width;
}

std::vector<std::string> wrapped_text(std::string_view text, float width) {
  std::vector<std::string> lines =
      render::broken_lines(text, [width](const std::string& line) { return rich_width(line) <= width; });
  if (lines.empty()) lines.emplace_back();
  return lines;
}

void add_rich_text(ImDrawList& list, const ImVec2& place, ImU32 colour, std::string_view text) {
  ImVec2 pen = place;
  for_pieces(text, [&](std::string_view piece, bool subscript, float size, float width) {
    const ImVec2 at{pen.x, subscript ? pen.y + 0.42f * ImGui::GetFontSize() : pen.y};
    list.AddText(ImGui::GetFont(), size, at, colour, piece.data(), piece.data() + piece.size());
    pen.x += width;
  });
}

void rich_text(std::string_view text) {
  const ImVec2 place = ImGui::GetCursorScreenPos();
  add_rich_text(*ImGui::GetWindowDrawList(), place, ImGui::GetColorU32(ImGuiCol_Text), text);
  ImGui::Dummy({rich_width(text), ImGui::GetTextLineHeight()});
}

void same_line_if_fits(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

void fact(std::string_view label, const std::string& value) {
  rich_text(label);
  move_to_value_column();
  rich_text(value);
}

bool icon_button(Gui& gui, const char* name, const char* icon, const char* tip) {
  const bool pressed =
      ImGui::Button(std::string(icon).append("###").append(name).c_str(), {2.4f * gui.em, 0.0f});
  note_place(gui, name);
  show_tip(tip);
  return pressed;
}

}  // namespace talus::gui
