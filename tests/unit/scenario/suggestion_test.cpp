/// Suggestions ("did you mean").

#include "scenario/suggestion.h"

#include <gtest/gtest.h>

#include "scenario/keys.h"

namespace talus::scenario {
namespace {

const KeyHeads keys = heads(scenario_keys());

TEST(Suggestion, of_a_key_prefers_its_own_section) {
  EXPECT_EQ(suggest_key(keys, "deposition", "fricton"), "; did you mean 'deposition.friction'?");
  EXPECT_EQ(suggest_key(keys, "contact", "fricton"), "; did you mean 'contact.friction'?");
  EXPECT_EQ(suggest_key(keys, "solver", "tolerence"), "; did you mean 'solver.tolerance'?");
  EXPECT_EQ(suggest_key(keys, "solver", "MAX_ITERATIONS"), "; did you mean 'solver.max_iterations'?");
}

TEST(Suggestion, of_a_key_looks_at_other_sections_too) {
  EXPECT_EQ(suggest_key(keys, "bed", "mean_diametre"), "; did you mean 'grains.mean_diameter'?");
  EXPECT_EQ(suggest_key(keys, "bed", "rate"), "; 'rate' belongs to [deposition] or [tilt]");
  EXPECT_EQ(suggest_key(keys, "", "friction"), "; 'friction' belongs to [contact] or [deposition]");
  EXPECT_EQ(suggest_key(keys, "bed", "seed"),
            "; 'seed' belongs to the top of the file, above the first section");
}

TEST(Suggestion, of_a_key_knows_it_by_one_word_of_its_name) {
  EXPECT_EQ(suggest_key(keys, "solver", "iteration"), "; did you mean 'solver.max_iterations'?");
  EXPECT_EQ(suggest_key(keys, "bed", "iterations"), "; [bed] has boundary, length, depth, floor");
  EXPECT_EQ(suggest_key(keys, "guards", "vel"),
            "; [guards] has action, velocity, overlap, energy, unconverged");
}

TEST(Suggestion, says_what_there_is_where_nothing_is_near) {
  EXPECT_EQ(suggest_key(keys, "tilt", "speed"),
            "; [tilt] has rate, step, end_angle, program, after_failure, lowering_rate");
  EXPECT_EQ(suggest_key(keys, "tilt", ""),
            "; [tilt] has rate, step, end_angle, program, after_failure, lowering_rate");
  EXPECT_TRUE(suggest_key(keys, "", "viscosity").starts_with("; expected seed, or a section: [grains], "));
  EXPECT_EQ(suggest_key(keys, "tilt", std::string(100000, 'r')),
            "; [tilt] has rate, step, end_angle, program, after_failure, lowering_rate");
}

TEST(Suggestion, of_a_section) {
  EXPECT_EQ(suggest_section(keys, "solvers"), "; did you mean [solver]?");
  EXPECT_EQ(suggest_section(keys, "Grain"), "; did you mean [grains]?");
  EXPECT_EQ(
      suggest_section(keys, "magic"),
      "; expected one of [grains], [contact], [bed], [deposition], [tilt], [solver], [output], [guards]");
}

}  // namespace
}  // namespace talus::scenario
