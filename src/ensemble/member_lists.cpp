#include "ensemble/member_lists.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "analysis/quantities.h"
#include "core/trigonometry.h"
#include "ensemble/member_numbers.h"
#include "ensemble/member_series.h"
#include "ensemble/plan.h"
#include "io/durable_file.h"
#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"
#include "io/seal.h"

namespace talus {
namespace {

constexpr const char* theta_path = "/theta";
constexpr const char* bins_group = "/bins";
constexpr const char* lists_group = "/frames";

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

void add(hdf5::Writer& file, const std::string& path, const std::string& shape, const std::string& unit,
         const std::string& definition, const std::vector<double>& values) {
  file.write(DataSetField{path, ElementType::float64, shape, unit, definition}, values);
  file.set_attribute(path, "definition", definition);
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
  hdf5::Writer file({{'S', 0}}, seal_size);
  add(file, theta_path, std::to_string(lists.theta.size()), "deg", "tilt", lists.theta);
  for (const NamedList& bins : lists.bins)
    add(file, bins_group + ("/" + bins.name), std::to_string(bins.width), bins.unit, bins.definition,
        bins.values);
  for (const NamedList& list : lists.lists)
    add(file, lists_group + ("/" + list.name),
        fmt::format("S+{} {}", list.values.size() / list.width, list.width), list.unit, list.definition,
        list.values);
  std::vector<std::byte> bytes = file.image();
  seal(bytes, averages_seal);
  write_durably(path, bytes);
}

MemberLists read_lists(const std::string& path) {
  verify_seal(path, averages_seal);
  hdf5::Reader file = hdf5::Reader::from_file(path);
  MemberLists found;
  found.theta = file.read<double>(DataSetField{theta_path, ElementType::float64, "T", "deg", {}});
  if (!std::ranges::is_sorted(found.theta)) refuse_table(path);
  for (const char* group : {bins_group, lists_group}) {
    if (!file.has(group)) continue;
    const bool is_bins = group == std::string_view(bins_group);
    for (const std::string& item : file.data_sets(group)) {
      std::vector<double> values = file.again().read<double>(
          DataSetField{
              item, ElementType::float64, is_bins ? "W" : fmt::format("{} W", found.theta.size()), {}, {}},
          hdf5::any_number);
      const std::size_t width = values.size() / (is_bins ? 1 : std::max<std::size_t>(1, found.theta.size()));
      (is_bins ? found.bins : found.lists)
          .push_back({item.substr(std::string_view(group).size() + 1), file.attribute(item, "unit"),
                      file.attribute(item, "definition"), width, std::move(values)});
    }
  }
  return found;
}

std::string lists_path(const std::string& run) { return file_beside(run, lists_ending); }

}  // namespace talus
