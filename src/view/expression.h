#pragma once
/// Conditions on named numbers: "gamma > 0.7 && y > 30".

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus::view {

/// A name that a condition may have.
struct ExpressionName {
  std::string name;
  bool flag = false;  ///< 1 or 0, and so by itself a condition: "overloaded && y > 30"
};

/// A condition that was read: what is done with numbers, in the order in which it is done.
struct Expression {
  enum class Operation {
    number,
    name,
    negative,
    absolute,
    root,
    plus,
    minus,
    times,
    over,
    less,
    at_most,
    greater,
    at_least,
    equal,
    unequal,
    both,
    either,
    no
  };
  struct Step {
    Operation operation = Operation::number;
    double number = 0.0;   ///< of a number
    std::size_t name = 0;  ///< of a name: its place in `names`
  };
  std::vector<Step> steps;
  std::vector<std::string> names;  ///< that are used, in the order in which they come first
};

/// Reads a condition. It is made of numbers, names, + - * /, abs(...) and sqrt(...); comparisons of two of
/// these by < <= > >= == !=; and && || ! of comparisons; with parentheses anywhere. ! is of the comparison
/// after it, && binds more closely than ||. Throws Error(usage): the text, the column (counted from 1), what
/// was found, what was expected, and what may have been meant. What would be read but is nearly always meant
/// otherwise is an error, too: "0.5 < gamma < 0.7", "gamma = 0.7", "gamma > 0,7".
Expression parse_condition(std::string_view text, std::span<const ExpressionName> names);

/// Whether it holds for these values, which are in the order of Expression::names. A comparison with NaN
/// never holds, != included: where there is no value, nothing is to be said of it.
bool holds(const Expression& condition, std::span<const double> values);

}  // namespace talus::view
