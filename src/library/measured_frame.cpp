#include "library/measured_frame.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "analysis/frame_analysis.h"
#include "analysis/quantities.h"
#include "analysis/topology/topology.h"
#include "base/errors.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "io/run_file.h"
#include "pictures/map_plan.h"
#include "pictures/maps.h"
#include "pictures/picture_files.h"
#include "render/renderer.h"
#include "runs/analysis_parameters.h"
#include "runs/run_view.h"
#include "session/run_header.h"

namespace talus {
namespace {

// Diameter over which fields are coarse-grained, D; the default of maps.
constexpr double default_length = 10.0;

[[noreturn]] void refuse(std::string_view name, const char* what, const std::vector<std::string>& known) {
  throw Error(ExitCode::usage, "no {} is called '{}'{}", what, visible_word(name), did_you_mean(name, known));
}

/// Splits "lc/mean[1]" into its name and 1; the number is 0 if none is given.
std::pair<std::string_view, std::size_t> split(std::string_view name) {
  const auto bracket = name.find('[');
  if (bracket == std::string_view::npos || !name.ends_with(']')) return {name, 0};
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(name.data() + bracket + 1, name.data() + name.size() - 1, number);
  if (error != std::errc() || end != name.data() + name.size() - 1) return {name, 0};
  return {name.substr(0, bracket), number};
}

using Table = std::span<const analysis::FrameQuantity>;

/// Returns the names of the quantities of a table, those by threshold also at each of these thresholds.
std::vector<std::string> names_of(Table table, const std::vector<double>& factors) {
  std::vector<std::string> names;
  for (const analysis::FrameQuantity& quantity : table) {
    if (quantity.name.empty()) continue;  // the centre, which has its own array
    names.emplace_back(quantity.name);
    if (quantity.need != analysis::FrameNeed::threshold) continue;
    for (const double factor : factors)
      names.push_back(std::string(quantity.name) + analysis::threshold_ending(factor));
  }
  return names;
}

/// A quantity of a table, and the number of its threshold.
struct Entry {
  const analysis::FrameQuantity& quantity;
  std::size_t threshold = 0;
};

Entry find_entry(Table table, std::string_view name, const char* what, const std::vector<double>& factors) {
  const auto [plain, number] = split(name);
  for (const analysis::FrameQuantity& quantity : table) {
    if (quantity.name.empty()) continue;
    const bool by_threshold = quantity.need == analysis::FrameNeed::threshold;
    if (quantity.name == name || (quantity.name == plain && by_threshold && number < factors.size()))
      return {quantity, number};
    for (std::size_t k = 0; by_threshold && k < factors.size(); ++k)
      if (name == std::string(quantity.name) + analysis::threshold_ending(factors[k])) return {quantity, k};
  }
  refuse(name, what, names_of(table, factors));
}

constexpr const char* of_grains = "quantity of grains";
constexpr const char* of_contacts = "quantity of contacts";

/// Returns a quantity stored with the run; null if there is none of this name.
const OwnQuantity* find_own(const Frame& frame, std::string_view name, bool is_of_grains) {
  const auto found = std::ranges::find(frame.own, name, &OwnQuantity::name);
  return found == frame.own.end() || found->of_grains != is_of_grains ? nullptr : &*found;
}

std::vector<std::string> with_own(std::vector<std::string> names, const Frame& frame, bool is_of_grains) {
  for (const OwnQuantity& own : frame.own)
    if (own.of_grains == is_of_grains) names.push_back(own.name);
  return names;
}

}  // namespace

MeasuredFrame::MeasuredFrame(Frame frame, RunStatics statics, analysis::AnalysisParameters parameters,
                             std::optional<double> theta_c, std::optional<Frame> begin,
                             std::optional<ObservableRow> row)
    : frame_(std::move(frame)),
      statics_(std::move(statics)),
      parameters_(std::move(parameters)),
      theta_c_(theta_c),
      begin_(std::move(begin)),
      row_(row) {
  if (parameters_ != analysis::AnalysisParameters())
    runs::from_facts(runs::as_facts(parameters_));  // checks them
}

double MeasuredFrame::theta_c() const { return theta_c_.value_or(radians(pictures::assumed_theta_c)); }

const Frame& MeasuredFrame::judged() {
  if (!judged_) judged_ = analysis::with_analysed_gamma(frame_, statics_, parameters_);
  return *judged_;
}

const analysis::FrameRecord& MeasuredFrame::record() {
  if (record_) return *record_;
  const analysis::Analysis analysis = analysis::begin_analysis(statics_, parameters_, theta_c());
  analysis::FrameRecord found = analysis::analyse_frame({judged(), statics_}, parameters_, analysis);
  analysis::measure_topology(analysis::force_persistence({judged(), statics_}, found.mean_normal_force),
                             statics_.free_count, analysis.network_threshold, found);
  if (row_) {
    found.volume_strain = at(*row_, Observable::volume_strain);
    found.centre_of_mass_strain = at(*row_, Observable::centre_of_mass_strain);
    found.solid_fraction = at(*row_, Observable::solid_fraction);
  }
  record_ = std::move(found);
  return *record_;
}

double MeasuredFrame::quantity(std::string_view name) {
  const auto [plain, threshold] = split(name);
  for (const analysis::Quantity& quantity : analysis::quantities())
    if (quantity.name == plain && analysis::is_number_of_frame(quantity)) {
      const std::size_t count = analysis::needs_threshold(quantity) ? record().thresholds.size() : 1;
      if (threshold < count) return analysis::number_of(quantity, record(), threshold);
      throw Error(ExitCode::usage, "'{}': the frame has {} of it, counted from 0", visible_word(name), count);
    }
  const auto* const field = std::ranges::find(observable_fields, name, &SeriesField::name);
  if (field == observable_fields.end()) refuse(name, "number of a frame", quantities());
  switch (const auto number = static_cast<Observable>(field - observable_fields.begin()); number) {
    case Observable::step:
      return static_cast<double>(frame_.step);
    case Observable::time:
      return frame_.time;
    case Observable::tilt:
      return rounded_degrees(frame_.tilt);
    default:
      return row_ ? at(*row_, number) : not_known;
  }
}

std::vector<double> MeasuredFrame::grain_values(std::string_view name) {
  if (const OwnQuantity* own = find_own(frame_, name, true)) return own->values;
  const std::vector<double>& factors = parameters_.threshold_factors;
  const auto [quantity, threshold] = find_entry(analysis::grain_quantities(), name, of_grains, factors);
  analysis::GrainSource source = {bed(),  nullptr, true, 0, judged().gamma, begin_ ? &*begin_ : nullptr,
                                  factors};
  if (quantity.need == analysis::FrameNeed::threshold) source.thresholds = record().thresholds;
  source.earlier = source.first;
  source.length = std::min(default_length * statics_.mean_diameter, statics_.length);
  std::vector<double> values = quantity.values(source, threshold);
  const bool is_known = quantity.need != analysis::FrameNeed::earlier_frame ||
                        (source.earlier && source.earlier->grain_count() == source.frame.grain_count());
  if (!is_known) std::ranges::fill(values, not_known);
  return values;
}

std::vector<double> MeasuredFrame::contact_values(std::string_view name) const {
  if (const OwnQuantity* own = find_own(frame_, name, false)) return own->values;
  return contact_quantity(name).values({bed()}, 0);
}

std::vector<std::string> MeasuredFrame::quantities() const {
  std::vector<std::string> names;
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (!analysis::is_number_of_frame(quantity)) continue;
    names.push_back(quantity.name);
    for (std::size_t k = 1; analysis::needs_threshold(quantity) && k < parameters_.threshold_factors.size();
         ++k)
      names.push_back(fmt::format("{}[{}]", quantity.name, k));
  }
  for (const SeriesField& field : observable_fields) names.emplace_back(field.name);
  return names;
}

