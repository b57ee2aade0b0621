#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numeric>

#include "figures/contact_lines.h"
#include "figures/failed_group.h"
#include "figures/recipes.h"
#include "figures/run_means.h"

namespace talus::figures {
namespace {

// Heights below the map in a figure 17.8 cm wide, cm.
constexpr double page_width = 17.8;
constexpr double room_for_legend = 1.3;
constexpr double curves_height = 5.6;

double rounded(double value) { return std::round(1e4 * value) / 1e4; }

double mean_normal_force(const FrameContacts& contacts) {
  return std::accumulate(contacts.fn.begin(), contacts.fn.end(), 0.0) / contacts.count();
}

Table surface_table(const BedFrame& bed) {
  const SurfaceLine line = surface_line(bed);
  const double diameter = bed.statics.mean_diameter;
  Table table{"surface",
              {{"x", "D", "distance along the bed", {}}, {"y", "D", "height of the free surface", {}}}};
  for (std::size_t k = 0; k < line.x.size(); ++k) {
    table.columns[0].values.push_back(rounded(line.x[k] / diameter));
    table.columns[1].values.push_back(rounded(line.y[k] / diameter));
  }
  return table;
}

/// Appends the contacts and the surface of the bed, and the variables that a script needs to draw them over
/// the full width of the figure. Returns the ratio of height to width of this map.
double add_contact_map(Figure& figure, const BedFrame& bed) {
  const RunStatics& statics = bed.statics;
  figure.tables.push_back(force_table(bed));
  figure.tables.push_back(surface_table(bed));
  const double length = statics.length / statics.mean_diameter;
  const double top = std::ceil(*std::ranges::max_element(figure.tables.back().columns[1].values)) + 0.5;
  const double bottom =
      statics.free_count == bed.frame.grain_count() ? 0.0 : -0.5;  // down to the centres of floor grains
  const double margin = 0.01 * length;
  figure.wide = true;
  set_variable(figure, "bed_length", length);
  set_variable(figure, "bed_bottom", bottom);
  set_variable(figure, "bed_top", top);
  set_variable(figure, "margin", margin);
  set_variable(figure, "periodic", statics.periodic ? 1.0 : 0.0);
  set_variable(figure, "theta", gnuplot_quoted(angle_text(bed.frame.tilt)));
  const double map_height = (top - bottom + margin) / (length + 2.0 * margin);
  set_variable(figure, "map_height", map_height);
  return map_height;
}

std::string frame_text(const FailedGroup& failed, const Frame& frame, bool last = true) {
  return fmt::format("{}, at theta = {} deg, {}theta_c = {} deg", first_run_text(failed),
                     angle_text(frame.tilt), last ? "the last frame before failure at " : "",
                     angle_text(theta_c_of(failed.first())));
}

std::vector<FrameColumn> critical_columns() {
  return {column_of("share", analysis::quantity_of(&analysis::FrameRecord::critical_share)),
          column_of("largest", analysis::quantity_of(&analysis::FrameRecord::critical_largest)),
          column_of("correlation_length",
                    analysis::quantity_of(&analysis::FrameRecord::critical_correlation_length))};
}

}  // namespace

Table force_table(const BedFrame& bed) {
  const FrameContacts& contacts = bed.frame.contacts;
  const double mean = mean_normal_force(contacts);
  std::vector<ContactLine> lines = contact_lines(bed);
  std::ranges::stable_sort(lines, {}, [&](const ContactLine& line) { return contacts.fn[line.contact]; });
  Table table{
      "contacts",
      {{"x1", "D", "one end, along the bed: the centre of a grain, or the periodic edge", {}},
       {"y1", "D", "the same, across the bed", {}},
       {"x2", "D", "the other end: a centre, the periodic edge, or the point of contact at a wall", {}},
       {"y2", "D", "the same, across the bed", {}},
       {"force", "1", "normal force over its mean", {}},
       {"critical", "1", "1 if friction is fully mobilised, else 0", {}}}};
  const double diameter = bed.statics.mean_diameter;
  for (const ContactLine& line : lines) {
    const double row[] = {rounded(line.x1 / diameter),
                          rounded(line.y1 / diameter),
                          rounded(line.x2 / diameter),
                          rounded(line.y2 / diameter),
                          rounded(contacts.fn[line.contact] / mean),
                          contacts.status[line.contact] == ContactStatus::sliding ? 1.0 : 0.0};
    for (std::size_t c = 0; c < std::size(row); ++c) table.columns[c].values.push_back(row[c]);
  }
  return table;
}

std::optional<Figure> force_chains(std::span<const RunGroup> groups, const FrameWords& at) {
  const auto failed = first_failed_group(groups);
  if (!failed) return std::nullopt;
  const runs::RunView& run = failed->first();
  const Frame frame = run.file->frame(at.empty() ? repose_frame(run) : frames_of_run(run, at).front());
  Figure figure;
  figure.name = "force-chains";
  figure.title = at.empty() ? "Force chains just before failure" : "Force chains";
  figure.caption = fmt::format(
      "Normal forces as lines between the centres of grains, their width proportional to the force, in ten "
      "classes of half the mean force, the last of them open; black: above the mean (strong network), gray: "
      "up to it (weak); {}. Contacts across the periodic edge are cut there. The thin line is the free "
      "surface.",
      frame_text(*failed, frame, at.empty()));
  figure.runs = {run.path};
  figure.height_over_width =
      add_contact_map(figure, {frame, run.file->header().statics}) + room_for_legend / page_width;
  set_variable(figure, "tilt", frame.tilt);
  return figure;
}

std::optional<Figure> critical_contacts_figure(std::span<const RunGroup> groups) {
  if (std::ranges::all_of(groups, [](const RunGroup& group) { return failed_runs(group).empty(); }))
    return std::nullopt;
  Figure figure;
  figure.name = "critical-contacts";
  figure.title = "Contacts with fully mobilised friction";
  for (const RunGroup& group : groups) add_group_curves(figure, group, all_runs(group), critical_columns());
  figure.wide = true;
  const auto mapped = first_failed_group(groups);
  const std::string letters = mapped ? "bcd" : "abc";
  set_variable(figure, "letters", gnuplot_string(letters));
  figure.caption = "Critical contacts, whose friction is fully mobilised.";
  if (mapped) {
    const runs::RunView& run = mapped->first();
    const Frame frame = run.file->frame(repose_frame(run));
    figure.caption +=
        fmt::format(" (a) Black: critical contacts, gray: the others; {}.", frame_text(*mapped, frame));
    figure.height_over_width =
        add_contact_map(figure, {frame, run.file->header().statics}) + curves_height / page_width;
  } else {
    figure.height_over_width = (curves_height - 0.6) / page_width;
    set_variable(figure, "map_height", 0.0);
  }
  figure.caption += fmt::format(
      " ({}) Their share of the contacts, ({}) contacts in their largest cluster, joined if they share a "
      "free grain, ({}) correlation length of their clusters, over the tilt theta, up to theta_c. {}",
      letters[0], letters[1], letters[2], means_caption);
  return figure;
}

}  // namespace talus::figures
