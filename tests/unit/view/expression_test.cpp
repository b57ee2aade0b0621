/// Conditions: their meaning, and the messages for invalid ones.

#include "view/expression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/errors.h"

namespace talus::view {
namespace {

const std::vector<ExpressionName> names = {
    {"gamma", false}, {"y", false}, {"overloaded", true}, {"lc", false}};

/// Evaluates a condition with gamma = 0.6, y = 40, overloaded = 1 and lc unknown.
bool is_true(const std::string& text) {
  const std::map<std::string, double> values = {
      {"gamma", 0.6}, {"y", 40.0}, {"overloaded", 1.0}, {"lc", std::nan("")}};
  const Expression condition = parse_condition(text, names);
  std::vector<double> row;
  for (const std::string& name : condition.names) row.push_back(values.at(name));
  return holds(condition, row);
}

std::string error_of(const std::string& text) {
  try {
    parse_condition(text, names);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    return error.what();
  }
  return "none";
}

TEST(Condition, comparisons_are_those_of_numbers) {
  for (const char* text : {"gamma < 0.7", "gamma <= 0.6", "gamma > .5", "gamma >= 0.6", "gamma == 6e-1",
                           "y != 39", "gamma<0.7", "  gamma\t< 0.7 ", "-gamma < 0", "0.7 > gamma", "y > -1"})
    EXPECT_TRUE(is_true(text)) << text;
  for (const char* text : {"gamma < 0.6", "gamma > 0.6", "gamma >= 0.61", "gamma == 0.5", "y != 40"})
    EXPECT_FALSE(is_true(text)) << text;
}

TEST(Condition, operators_bind_as_is_usual) {
  EXPECT_TRUE(is_true("1 + 2 * 3 == 7"));
  EXPECT_TRUE(is_true("(1 + 2) * 3 == 9"));
  EXPECT_TRUE(is_true("8 - 4 - 2 == 2"));
  EXPECT_TRUE(is_true("8 / 4 / 2 == 1"));
  EXPECT_TRUE(is_true("2 - -y == 42"));
  EXPECT_TRUE(is_true("-2 * 3 + 7 == 1"));
  EXPECT_TRUE(is_true("abs(gamma - 1) < 0.5 && sqrt(y * 10) == 20"));
  EXPECT_TRUE(is_true("y > 0 || y > 50 && y < 0")) << "&& before ||";
  EXPECT_FALSE(is_true("(y > 0 || y > 50) && y < 0"));
  EXPECT_FALSE(is_true("!gamma > 0.5")) << "applies to the comparison";
  EXPECT_FALSE(is_true("!(gamma > 0.5 || y > 50)"));
  EXPECT_TRUE(is_true("!!(gamma > 0.5) && !(y < 0)"));
}

TEST(Condition, a_flag_is_one_by_itself) {
  EXPECT_TRUE(is_true("overloaded"));
  EXPECT_FALSE(is_true("!overloaded"));
  EXPECT_TRUE(is_true("overloaded && y > 30"));
  EXPECT_TRUE(is_true("overloaded == 1"));
  EXPECT_TRUE(is_true("(overloaded) + 1 == 2"));
}

TEST(Condition, of_a_value_that_is_not_there_no_comparison_holds) {
  for (const char* text : {"lc > 0", "lc <= 0", "lc == lc", "lc != 3", "abs(lc) > 0"})
    EXPECT_FALSE(is_true(text)) << text;
  EXPECT_TRUE(is_true("!(lc > 0)"));
}

TEST(Condition, what_is_wrong_is_said_with_its_place) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "column 1: expected a condition, such as gamma > 0.7, found the end"},
      {"gamma >", "column 8: expected a number, a name or (, found the end"},
      {"gama > 1", "column 1: gama is not a quantity of a grain; did you mean 'gamma'?"},
      {"y > 1 && gama > 1", "column 10: gama"},
      {"gamma = 0.7", "column 7: expected an operator or the end, found '='; did you mean '=='?"},
      {"gamma => 1", "found '=>'; did you mean '>='?"},
      {"gamma > 1 and y > 2", "column 11: expected an operator or the end, found 'and'; did you mean '&&'?"},
      {"not gamma > 1", "found 'not'; did you mean '!'?"},
      {"gamma > 1 & y > 2", "column 11: expected an operator or the end, found '&'; did you mean '&&'?"},
      {"0.5 < gamma < 0.7", "column 13: expected && or || between two comparisons, found '<'"},
      {"gamma > 0,7", "found ','; write a decimal point, as in 0.7"},
      {"y > 30 D", "column 8: expected an operator or the end, found 'D'"},
      {"y > 30D",
       "column 7: expected an operator or the end after 30, found 'D'; write numbers without units"},
      {"(gamma > 1", "column 11: expected an operator or ), found the end"},
      {"gamma > 1)", "column 10: expected an operator or the end, found ')'"},
      {"gamma", "column 1: expected a condition, such as gamma > 0.7, found a number"},
      {"y > 1 && gamma", "column 10: expected a condition"},
      {"(gamma > 1) + 1 > 1", "column 1: expected a number, found a condition"},
      {"2 * (gamma > 1) > 1", "column 5: expected a number, found a condition"},
      {"sin(y) > 1", "column 1: sin is not a function; use abs or sqrt"},
      {"y > 1e999", "column 5: 1e999 is out of range"},
      {"\xCE\xB3 > 1", "column 1: expected a number, a name or (, found"},
  };
  for (const auto& [text, part] : cases)
    EXPECT_NE(error_of(text).find(part), std::string::npos) << error_of(text);
}

TEST(Condition, no_nesting_uses_up_the_stack) {
  EXPECT_NE(error_of(std::string(100000, '(')).find("at most 1000 characters, found 100000"),
            std::string::npos);
  EXPECT_TRUE(is_true(std::string(400, '(') + "y > 0" + std::string(400, ')')));
}

}  // namespace
}  // namespace talus::view