std::vector<std::string> MeasuredFrame::grain_quantities() const {
  return with_own(names_of(analysis::grain_quantities(), parameters_.threshold_factors), frame_, true);
}

std::vector<std::string> MeasuredFrame::contact_quantities() const {
  return with_own(names_of(analysis::contact_quantities(), {}), frame_, false);
}

analysis::FrameQuantity MeasuredFrame::grain_quantity(std::string_view name) const {
  if (const OwnQuantity* own = find_own(frame_, name, true)) return analysis::row_of(*own);
  return find_entry(analysis::grain_quantities(), name, of_grains, parameters_.threshold_factors).quantity;
}

analysis::FrameQuantity MeasuredFrame::contact_quantity(std::string_view name) const {
  if (const OwnQuantity* own = find_own(frame_, name, false)) return analysis::row_of(*own);
  return find_entry(analysis::contact_quantities(), name, of_contacts, {}).quantity;
}

namespace {

/// Returns the values with of_grains set by their number. Throws Error(usage) for an impossible number.
OwnQuantity fitted(OwnQuantity own, const BedFrame& bed) {
  const auto free_count = static_cast<std::size_t>(bed.statics.free_count);
  const std::size_t grains = bed.frame.x.size(), contacts = bed.frame.contacts.fn.size(),
                    count = own.values.size();
  own.of_grains = count == free_count || count == grains;
  if (!own.of_grains && count != contacts)
    throw Error(ExitCode::usage,
                "{} values: expected one for each of the {} free grains, of all {} grains, or of the {} "
                "contacts that carry force",
                count, free_count, grains, contacts);
  return own;
}

/// Returns the plan of one map of a frame.
pictures::MapPlan plan_of(const pictures::MapChoice& what, pictures::MapOptions options,
                          std::span<const OwnQuantity> stored) {
  if (!options.crop.empty() || !options.traces.empty() || options.since)
    throw Error(ExitCode::usage,
                "draw: crop, traces and since apply only to talus render, panel and animate");
  const auto* const own = std::get_if<OwnQuantity>(&what);
  options.maps = {own != nullptr ? own->name : std::get<std::string>(what)};
  pictures::MapPlan plan = pictures::plan_maps(options, own != nullptr ? std::span(own, 1) : stored);
  if (plan.maps[0].own) plan.maps[0].own->values.clear();  // the scale fits the frame
  return plan;
}

}  // namespace

