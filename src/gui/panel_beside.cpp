#include <algorithm>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "gui/actions.h"
#include "gui/panels.h"

namespace talus {
namespace {

constexpr PlotAxis clocks[] = {PlotAxis::tilt, PlotAxis::angle_left, PlotAxis::time};

/// By what runs are linked.
std::string clock_name(PlotAxis clock) {
  switch (clock) {
    case PlotAxis::tilt:
      return "θ";
    case PlotAxis::angle_left:
      return "θc − θ";
    case PlotAxis::time:
      return "t";
  }
  return {};
}

void choose_map_beside(Gui& gui) {
  BesideState& beside = gui.model.state.beside;
  std::vector<std::string> names = {"as the first"};
  int chosen = 0;
  const auto kinds = map_kinds();
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    names.emplace_back(map_name(kinds[k]));
    if (!beside.layers.empty() && beside.layers[0] == kinds[k]) chosen = static_cast<int>(k) + 1;
  }
  if (!named_choice(gui, "beside map", "its map", names, chosen)) return;
  beside.layers.clear();
  if (chosen > 0) beside.layers = {kinds[static_cast<std::size_t>(chosen - 1)]};
}

void choose_minus(Gui& gui) {
  BesideState& beside = gui.model.state.beside;
  bool minus = beside.minus.has_value();
  if (named_checkbox(gui, "beside minus", "minus the frame at an angle", minus,
                     "what has changed since: its grains, and contacts gained and lost; D begins here"))
    beside.minus = minus ? std::optional(gui.model.frame().tilt) : std::nullopt;
  if (!beside.minus) return;
  double angle = degrees(*beside.minus);
  if (named_slider(gui, "beside minus angle", "since", angle, 0.0, 60.0, "%.2f°"))
    beside.minus = radians(angle);
}

void choose_run_beside(Gui& gui) {
  ViewModel& model = gui.model;
  BesideState& beside = model.state.beside;
  if (model.is_live()) return;
  if (model.run_beside() == nullptr) {
    named_text(gui, "beside path", "run", beside.path, "run file to show beside this one");
    if (!beside.path.empty() && named_button(gui, "open beside", "Open beside")) show_run_beside(gui);
    return;
  }
  if (named_button(gui, "close beside", "This run again", "the second view is of the first run"))
    return model.close_beside();
  std::vector<std::string> names;
  int chosen = 0;
  for (const PlotAxis clock : clocks) {
    if (!model.has_clock(clock)) continue;
    if (beside.clock == clock) chosen = static_cast<int>(names.size());
    names.push_back(clock_name(clock));
  }
  if (!named_choice(gui, "beside clock", "linked by", names, chosen)) return;
  for (const PlotAxis clock : clocks)
    if (clock_name(clock) == names[static_cast<std::size_t>(chosen)]) beside.clock = clock;
}

}  // namespace

void choose_beside(Gui& gui) {
  named_checkbox(gui, "beside", "a second view", gui.model.state.beside.shown,
                 "another map, another run, or what has changed: P");
  if (!gui.model.state.beside.shown) return;
  choose_map_beside(gui);
  choose_minus(gui);
  choose_run_beside(gui);
}

void show_run_beside(Gui& gui) {
  try {
    gui.model.open_beside(gui.model.state.beside.path);
  } catch (const Error& error) {
    gui.model.state.message = error.what();
  }
}

}  // namespace talus
