/// Values that are kept in a file come back as they were, or not at all.

#include "ensemble/measured_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace talus {
namespace {

std::vector<MeasuredValues> some_values() {
  std::vector<MeasuredValues> thresholds(2);
  double next = 0.1;
  for (MeasuredValues& values : thresholds)
    for (Measured& measured : values) measured = {next *= -1.7, next > 1.0};
  thresholds[1][3].value = std::numeric_limits<double>::quiet_NaN();
  return thresholds;
}

TEST(MeasuredFile, gives_back_every_bit) {
  const auto before = some_values();
  const auto after = parse_measured(measured_text("abc", before), "abc");
  ASSERT_TRUE(after.has_value());
  ASSERT_EQ(after->size(), 2u);
  for (std::size_t f = 0; f < 2; ++f)
    for (std::size_t q = 0; q < quantity_count; ++q) {
      const Measured& was = before[f][q];
      const Measured& is = (*after)[f][q];
      EXPECT_TRUE(is.value == was.value || (std::isnan(is.value) && std::isnan(was.value))) << f << " " << q;
      EXPECT_EQ(is.at_most, was.at_most);
    }
}

TEST(MeasuredFile, of_another_analysis_is_not_taken) {
  EXPECT_FALSE(parse_measured(measured_text("abc", some_values()), "abd").has_value());
  EXPECT_FALSE(parse_measured("", "abc").has_value());
}

TEST(MeasuredFile, that_is_not_whole_is_not_taken) {
  const std::string text = measured_text("abc", some_values());
  const std::size_t last = text.rfind('\n', text.size() - 2);
  EXPECT_FALSE(parse_measured(text.substr(0, last + 1), "abc").has_value()) << "a line is missing";
  EXPECT_FALSE(parse_measured(text + text.substr(last + 1), "abc").has_value()) << "a line too many";
  std::string words = text;
  words.replace(words.find("0,1,"), 5, "0,1,x");
  EXPECT_FALSE(parse_measured(words, "abc").has_value()) << "no number";
  EXPECT_FALSE(parse_measured(text.substr(0, text.find("0,0,")), "abc").has_value()) << "no values";
}

}  // namespace
}  // namespace talus