render::FrameView MeasuredFrame::map(const pictures::MapChoice& what,
                                     const pictures::MapOptions& options) const {
  pictures::MapPlan plan = plan_of(what, options, frame_.own);
  pictures::settle_theta_c(plan, theta_c_.value_or(not_known));
  const pictures::MapSettings& settings = plan.maps.at(0);
  Frame mapped = pictures::mapped_frame(frame_, statics_, settings.l_min);
  if (const auto* own = std::get_if<OwnQuantity>(&what)) mapped.own = {fitted(*own, bed())};
  analysis::GrainSource frame = {{mapped, statics_}};
  if (begin_ && begin_->grain_count() == mapped.grain_count()) frame.earlier = &*begin_;
  frame.per_degree = false;
  pictures::MapExtent extent = pictures::bed_extent(statics_);
  pictures::extend(extent, frame);
  return pictures::make_map(frame, settings, extent);
}

render::Image MeasuredFrame::draw(const pictures::MapChoice& what,
                                  const pictures::MapOptions& options) const {
  render::FrameView view = map(what, options);
  render::Renderer renderer(render::make_context());
  return renderer.draw(
      pictures::sheet_of_plan(std::move(view), plan_of(what, options, frame_.own), renderer.font()));
}

MeasuredFrame measured_frame(const std::string& path, std::size_t k,
                             const std::vector<std::string>& settings) {
  const io::RunFile run = io::RunFile::open(path);
  const std::size_t count = run.all_frame_tilts().size();
  if (k >= count)
    throw Error(ExitCode::usage, "{}: frame {} does not exist; the run has {} frames", path, k, count);
  std::optional<double> theta_c = find_value(run.checkpoint().results, "theta_c");
  if (theta_c && !std::isfinite(*theta_c)) theta_c.reset();
  std::optional<ObservableRow> last;
  for (const ObservableRow& row : run.all_observables())
    if (at(row, Observable::time) <= run.all_frame_times()[k]) last = row;
  return {run.frame(k), run.header().statics, runs::parse_analysis_settings(settings),
          theta_c,      run.frame(0),         last};
}

std::vector<std::string> departures(const std::string& path) {
  const io::RunFile run = io::RunFile::open(path);
  return session::departures(run, runs::stored_scenario(run.header(), path + ":/parameters"));
}

}  // namespace talus
