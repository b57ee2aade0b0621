#include "ensemble/member_lists.h"

#include <algorithm>
#include <cmath>

#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "ensemble/member_numbers.h"
#include "ensemble/member_series.h"
#include "ensemble/plan.h"
#include "io/plain_file.h"

namespace talus {
namespace {

constexpr const char* theta_path = "/theta";
constexpr const char* bins_group = "/bins/";
constexpr const char* lists_group = "/frames/";

bool is_averaged(const Quantity& quantity) { return is_list_of_frame(quantity) && quantity.unit != "rad"; }

/// An empty list of the quantity.
NamedList list_called(const Quantity& quantity, std::size_t f) {
  return {element_name(quantity.name, f), scaled_unit(quantity.unit), quantity.definition, 0, {}};
}

void append(NamedList& list, const Quantity& quantity, const std::vector<double>& values,
            double mean_diameter) {
  list.width = values.size();
  for (const double value : values) list.values.push_back(scaled(quantity.unit, value, mean_diameter));
}

PlainArray array_of(const std::string& group, const NamedList& list) {
  return {group + list.name, {list.values.size() / list.width, list.width},
          list.unit,         list.definition,
          list.values,       {}};
}

}  // namespace

MemberLists member_lists(const Analysis& analysis, double mean_diameter) {
  const std::vector<const FrameRecord*> frames = frames_to_failure(analysis);
  MemberLists found;
  for (const FrameRecord* frame : frames) found.theta.push_back(degrees(std::abs(frame->tilt)));
  for (const Quantity& quantity : quantities()) {
    if (is_list_of_run(quantity)) {
      NamedList bins = list_called(quantity, 0);
      append(bins, quantity, std::get<std::vector<double>>(values_of(quantity, analysis)), mean_diameter);
      if (bins.width > 0) found.bins.push_back(std::move(bins));
    }
    if (!is_averaged(quantity)) continue;
    const std::size_t count = needs_threshold(quantity) ? analysis.thresholds.size() : 1;
    for (std::size_t f = 0; f < count; ++f) {
      NamedList list = list_called(quantity, f);
      for (const FrameRecord* frame : frames)
        append(list, quantity, list_of(quantity, *frame, f), mean_diameter);
      if (list.width > 0) found.lists.push_back(std::move(list));
    }
  }
  return found;
}

void set_lists(const MemberLists& lists, double mean_diameter, Analysis& analysis) {
  const auto part = [&](const Quantity& quantity, const NamedList& list, std::size_t row) {
    std::vector<double> values;
    for (std::size_t k = 0; k < list.width; ++k)
      values.push_back(unscaled(quantity.unit, list.values[row * list.width + k], mean_diameter));
    return values;
  };
  for (const Quantity& quantity : quantities()) {
    if (is_list_of_run(quantity)) {
      const auto bins = std::ranges::find(lists.bins, quantity.name, &NamedList::name);
      if (bins != lists.bins.end()) set_values(quantity, part(quantity, *bins, 0), analysis);
    }
    const std::size_t count = needs_threshold(quantity) ? analysis.thresholds.size() : 1;
    for (std::size_t f = 0; f < count && is_averaged(quantity); ++f) {
      const auto list = std::ranges::find(lists.lists, element_name(quantity.name, f), &NamedList::name);
      if (list == lists.lists.end()) continue;
      for (std::size_t k = 0; k < analysis.frames.size(); ++k)
        set_list(quantity, part(quantity, *list, k), analysis.frames[k], f);
    }
  }
}

void write_lists(const std::string& path, const MemberLists& lists) {
  std::vector<PlainArray> arrays = {{theta_path, {lists.theta.size()}, "deg", "tilt", lists.theta, {}}};
  for (const NamedList& bins : lists.bins)
    arrays.push_back({bins_group + bins.name, {bins.width}, bins.unit, bins.definition, bins.values, {}});
  for (const NamedList& list : lists.lists) arrays.push_back(array_of(lists_group, list));
  write_plain_file(path, arrays, {});
}

MemberLists read_lists(const std::string& path) {
  MemberLists found;
  PlainFile file = read_plain_file(path);
  for (PlainArray& array : file.arrays)
    if (array.path == theta_path) found.theta = std::move(array.values);
  if (!std::ranges::is_sorted(found.theta)) refuse_table(path);
  for (PlainArray& array : file.arrays) {
    const bool is_bins = array.path.starts_with(bins_group);
    if (!is_bins && !array.path.starts_with(lists_group)) continue;
    if (array.shape.size() != (is_bins ? 1 : 2) || (!is_bins && array.shape[0] != found.theta.size()))
      refuse_table(path);
    const std::string name = array.path.substr(std::string(is_bins ? bins_group : lists_group).size());
    (is_bins ? found.bins : found.lists)
        .push_back({name, array.unit, array.definition, array.shape.back(), std::move(array.values)});
  }
  return found;
}

std::string lists_path(const std::string& run) { return file_beside(run, lists_ending); }

}  // namespace talus
