#include "analysis/quantities.h"

#include <algorithm>
#include <cmath>

#include "base/errors.h"
#include "core/trigonometry.h"

namespace talus::analysis {
namespace {

/// Returns the numbers of one member of the record of a run, a threshold or a frame.
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

/// Calls use(record) for each record of one type, in the order in which values are stored.
template <typename Record, typename SomeAnalysis, typename Use>
void for_each_record(SomeAnalysis& analysis, const Use& use) {
  if constexpr (std::is_same_v<Record, Analysis>)
    use(analysis);
  else if constexpr (std::is_same_v<Record, RunThreshold>)
    std::ranges::for_each(analysis.thresholds, use);
  else if constexpr (std::is_same_v<Record, EventRecord>)
    std::ranges::for_each(analysis.events, use);
  else
    for (auto& frame : analysis.frames) {
      if constexpr (std::is_same_v<Record, FrameRecord>)
        use(frame);
      else
        std::ranges::for_each(frame.thresholds, use);
    }
}

/// Converts a value to the type in the record: rounded if it is an integer, which is 0 for NaN.
template <typename Number>
Number number_from(double value) {
  if constexpr (std::is_same_v<Number, Index>)
    return std::isnan(value) ? 0 : static_cast<Index>(std::lround(value));
  else
    return value;
}

/// Returns the frame itself or its record at threshold f; null if it has none.
template <typename Record, typename SomeFrame>
auto* record_of(SomeFrame& frame, std::size_t f) {
  if constexpr (std::is_same_v<Record, FrameRecord>)
    return &frame;
  else
    return f < frame.thresholds.size() ? &frame.thresholds[f] : nullptr;
}

template <typename T>
inline constexpr bool is_fixed_list = false;
template <typename T, std::size_t n>
inline constexpr bool is_fixed_list<std::array<T, n>> = true;

/// Whether the member is a list in the sense of is_list_of_frame. Vectors at thresholds are lists of grains.
template <typename Record, typename T>
inline constexpr bool is_list = (std::is_same_v<Record, FrameRecord> &&
                                 (is_fixed_list<T> || std::is_same_v<T, std::vector<double>>)) ||
                                (std::is_same_v<Record, FrameThreshold> && is_fixed_list<T>);

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
  const auto set = [value]<typename Number>(Number& number) { number = number_from<Number>(value); };
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

bool is_list_of_frame(const Quantity& quantity) {
  return std::visit([]<typename Record, typename T>(T Record::*) { return is_list<Record, T>; },
                    quantity.member);
}

bool is_list_of_run(const Quantity& quantity) {
  return std::holds_alternative<std::vector<double> Analysis::*>(quantity.member);
}

std::vector<double> list_of(const Quantity& quantity, const FrameRecord& frame, std::size_t f) {
  std::vector<double> list;
  std::visit(
      [&]<typename Record, typename T>(T Record::*member) {
        if constexpr (is_list<Record, T>)
          if (const Record* const record = record_of<Record>(frame, f))
            list.assign((record->*member).begin(), (record->*member).end());
      },
      quantity.member);
  return list;
}

double number_of(const Quantity& quantity, const Analysis& analysis, std::size_t k) {
  const Values values = values_of(quantity, analysis);
  const auto* numbers = std::get_if<std::vector<double>>(&values);
  return numbers != nullptr && k < numbers->size() ? (*numbers)[k] : not_known;
}

bool needs_threshold(const Quantity& quantity) { return quantity.shape.find('F') != std::string::npos; }

bool is_of_events(const Quantity& quantity) { return quantity.shape.find('E') != std::string::npos; }

double scaled(std::string_view unit, double value, double mean_diameter) {
  if (unit == "m") return value / mean_diameter;
  return unit == "rad" ? degrees(value) : value;
}

std::string scaled_unit(std::string_view unit) {
  if (unit == "m") return "D";
  return std::string(unit == "rad" ? "deg" : unit);
}

std::string axis_title(std::string_view text, std::string_view unit) {
  if (unit == "1") return std::string(text);
  return std::string(text) + " (" + std::string(unit == "deg" ? "°" : unit) + ")";
}

double shown(const Quantity& quantity, double value, double mean_diameter) {
  return quantity.display.percent ? 100.0 * value : scaled(quantity.unit, value, mean_diameter);
}

std::string shown_title(const Quantity& quantity) {
  return axis_title(quantity.display.title, quantity.display.percent ? "%" : scaled_unit(quantity.unit));
}

}  // namespace talus::analysis
