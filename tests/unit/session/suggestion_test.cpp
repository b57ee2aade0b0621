/// "Did you mean".

#include <gtest/gtest.h>

#include "session/scenario_suggestion.h"

namespace talus {
namespace {

TEST(EditDistance, counts_insertions_deletions_and_replacements) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("abc", ""), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("friction", "friction"), 0u);
  EXPECT_EQ(edit_distance("fricton", "friction"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("step", "pets"), 4u);
}

TEST(Suggestion, of_a_key_prefers_its_own_section) {
  EXPECT_EQ(suggest_key("deposition", "fricton"), "; did you mean 'deposition.friction'?");
  EXPECT_EQ(suggest_key("contact", "fricton"), "; did you mean 'contact.friction'?");
  EXPECT_EQ(suggest_key("solver", "tolerence"), "; did you mean 'solver.tolerance'?");
  EXPECT_EQ(suggest_key("solver", "MAX_ITERATIONS"), "; did you mean 'solver.max_iterations'?");
}

TEST(Suggestion, of_a_key_looks_at_other_sections_too) {
  EXPECT_EQ(suggest_key("bed", "mean_diametre"), "; did you mean 'grains.mean_diameter'?");
  EXPECT_EQ(suggest_key("bed", "rate"), "; 'rate' belongs to [deposition] or [tilt]");
  EXPECT_EQ(suggest_key("", "friction"), "; 'friction' belongs to [contact] or [deposition]");
  EXPECT_EQ(suggest_key("bed", "seed"), "; 'seed' belongs to the top of the file, above the first section");
}

TEST(Suggestion, says_what_there_is_where_nothing_is_near) {
  EXPECT_EQ(suggest_key("tilt", "speed"), "; [tilt] has rate, step, end_angle, after_failure, lowering_rate");
  EXPECT_EQ(suggest_key("tilt", ""), "; [tilt] has rate, step, end_angle, after_failure, lowering_rate");
  EXPECT_TRUE(suggest_key("", "viscosity").starts_with("; expected seed, or a section: [grains], "));
  EXPECT_EQ(suggest_key("tilt", std::string(100000, 'r')),
            "; [tilt] has rate, step, end_angle, after_failure, lowering_rate");
}

TEST(Suggestion, of_a_section) {
  EXPECT_EQ(suggest_section("solvers"), "; did you mean [solver]?");
  EXPECT_EQ(suggest_section("Grain"), "; did you mean [grains]?");
  EXPECT_EQ(
      suggest_section("magic"),
      "; expected one of [grains], [contact], [bed], [deposition], [tilt], [solver], [output], [guards]");
}

}  // namespace
}  // namespace talus
