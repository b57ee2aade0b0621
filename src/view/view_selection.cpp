#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "core/errors.h"
#include "io/durable_file.h"
#include "runs/event_catalogue.h"
#include "view/selection_table.h"
#include "view/view_data.h"

namespace talus {

GrainSource ViewModel::Data::grain_source(const MapSettings& settings) {
  if (!first_frame) {
    if (replay)
      first_frame = read(0);
    else if (!recorded->all().empty())
      first_frame = recorded->all().front();
  }
  const OverloadRule& rule = settings;
  if (grain_values.frame != frame || !(grain_values.rule == rule)) grain_values = {frame, rule, {}, {}};
  if (!grain_values.judged) {
    const double threshold = threshold_of(rule);
    const std::vector<double> length =
        coarse_graining({*frame, statics()}, {.threshold = threshold,
                                              .end_ratio = threshold,
                                              .l_min = l_min * statics().mean_diameter,
                                              .cut = length_cut(statics(), l_min)})
            .length;
    grain_values.judged = {.lc = {length.begin(), length.end()}, .cluster = shown_clusters(settings).label};
  }
  return {{*stored, statics()}, 0, frame->gamma, first_frame.get(), {}, {&*grain_values.judged, 1}};
}

const std::vector<double>& ViewModel::Data::values_of_grains(const GrainNumber& number,
                                                             const ViewState& asked) {
  const GrainSource source = grain_source(map_settings(asked));
  const auto [place, fresh] = grain_values.of.try_emplace(number.name);
  if (fresh) place->second = values_of(number, source);
  return place->second;
}

SelectionMarks ViewModel::Data::selection_marks(const ViewState& asked) const {
  const Selection& selection = asked.selecting.selection;
  SelectionMarks marks;
  for (const Index grain : selection.grains)
    if (grain < frame->grain_count()) marks.grains.push_back(grain);
  if (selection.contact) marks.contact = contact_of_key(frame->contacts, *selection.contact);
  marks.trails = shown_trails(asked);
  return marks;
}

double ViewModel::Data::friction_at(std::int64_t step) const {
  double friction = statics().friction;
  // A branch goes on with what commands had set before it.
  if (const auto& origin = replay ? pictures.run.branch : branch)
    friction = find_value(origin->start.reals, "friction").value_or(friction);
  for (const Command& command : commands)
    if (command.kind == CommandKind::friction && command.step < step) friction = command.x;
  return friction;
}

bool ViewModel::Data::follow_history(const ViewState& asked) {
  const SelectingState& selecting = asked.selecting;
  HistoryQuestion question = {{}, selecting.selection.contact};
  if (selecting.trails) {
    question.grains = selecting.selection.grains;
    if (question.grains.empty() && asked.selected) question.grains = {*asked.selected};
    question.grains = thinned(question.grains, most_trails);
  }
  if (question == HistoryQuestion{} || frame_count() == 0) {
    history.reset();
    return false;
  }
  if (!history) {
    if (replay)
      history = std::make_unique<HistorySeries>([from = frames](std::size_t k) { return from->read(k); });
    else
      history = std::make_unique<HistorySeries>([from = recorded](std::size_t k) { return from->read(k); });
  }
  history->ask(question, frame_count());
  return history->take_in();
}

std::vector<std::vector<Vec2>> ViewModel::Data::shown_trails(const ViewState& asked) const {
  std::vector<std::vector<Vec2>> trails;
  if (!asked.selecting.trails || !history) return trails;
  const std::vector<HistoryInstant>& instants = history->instants();
  trails.resize(history->question().grains.size());
  const double period = statics().periodic ? statics().length : 0.0;
  for (std::size_t k = 0; k < instants.size() && instants[k].step <= frame->step; ++k)
    for (std::size_t i = 0; i < trails.size(); ++i) {
      const GrainPlace& place = instants[k].places[i];
      if (std::isfinite(place.x)) trails[i].push_back({place.x + place.image * period, place.y});
    }
  return trails;
}

std::optional<ContactInspection> ViewModel::contact_inspection() const {
  const std::optional<ContactKey>& contact = state.selecting.selection.contact;
  if (!contact) return std::nullopt;
  return inspect_contact({*data_->frame, data_->statics()}, *contact, data_->friction_at(data_->frame->step));
}

std::vector<Plot> ViewModel::contact_history() const {
  if (!data_->history || !data_->history->question().contact) return {};
  const std::vector<HistoryInstant>& instants = data_->history->instants();
  std::vector<double> friction;
  for (const HistoryInstant& at : instants)
    friction.push_back(at.with_wall ? statics().wall_friction : data_->friction_at(at.step));
  const double weight = mean_grain_mass(data_->all_statics) * statics().gravity;
  return contact_plots(instants, friction, weight, data_->abscissa());
}

void ViewModel::follow_grain() {
  if (!state.selecting.follow || !state.selected || *state.selected >= frame().grain_count()) return;
  const auto i = static_cast<std::size_t>(*state.selected);
  state.camera.centre_x = frame().x[i];
  state.camera.centre_y = frame().y[i];
}

void ViewModel::select(std::optional<Index> grain) {
  state.selected = grain;
  state.selecting.selection = {};
  state.selecting.in_each_frame = false;
}

void ViewModel::select(std::vector<Index> grains) {
  state.selecting.selection = {};
  if (grains.size() == 1) state.selected = grains.front();
  if (state.selected && !std::ranges::binary_search(grains, *state.selected)) state.selected.reset();
  if (grains.size() > 1) state.selecting.selection.grains = std::move(grains);
}

void ViewModel::select(const ContactKey& contact) {
  select(std::optional<Index>());
  state.selecting.selection.contact = contact;
}

std::vector<Index> ViewModel::selected_grains() const {
  std::vector<Index> grains = state.selecting.selection.grains;
  if (grains.empty() && state.selected) grains = {*state.selected};
  std::erase_if(grains, [this](Index i) { return i < 0 || i >= data_->frame->grain_count(); });
  return grains;
}

void ViewModel::select_found(const std::vector<Index>& found) {
  state.selecting.in_each_frame = false;
  select(combined(selected_grains(), found, state.selecting.mode));
}

void ViewModel::select_by_condition() {
  SelectingState& selecting = state.selecting;
  selecting.error.clear();
  try {
    std::vector<Index> found;
    if (selecting.condition.find_first_not_of(" \t") != std::string::npos) {
      const Expression condition = parse_condition(selecting.condition, grain_names());
      found = grains_where(condition, data_->grain_source(data_->map_settings(state)));
      if (!condition.names.empty() && !selecting.in_each_frame) selecting.quantity = condition.names.front();
    }
    const SelectionMode mode = selecting.in_each_frame ? SelectionMode::anew : selecting.mode;
    select(combined(selected_grains(), found, mode));
    data_->condition_frame = data_->frame;
  } catch (const Error& error) {
    selecting.error = error.what();
    selecting.in_each_frame = false;
  }
}

std::vector<Index> ViewModel::grains_within(std::span<const Vec2> outline) const {
  return talus::grains_within({*data_->frame, data_->statics()}, outline);
}

std::optional<ContactKey> ViewModel::contact_at(double x, double y, double reach) const {
  const auto found = find_contact({*data_->frame, data_->statics()}, x, y, reach);
  return found ? std::optional(key_of(data_->frame->contacts, *found)) : std::nullopt;
}

const std::vector<double>& ViewModel::grain_values(const GrainNumber& number) const {
  return data_->values_of_grains(number, state);
}

void ViewModel::write_selected(const std::string& path) {
  const std::vector<Index> grains = selected_grains();
  if (grains.empty() || path.empty()) {
    state.message = grains.empty() ? "Select grains to write first." : "Give the table a name first.";
    return;
  }
  try {
    output_target(path, {.overwrite = false});
    std::vector<GrainColumn> columns;
    for (const GrainNumber& number : grain_numbers()) columns.push_back({number, grain_values(number)});
    write_text(path, grains_table(frame(), grains, columns));
    state.message = fmt::format("written: {}, {} grains", path, grains.size());
  } catch (const Error& error) {
    state.message = error.what();
  }
}

}  // namespace talus
