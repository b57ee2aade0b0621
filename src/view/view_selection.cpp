#include <algorithm>
#include <utility>

#include "runs/event_catalogue.h"
#include "view/view_model.h"

namespace talus::view {

Overlay ViewModel::selection_marks() const {
  const Selection& selection = state.selecting.selection;
  Overlay marks;
  for (const Index grain : selection.grains)
    if (grain < frame_->grain_count()) marks.grains.push_back(grain);
  if (selection.contact) marks.contact = contact_of_key(frame_->contacts, *selection.contact);
  return marks;
}

bool ViewModel::follow_history() {
  const std::optional<ContactKey>& contact = state.selecting.selection.contact;
  if (!contact || frame_count() == 0) {
    history_.reset();
    return false;
  }
  if (!history_)
    history_ = std::make_unique<HistorySeries>([from = frames_](std::size_t k) { return from->read(k); });
  history_->set_contact(*contact, frame_count());
  return history_->collect_ready();
}

std::optional<ContactInspection> ViewModel::contact_inspection() const {
  const std::optional<ContactKey>& contact = state.selecting.selection.contact;
  if (!contact) return std::nullopt;
  return inspect_contact(bed(), *contact);
}

std::vector<Plot> ViewModel::contact_history() const {
  if (!history_) return {};
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

std::optional<ContactKey> ViewModel::contact_at(double x, double y, double reach) const {
  const auto found = find_contact(bed(), x, y, reach);
  return found ? std::optional(key_of(frame_->contacts, *found)) : std::nullopt;
}

}  // namespace talus::view
