#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "base/errors.h"
#include "io/durable_file.h"
#include "pictures/motion.h"
#include "runs/event_catalogue.h"
#include "view/selection_table.h"
#include "view/view_model.h"

namespace talus::view {

analysis::GrainSource ViewModel::grain_source(bool measured) {
  const View view = first();
  const pictures::MapSettings settings = view.settings();
  const pictures::OverloadRule& rule = settings;
  GrainValuesCache& cache = grain_values_;
  if (cache.frame != frame_ || !(cache.rule == rule) || cache.since != view.since() ||
      cache.length != settings.length)
    cache = {frame_, rule, view.since(), settings.length, {}, {}, {}};
  if (!first_frame_ && frame_count() > 0) first_frame_ = frame_at(0);
  if (!cache.judged) {
    const std::vector<double> length =
        analysis::coarse_graining({*frame_, statics()}, coarse_graining_rule(settings, statics())).length;
    cache.judged = {.lc = {length.begin(), length.end()}, .cluster = shown_clusters(settings).label};
  }
  if (measured) cache.earlier = view.reference();
  analysis::GrainSource source = {{*stored_, statics()}, 0,  frame_->gamma,
                                  first_frame_.get(),    {}, {&*cache.judged, 1}};
  source.earlier = cache.earlier.get();
  source.degrees = pictures::motion_span({source, source.earlier, !cache.since}).degrees;
  source.length = settings.length * mean_diameter();
  return source;
}

const std::vector<double>& ViewModel::grain_values(const analysis::GrainNumber& number) {
  const analysis::GrainSource source =
      grain_source(number.quantity->need == analysis::FrameNeed::earlier_frame);
  const auto [place, fresh] = grain_values_.values.try_emplace(number.name);
  if (fresh) place->second = analysis::values_of(number, source);
  return place->second;
}

Overlay ViewModel::selection_marks() const {
  const Selection& selection = state.selecting.selection;
  Overlay marks;
  for (const Index grain : selection.grains)
    if (grain < frame_->grain_count()) marks.grains.push_back(grain);
  if (selection.contact) marks.contact = contact_of_key(frame_->contacts, *selection.contact);
  if (!state.selecting.trails || !history_) return marks;
  marks.trails.resize(history_->question().grains.size());
  const double period = statics().periodic ? statics().length : 0.0;
  for (const HistoryInstant& instant : history_->instants()) {
    if (instant.step > frame_->step) break;
    for (std::size_t i = 0; i < marks.trails.size(); ++i) {
      const GrainPlace& place = instant.places[i];
      if (std::isfinite(place.x)) marks.trails[i].push_back({place.x + place.image * period, place.y});
    }
  }
  return marks;
}

bool ViewModel::follow_history() {
  const SelectingState& selecting = state.selecting;
  Selection question = {{}, selecting.selection.contact};
  if (selecting.trails) {
    question.grains = selecting.selection.grains;
    if (question.grains.empty() && state.selected) question.grains = {*state.selected};
    question.grains = thinned(question.grains, max_trails);
  }
  if (question == Selection{} || frame_count() == 0) {
    history_.reset();
    return false;
  }
  if (!history_)
    history_ = std::make_unique<HistorySeries>([from = frames_](std::size_t k) { return from->read(k); });
  history_->set_question(question, frame_count());
  return history_->collect_ready();
}

std::optional<ContactInspection> ViewModel::contact_inspection() const {
  const std::optional<ContactKey>& contact = state.selecting.selection.contact;
  if (!contact) return std::nullopt;
  return inspect_contact(bed(), *contact);
}

std::vector<Plot> ViewModel::contact_history() const {
  if (!history_ || !history_->question().contact) return {};
  const double weight = runs::mean_grain_mass(all_statics_) * statics().gravity;
  return contact_plots(history_->instants(), weight, abscissa());
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
  std::erase_if(grains, [this](Index i) { return i < 0 || i >= frame_->grain_count(); });
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
      found = grains_where(condition, grain_source(true));
      if (!condition.names.empty() && !selecting.in_each_frame) selecting.quantity = condition.names.front();
    }
    const SelectionMode mode = selecting.in_each_frame ? SelectionMode::replace : selecting.mode;
    select(combined(selected_grains(), found, mode));
    condition_frame_ = frame_;
  } catch (const Error& failure) {
    selecting.error = failure.what();
    selecting.in_each_frame = false;
  }
}

std::optional<ContactKey> ViewModel::contact_at(double x, double y, double reach) const {
  const auto found = find_contact(bed(), x, y, reach);
  return found ? std::optional(key_of(frame_->contacts, *found)) : std::nullopt;
}

void ViewModel::write_selected(const std::string& path) {
  const std::vector<Index> grains = selected_grains();
  if (grains.empty() || path.empty()) {
    state.message = grains.empty() ? "Select grains to write first." : "Give the table a name first.";
    return;
  }
  try {
    output_target(path, {.overwrite = false});
    const auto values_of = [this](const analysis::GrainNumber& number) -> const std::vector<double>& {
      return grain_values(number);
    };
    io::write_text(path, grains_table(frame(), grains, analysis::grain_numbers(), values_of));
    state.message = fmt::format("written: {}, {} grains", path, grains.size());
  } catch (const Error& failure) {
    state.message = failure.what();
  }
}

}  // namespace talus::view
