#include <algorithm>
#include <filesystem>

#include "base/output_file.h"
#include "gui/panels.h"

namespace talus::gui {
namespace {

namespace fs = std::filesystem;

struct Entry {
  std::string label, path;
  bool folder = false;
};

/// Returns the folders, runs and scenarios in a folder, folders first, sorted by name.
std::vector<Entry> entries_of(const fs::path& folder) {
  std::vector<Entry> entries = {{"..", folder.parent_path().string(), true}};
  std::error_code ignored;
  for (fs::directory_iterator at(folder, ignored), end; !ignored && at != end; at.increment(ignored)) {
    const fs::path& path = at->path();
    const std::string name = path.filename().string();
    const bool is_folder = at->is_directory(ignored) && path.extension() != ".run";
    const bool is_run =
        path.extension() == ".h5" || path.extension() == ".run" || path.extension() == ".toml";
    if (!name.starts_with('.') && (is_folder || is_run))
      entries.push_back({is_folder ? name + "/" : name, path.string(), is_folder});
  }
  std::ranges::sort(entries.begin() + 1, entries.end(), [](const Entry& a, const Entry& b) {
    return a.folder != b.folder ? a.folder : a.label < b.label;
  });
  return entries;
}

void draw_browser(Gui& gui) {
  ImGui::TextWrapped("Open a run or a scenario: choose it, or drop it on the window.");
  ImGui::BeginChild("files", {0.0f, 12.0f * gui.em}, true);
  for (const Entry& entry :
       entries_of(gui.state.folder.empty() ? fs::path(resolved_path(".")) : fs::path(gui.state.folder))) {
    if (ImGui::Selectable(entry.label.c_str())) {
      if (entry.folder)
        gui.state.folder = entry.path;
      else
        gui.requests.open_path = entry.path;
    }
    note_place(gui, "file " + entry.label);
  }
  ImGui::EndChild();
}

}  // namespace

void draw_file_panel(Gui& gui) {
  draw_browser(gui);
  ImGui::Separator();
  ImGui::SetNextItemWidth(-1.0f);
  named_text(gui, "picture path", "", gui.state.picture_path, "PNG file to write");
  if (named_button(gui, "save picture", "Save picture", "the map as talus render draws it")) {
    if (gui.state.picture_path.empty())
      gui.state.message = "Give the picture a name first.";
    else
      gui.requests.save_png_path = gui.state.picture_path;
  }
  if (gui.model.is_live()) {
    ImGui::Separator();
    if (gui.model.recording().output.empty()) {
      ImGui::SetNextItemWidth(-1.0f);
      named_text(gui, "run path", "", gui.state.run_path,
                 "run file to write, in which the run is then recorded");
    }
    if (named_button(gui, "save state", "Save state",
                     "saves the entire run, so that it can be continued later: s"))
      save_state(gui);
  }
  std::string command = gui.model.render_command();
  if (command.empty()) {
    ImGui::TextDisabled("Once it is saved, talus render can draw it.");
    return;
  }
  ImGui::Separator();
  ImGui::TextWrapped("This picture from the command line:");
  ImGui::TextWrapped("%s", command.c_str());
  if (named_button(gui, "copy command", "Copy")) ImGui::SetClipboardText(command.c_str());
}

}  // namespace talus::gui
