#include "ensemble/member_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>
#include <variant>

#include "analysis/failure/last_rise.h"
#include "analysis/failure/place.h"
#include "analysis/quantities.h"
#include "base/hash.h"
#include "core/snapshot.h"
#include "core/trigonometry.h"
#include "runs/run_view.h"

namespace talus::ensemble {
namespace {

/// Results that the run itself computes, without an analysis.
constexpr const char* angle_at_rest = "theta_r";
constexpr std::array<const char*, 2> counted_steps = {"unconverged_steps_deposition", "unconverged_steps"};

/// Returns the number of values of a result: its elements, or the thresholds.
std::size_t count_of(const analysis::NumberOfRun& number, const analysis::Analysis& analysis) {
  const analysis::Quantity& quantity = analysis::quantity_of(number.quantity);
  if (number.place == analysis::Place::run)
    return std::get<std::vector<double>>(analysis::values_of(quantity, analysis)).size();
  return analysis::needs_threshold(quantity) ? analysis.thresholds.size() : 1;
}

double result(const Figures& figures, const std::string& name) {
  return find_value(figures, name).value_or(not_known);
}

std::vector<double> tilts_of(const std::vector<const analysis::FrameRecord*>& frames) {
  std::vector<double> tilts;
  for (const analysis::FrameRecord* frame : frames) tilts.push_back(degrees(std::abs(frame->tilt)));
  return tilts;
}

/// Returns an empty list of the quantity.
NamedList list_called(const analysis::Quantity& quantity, std::size_t f) {
  return {element_name(quantity.name, f), analysis::scaled_unit(quantity.unit), quantity.definition, 0, {}};
}

void append(NamedList& list, const analysis::Quantity& quantity, const std::vector<double>& values,
            double mean_diameter) {
  list.width = values.size();
  for (const double value : values)
    list.values.push_back(analysis::scaled(quantity.unit, value, mean_diameter));
}

}  // namespace

std::string element_name(const std::string& name, std::size_t k) {
  return k == 0 ? name : fmt::format("{}[{}]", name, k);
}

MemberNumbers member_numbers(const io::RunFile& run, const analysis::Analysis& analysis) {
  const io::Checkpoint& end = run.checkpoint();
  MemberNumbers found{hash_text(state_hash(end.world)),
                      runs::version_of(run.header().provenance),
                      result(end.timing, "deposition") + result(end.timing, "tilt"),
                      {}};
  for (const analysis::NumberOfRun& number : analysis::numbers_of_run()) {
    const std::string& unit = analysis::quantity_of(number.quantity).unit;
    for (std::size_t k = 0; k < count_of(number, analysis); ++k)
      found.numbers.push_back({element_name(name_of(number), k), analysis::scaled_unit(unit),
                               analysis::scaled(unit, analysis::number_at(analysis, number, k),
                                                run.header().statics.mean_diameter)});
  }
  found.numbers.push_back({angle_at_rest, "deg", degrees(result(end.results, angle_at_rest))});
  for (const char* name : counted_steps) found.numbers.push_back({name, "1", result(end.results, name)});
  return found;
}

std::vector<std::string> numbers_of_run() {
  std::vector<std::string> names;
  for (const analysis::NumberOfRun& number : analysis::numbers_of_run()) names.push_back(name_of(number));
  names.emplace_back(angle_at_rest);
  names.insert(names.end(), counted_steps.begin(), counted_steps.end());
  return names;
}

bool is_number_of_run(const std::string& name) {
  const std::vector<std::string> names = numbers_of_run();
  const std::size_t bracket = std::min(name.find('['), name.size());
  const std::string element = name.substr(bracket);  // for example "[1]"
  const std::size_t digits = element.find_first_not_of("0123456789", 1);
  const bool is_element =
      element.empty() || (digits != std::string::npos && digits > 1 && element.substr(digits) == "]");
  return is_element && std::ranges::find(names, name.substr(0, bracket)) != names.end();
}

double number_called(const MemberNumbers& numbers, const std::string& name) {
  const auto found = std::ranges::find(numbers.numbers, name, &NamedNumber::name);
  return found == numbers.numbers.end() ? not_known : found->value;
}

std::vector<const analysis::FrameRecord*> frames_to_failure(const analysis::Analysis& analysis) {
  std::vector<const analysis::FrameRecord*> frames;
  for (const analysis::FrameRecord* frame : analysis::last_rise(analysis.frames).frames)
    if (!(std::abs(frame->tilt) > analysis.theta_c) &&
        (frames.empty() || std::abs(frame->tilt) > std::abs(frames.back()->tilt)))
      frames.push_back(frame);
  return frames;
}

MemberSeries member_series(const analysis::Analysis& analysis, double mean_diameter) {
  const std::vector<const analysis::FrameRecord*> frames = frames_to_failure(analysis);
  const bool mirrored_slope = analysis::last_rise(analysis.frames).mirrored_slope;
  MemberSeries found{tilts_of(frames), {}};
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (!analysis::is_number_of_frame(quantity)) continue;
    const std::size_t count = analysis::needs_threshold(quantity) ? analysis.thresholds.size() : 1;
    for (std::size_t f = 0; f < count; ++f) {
      NamedSeries series{element_name(quantity.name, f), analysis::scaled_unit(quantity.unit), {}};
      for (const analysis::FrameRecord* frame : frames)
        series.values.push_back(analysis::scaled(
            quantity.unit, analysis::number_on_one_side(quantity, *frame, f, mirrored_slope), mean_diameter));
      found.series.push_back(std::move(series));
    }
  }
  return found;
}

MemberLists member_lists(const analysis::Analysis& analysis, double mean_diameter) {
  const std::vector<const analysis::FrameRecord*> frames = frames_to_failure(analysis);
  MemberLists found{tilts_of(frames), {}, {}};
  for (const analysis::Quantity& quantity : analysis::quantities()) {
    if (analysis::is_list_of_run(quantity)) {
      NamedList bins = list_called(quantity, 0);
      append(bins, quantity, std::get<std::vector<double>>(analysis::values_of(quantity, analysis)),
             mean_diameter);
      if (bins.width > 0) found.bins.push_back(std::move(bins));
    }
    if (!analysis::is_list_of_frame(quantity) || quantity.unit == "rad") continue;
    const std::size_t count = analysis::needs_threshold(quantity) ? analysis.thresholds.size() : 1;
    for (std::size_t f = 0; f < count; ++f) {
      NamedList list = list_called(quantity, f);
      for (const analysis::FrameRecord* frame : frames)
        append(list, quantity, analysis::list_of(quantity, *frame, f), mean_diameter);
      if (list.width > 0) found.lists.push_back(std::move(list));
    }
  }
  return found;
}

}  // namespace talus::ensemble
