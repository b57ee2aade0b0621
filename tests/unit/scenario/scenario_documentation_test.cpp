/// docs/scenario.md agrees with the table of keys in the code, and the scenarios of assets/ are those of the
/// paper.

#include <gtest/gtest.h>

#include <set>

#include "scenario/keys.h"
#include "scenario/scripted_command.h"
#include "scenario/text.h"
#include "support/key_rows.h"
#include "support/places.h"

namespace talus::scenario {
namespace {

const std::string root = test::source_folder();

TEST(ScenarioKeys, are_documented_as_they_are) {
  std::string expected;
  for (const ScenarioKey& key : scenario_keys()) expected += row_text(key, toml_text(key.get(Scenario{})));
  for (const CommandKey& key : command_keys()) {
    std::string row = row_text(key, "-");
    expected += row.replace(row.find("`-`"), 3, "-");  // none of them has a default
  }
  EXPECT_EQ(rows_of("docs/scenario.md"), expected) << "the table of docs/scenario.md must be:\n" << expected;
}

TEST(ScenarioKeys, stand_once_and_admit_their_defaults) {
  std::set<std::string> names;
  for (const ScenarioKey& key : scenario_keys()) {
    EXPECT_TRUE(names.insert(full_name(key)).second) << full_name(key);
    EXPECT_EQ(find_key(full_name(key)), &key);
    EXPECT_EQ(admitted(key, key.get(Scenario{})), key.get(Scenario{})) << full_name(key);
  }
}

Scenario asset(const std::string& name) { return read_scenario(root + "/assets/scenarios/" + name); }

/// Returns a bed with mu = 0.5, size ratio 1.5, no restitution, H = 40 D, rough floor, 1 deg/s, 0.001 deg per
/// step, run to repose.
Scenario paper_bed(BedBoundary boundary, double length) {
  Scenario scenario;
  scenario.grains.size_ratio = 1.5;
  scenario.contact = {.friction = 0.5,
                      .wall_friction = 0.5,
                      .rolling_friction = 0.0,
                      .restitution = 0.0,
                      .tangential_restitution = 0.0};
  scenario.bed = {.boundary = boundary, .length = length, .depth = 40.0, .floor = BedFloor::rough};
  scenario.tilt = {.rate = 1.0, .step = 0.001, .end_angle = std::nullopt, .program = {}};
  return scenario;
}

TEST(Assets, have_the_values_of_the_paper) {
  EXPECT_EQ(asset("paper-pbc.toml"), paper_bed(BedBoundary::periodic, 200.0));
  for (int length : {100, 150, 200, 250, 300})
    EXPECT_EQ(asset("paper-wbc-" + std::to_string(length) + ".toml"), paper_bed(BedBoundary::walls, length));
}

TEST(Assets, have_a_small_demo) {
  Scenario expected = paper_bed(BedBoundary::periodic, 50.0);
  expected.bed.depth = 20.0;
  EXPECT_EQ(asset("demo.toml"), expected);
  expected.tilt.after_failure = AfterFailure::lower;
  EXPECT_EQ(asset("dynamic-angle.toml"), expected) << "the same bed, lowered after failure";
  expected.tilt.after_failure = AfterFailure::stop;
  expected.tilt.program = {"to 12", "to 0", "10 times", "to repose"};
  expected.output.frame_every = 0.5;
  EXPECT_EQ(asset("cycles.toml"), expected) << "the same bed, in cycles";
}

}  // namespace
}  // namespace talus::scenario
