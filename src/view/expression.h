#pragma once
/// Conditions on named numbers: "gamma > 0.7 && y > 30".

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus::view {

/// Name that a condition may contain.
struct ExpressionName {
  std::string name;
  bool flag = false;  ///< either 1 or 0, so that the name is itself a condition: "overloaded && y > 30"
};

/// Parsed condition as a sequence of operations in order of evaluation.
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
    double number = 0.0;   ///< value of a number
    std::size_t name = 0;  ///< index of a name in `names`
  };
  std::vector<Step> steps;
  std::vector<std::string> names;  ///< names used, in order of first appearance
};

/// Parses a condition. It consists of numbers, names, + - * /, abs(...) and sqrt(...); comparisons of two of
/// these by < <= > >= == !=; and && || ! applied to comparisons. Parentheses are allowed anywhere. ! applies
/// to the comparison that follows it, and && binds more tightly than ||. Throws Error(usage) with the text,
/// the column (counted from 1), what was found, what was expected, and a suggestion. Conditions that could be
/// parsed but are nearly always mistakes are also errors: "0.5 < gamma < 0.7", "gamma = 0.7", "gamma > 0,7".
Expression parse_condition(std::string_view text, std::span<const ExpressionName> names);

/// Returns whether the condition holds for these values, given in the order of Expression::names. A
/// comparison with NaN (no value) never holds, not even !=.
bool holds(const Expression& condition, std::span<const double> values);

}  // namespace talus::view
