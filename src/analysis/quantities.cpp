#include "analysis/quantities.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/trigonometry.h"

namespace talus {
namespace {

/// The numbers of one member, of a run, a threshold or a frame.
template <typename T>
std::span<const T> numbers(const T& number) {
  return {&number, 1};
}
template <typename T, std::size_t n>
std::span<const T> numbers(const std::array<T, n>& array) {
  return array;
}
template <typename T>
std::span<const T> numbers(const std::vector<T>& array) {
  return array;
}

template <typename T>
void assign(T& number, std::span<const T> part) {
  number = part[0];
}
template <typename T, std::size_t n>
void assign(std::array<T, n>& array, std::span<const T> part) {
  std::ranges::copy(part.first(n), array.begin());
}
template <typename T>
void assign(std::vector<T>& array, std::span<const T> part) {
  array.assign(part.begin(), part.end());
}

/// Calls use(record) for each record of one type, in the order in which their values are stored.
template <typename Record, typename SomeAnalysis, typename Use>
void for_each_record(SomeAnalysis& analysis, const Use& use) {
  if constexpr (std::is_same_v<Record, Analysis>)
    use(analysis);
  else if constexpr (std::is_same_v<Record, RunThreshold>)
    std::ranges::for_each(analysis.thresholds, use);
  else
    for (auto& frame : analysis.frames) {
      if constexpr (std::is_same_v<Record, FrameRecord>)
        use(frame);
      else
        std::ranges::for_each(frame.thresholds, use);
    }
}

}  // namespace

const Quantity& quantity_of(const QuantityMember& member) {
  const auto found = std::ranges::find(quantities(), member, &Quantity::member);
  if (found == quantities().end())
    throw Error(ExitCode::internal, "the table of quantities has no row for this member");
  return *found;
}

Values values_of(const Quantity& quantity, const Analysis& analysis) {
  return std::visit(
      [&]<typename Record, typename T>(T Record::*member) -> Values {
        using Number = typename decltype(numbers(std::declval<const T&>()))::value_type;
        std::vector<Number> all;
        for_each_record<Record>(analysis, [&](const Record& record) {
          const auto part = numbers(record.*member);
          all.insert(all.end(), part.begin(), part.end());
        });
        return all;
      },
      quantity.member);
}

void set_values(const Quantity& quantity, const Values& values, Analysis& analysis) {
  std::visit(
      [&]<typename Record, typename T>(T Record::*member) {
        using Number = typename decltype(numbers(std::declval<const T&>()))::value_type;
        const auto& all = std::get<std::vector<Number>>(values);
        std::size_t count = 0, next = 0;
        for_each_record<Record>(analysis, [&](const Record&) { ++count; });
        for_each_record<Record>(analysis, [&](Record& record) {
          const std::size_t width = all.size() / count;
          assign(record.*member, std::span(all).subspan(next, width));
          next += width;
        });
      },
      quantity.member);
}

double number_of(const Quantity& quantity, const FrameRecord& frame, std::size_t f) {
  return std::visit(
      [&]<typename Record, typename T>(T Record::*member) {
        if constexpr (std::is_arithmetic_v<T> && std::is_same_v<Record, FrameRecord>)
          return static_cast<double>(frame.*member);
        else if constexpr (std::is_arithmetic_v<T> && std::is_same_v<Record, FrameThreshold>)
          return f < frame.thresholds.size() ? static_cast<double>(frame.thresholds[f].*member) : not_known;
        else
          return not_known;
      },
      quantity.member);
}

void set_number(const Quantity& quantity, double value, FrameRecord& frame, std::size_t f) {
  const auto set = [value](auto& number) {
    if constexpr (std::is_same_v<std::remove_reference_t<decltype(number)>, Index>)
      number = std::isnan(value) ? 0 : static_cast<Index>(std::lround(value));
    else
      number = value;
  };
  std::visit(
      [&]<typename Record, typename T>(T Record::*member) {
        if constexpr (std::is_arithmetic_v<T> && std::is_same_v<Record, FrameRecord>)
          set(frame.*member);
        else if constexpr (std::is_arithmetic_v<T> && std::is_same_v<Record, FrameThreshold>)
          if (f < frame.thresholds.size()) set(frame.thresholds[f].*member);
      },
      quantity.member);
}

bool is_number_of_run(const Quantity& quantity) {
  return std::holds_alternative<double Analysis::*>(quantity.member) ||
         std::holds_alternative<std::array<double, 2> Analysis::*>(quantity.member) ||
         std::holds_alternative<double RunThreshold::*>(quantity.member);
}

bool is_number_of_frame(const Quantity& quantity) {
  return std::visit(
      []<typename Record, typename T>(T Record::*) {
        return std::is_arithmetic_v<T> &&
               (std::is_same_v<Record, FrameRecord> || std::is_same_v<Record, FrameThreshold>);
      },
      quantity.member);
}

double number_of(const Quantity& quantity, const Analysis& analysis, std::size_t k) {
  const Values values = values_of(quantity, analysis);
  const auto* numbers = std::get_if<std::vector<double>>(&values);
  return numbers != nullptr && k < numbers->size() ? (*numbers)[k] : not_known;
}

bool needs_threshold(const Quantity& quantity) { return quantity.shape.find('F') != std::string::npos; }

double scaled(const Quantity& quantity, double value, double mean_diameter) {
  if (quantity.unit == "m") return value / mean_diameter;
  return quantity.unit == "rad" ? degrees(value) : value;
}

double unscaled(const Quantity& quantity, double value, double mean_diameter) {
  if (quantity.unit == "m") return value * mean_diameter;
  return quantity.unit == "rad" ? radians(value) : value;
}

std::string scaled_unit(const Quantity& quantity) {
  if (quantity.unit == "m") return "D";
  return quantity.unit == "rad" ? "deg" : quantity.unit;
}

double shown(const Quantity& quantity, double value, double mean_diameter) {
  return quantity.display.percent ? 100.0 * value : scaled(quantity, value, mean_diameter);
}

std::string shown_title(const Quantity& quantity) {
  const std::string unit = quantity.display.percent ? "%" : scaled_unit(quantity);
  return quantity.display.title + (unit == "1" ? "" : " in " + unit);
}

}  // namespace talus
