/// Beds from files: tables and frames of runs.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <fstream>

#include "base/errors.h"
#include "io/run_file.h"
#include "session/deposition.h"
#include "session/estimate.h"
#include "support/exit_code.h"
#include "support/recorded_run.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::session {
namespace {

dynamics::BedPlan plan_of(bool periodic = true, bool rough = true) {
  dynamics::BedPlan plan;
  plan.length = 10.0 * plan.mean_diameter;
  plan.periodic = periodic;
  plan.rough_floor = rough;
  return plan;
}

/// Table in a separate folder.
struct Table {
  explicit Table(const std::string& text) : path(folder.path("bed.csv")) { std::ofstream(path) << text; }
  test::TemporaryFolder folder;
  std::string path;
};

/// Returns the message without the name of the folder.
std::string message_of(const std::string& path, std::size_t frame, const dynamics::BedPlan& plan,
                       ExitCode code) {
  const auto [found, message] = test::refusal_of([&] { bed_of_file({path, static_cast<int>(frame)}, plan); });
  if (found == ExitCode::done) return "accepted";
  EXPECT_EQ(found, code);
  const std::string folder = std::filesystem::path(path).parent_path().string() + "/";
  return message.starts_with(folder) ? message.substr(folder.size()) : message;
}

std::string message_of(const std::string& table, const dynamics::BedPlan& plan = plan_of()) {
  return message_of(Table(table).path, 0, plan, ExitCode::bad_data);
}

TEST(BedOfTable, has_its_grains_at_rest_between_floor_and_walls_of_the_plan) {
  const Table table("x,y,radius\n0.6,0.5,0.5\n5,1,0.6\n");
  for (const bool periodic : {true, false}) {
    const dynamics::BedPlan plan = plan_of(periodic);
    const World world = bed_of_file({table.path}, plan);
    ASSERT_EQ(world.grains.free_count, 2);
    EXPECT_EQ(world.grains.count(), 12);
    EXPECT_EQ(world.boundary.planes.size(), periodic ? 0u : 2u);
    EXPECT_EQ(world.grains.x[1], 5.0 * plan.mean_diameter);
    EXPECT_EQ(world.grains.y[1], 1.0 * plan.mean_diameter);
    EXPECT_EQ(world.grains.radius[1], 0.6 * plan.mean_diameter);
    EXPECT_GT(world.grains.inverse_mass[1], 0.0);
    EXPECT_EQ(kinetic_energy(world.grains), 0.0);
    EXPECT_EQ(world.contacts.count(), 0);
  }
}

TEST(BedOfTable, may_overlap_by_a_hundredth_of_a_diameter) {
  EXPECT_EQ(message_of("3,2,0.5\n3.991,2,0.5\n"), "accepted");
  EXPECT_NE(message_of("3,2,0.5\n3.989,2,0.5\n"), "accepted");
  EXPECT_TRUE(message_of("3,2,0.5\n6,2,0.5\n\n3.75,2,0.5\n")
                  .starts_with("bed.csv:4:1: error: the grain overlaps with the grain in line 1 by 0.25"));
  EXPECT_TRUE(message_of("9.75,2,0.5\n0.5,2,0.5\n")
                  .starts_with("bed.csv:2:1: error: the grain overlaps with the grain in line 1 by 0.25"))
      << "through the periodic edge";
  EXPECT_EQ(message_of("9.75,2,0.5\n0.5,2,0.5\n", plan_of(false)).find("line 1 by"), std::string::npos);
}

TEST(BedOfTable, tells_the_deepest_overlap) {
  EXPECT_TRUE(message_of("3,2,0.5\n3.9,2,0.5\n6,2,0.5\n6.5,2,0.5\n")
                  .starts_with("bed.csv:4:1: error: the grain overlaps with the grain in line 3 by 0.5"));
}

TEST(BedOfTable, stays_within_walls_and_above_the_floor) {
  EXPECT_EQ(message_of("0.495,2,0.5\n9.505,2,0.5\n", plan_of(false)), "accepted");
  EXPECT_TRUE(message_of("0.25,2,0.5\n", plan_of(false))
                  .starts_with("bed.csv:1:1: error: the grain overlaps with the wall at x = 0 by 0.25"));
  EXPECT_TRUE(
      message_of("12,2,0.5\n", plan_of(false))
          .starts_with("bed.csv:1:1: error: the grain overlaps with the wall at x = bed.length by 2.5"));
  EXPECT_TRUE(message_of("5,0.25,0.5\n", plan_of(true, false))
                  .starts_with("bed.csv:1:1: error: the grain overlaps with the floor by 0.25"));
  EXPECT_TRUE(message_of("5.5,0.25,0.5\n")
                  .starts_with("bed.csv:1:1: error: the grain overlaps with a grain of the floor by 0.25"));
  EXPECT_EQ(message_of("5.5,-7,0.5\n"),
            "bed.csv:1:1: error: the grain is below the floor: y = -7 D, expected a position above the floor "
            "grains, whose tops are at 0");
}

// A run with such a grain could not be read.
TEST(BedOfTable, has_no_grain_that_a_run_cannot_store) {
  std::string many;
  for (int k = 0; k < 40; ++k) many += fmt::format("{},{},0.51\n", 1.0 + 2 * (k % 4), 1 + 2 * (k / 4));
  EXPECT_EQ(message_of(many + "1,30,0.001\n"), "accepted");
  for (const std::string radius : {"0.0009", "1e-300"})
    EXPECT_EQ(message_of(many + "1,30," + radius + "\n"),
              "bed.csv:41:1: error: the grain has a radius of " + radius + " D: expected 0.001 to 1000 D");
  const Table far(many + "1,130001,0.5\n"), near(many + "1,129999,0.5\n");
  const dynamics::BedPlan plan = plan_of();
  const double depth = 3.0 * plan.mean_diameter;  // 1e4 (10 D + 3 D) is the farthest place
  EXPECT_TRUE(test::refuses([&] { bed_of_file({.path = far.path, .depth = depth}, plan); },
                            ExitCode::bad_data,
                            {"bed.csv:41:1: error: the grain is at x = 1 D, y = 130001 D: expected at most "
                             "130000 D from the origin"}));
  EXPECT_EQ(bed_of_file({.path = near.path, .depth = depth}, plan).grains.free_count, 41);
}

/// Returns the places of the grains of a dump with a box from -5 to 5 D, or the message.
std::string placed(const std::string& flags, bool periodic, const std::string& bounds = "-5 5") {
  const Table dump("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS " + flags + "\n" + bounds +
                   "\n0 20\n-1 1\nITEM: ATOMS id x y radius\n1 -3 0.5 0.5\n2 0 0.5 0.5\n3 3 0.5 0.5\n");
  const dynamics::BedPlan plan = plan_of(periodic, false);
  const std::string message = message_of(dump.path, 0, plan, ExitCode::bad_data);
  if (message != "accepted") return message;
  std::string places;
  for (const double x : bed_of_file({dump.path}, plan).grains.x)
    places += fmt::format("{:.6g} ", x / plan.mean_diameter);
  return places;
}

TEST(BedOfDump, is_moved_with_its_box) {
  EXPECT_EQ(placed("pp ff pp", true), "2 5 8 ");
  EXPECT_EQ(placed("ff ff pp", false), "2 5 8 ") << "the room between the walls";
  EXPECT_EQ(placed("", true), "2 5 8 ");
  EXPECT_EQ(placed("", false), "2 5 8 ");
  EXPECT_EQ(placed("pp ff pp", true, "-4 6"), "1 4 7 ");
  EXPECT_EQ(placed("pp ff pp", true, "-2 8"), "9 2 5 ") << "unwrapped";
}

TEST(BedOfDump, whose_box_is_that_of_another_bed_is_refused) {
  for (const char* flags : {"ff ff pp", "ff pp", "ss pp pp"})
    EXPECT_EQ(placed(flags, true),
              "bed.csv: its box is not periodic along x: expected bed.boundary = \"walls\", or a box with "
              "the flags "
              "pp (pbc=\"T ...\")");
  EXPECT_EQ(placed("pp ff pp", false),
            "bed.csv: its box is periodic along x: expected bed.boundary = \"periodic\", or a box with the "
            "flags ff "
            "(pbc=\"F ...\")");
  EXPECT_EQ(
      placed("pp ff pp", true, "-6 6"),
      "bed.csv: its periodic box is 12 D long: expected bed.length = 10 D; check deposition.file_unit and "
      "deposition.file_scale");
  const std::string walls = placed("ff ff pp", false, "-6 6");
  EXPECT_TRUE(walls.starts_with("bed.csv:10:1: error: the grain overlaps with the wall at x = 0 by 3.5 D"))
      << walls;
  EXPECT_TRUE(
      walls.ends_with("; the box of the file is from -6 to 6 D along x: one of bed.length = 10 D would be "
                      "shifted to begin at 0"))
      << walls;
}

TEST(BedOfTable, stays_within_the_period) {
  EXPECT_EQ(message_of("0,2,0.5\n9.99,5,0.5\n"), "accepted");
  for (const char* x : {"10", "-0.5"})
    EXPECT_EQ(message_of(std::string(x) + ",2,0.5\n"),
              std::string("bed.csv:1:1: error: the grain is outside the period: x = ") + x +
                  " D, expected a number in [0, 10)");
}

TEST(BedOfTable, is_in_mean_diameters) {
  EXPECT_EQ(message_of("3,2,0.54\n"), "accepted");
  EXPECT_EQ(message_of("3,2,0.46\n"), "accepted");
  EXPECT_EQ(message_of("3,2,0.25\n"),
            "bed.csv: the mean diameter of its grains is 0.5 D: expected 1 D within 10 %, with D = 0.01 m "
            "(grains.mean_diameter); for a table in mm, set deposition.file_unit = \"mm\" or name its "
            "columns as in x [mm]");
  EXPECT_EQ(bed_of_file({Table("30 20 5.4\n").path, 0, scenario::LengthUnit::millimetre}, plan_of())
                .grains.radius[0],
            0.0054);
  EXPECT_NE(message_of("3,2,1e308\n3,2,1e308\n"), "accepted");
}

TEST(BedOfTable, of_soft_grains_is_pushed_apart_if_that_is_asked_for) {
  const std::string soft = "3,2,0.5\n3.92,2,0.5\n9.96,4,0.5\n0.9,4,0.5\n5,0.45,0.5\n";
  EXPECT_TRUE(message_of(soft).ends_with("deposition.relax = true pushes overlaps of up to 0.1 D apart"));
  const Table table(soft);
  const dynamics::BedPlan plan = plan_of(true, false);
  std::string remark;
  const World world =
      bed_of_file({table.path, 0, scenario::LengthUnit::mean_diameter, 1.0, true}, plan, &remark);
  EXPECT_EQ(remark,
            table.path + ": overlaps pushed apart, which moved grains by 0.038 D on average, 0.05 D at most");
  const double d = plan.mean_diameter;
  EXPECT_NEAR(world.grains.x[0], 2.96 * d, 1e-12);
  EXPECT_NEAR(world.grains.x[1], 3.96 * d, 1e-12);
  EXPECT_NEAR(world.grains.x[2], 9.93 * d, 1e-12) << "across the periodic edge";
  EXPECT_NEAR(world.grains.x[3], 0.93 * d, 1e-12);
  EXPECT_NEAR(world.grains.y[4], 0.5 * d, 1e-12) << "the floor is unchanged";
  EXPECT_EQ(state_hash(world), state_hash(bed_of_file({table.path, 0, {}, 1.0, true}, plan)));
  const Table deeper("3,2,0.5\n3.89,2,0.5\n");
  EXPECT_THROW(bed_of_file({deeper.path, 0, {}, 1.0, true}, plan), LocatedError);
}

TEST(BedOfTable, that_is_dense_and_soft_can_be_pushed_apart) {
  std::string table;
  for (int row = 0; row < 12; ++row)
    for (int k = 0; k < 10; ++k)
      table += fmt::format("{},{},0.5\n", k + 0.5 * (row % 2) + 0.01, 0.45 + 0.82 * row);
  World world = bed_of_file({Table(table).path, 0, {}, 1.0, true}, plan_of(true, false));
  EXPECT_EQ(world.grains.free_count, 120);
}

TEST(BedOfDump, fits_the_period_and_leaves_out_another_floor) {
  const std::string head = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp ff ff\n0 ";
  const std::string rows =
      "\n0 1\n0 1\nITEM: ATOMS x y radius type\n12.5 0.5 0.5 1\n0.5 -0.5 0.5 2\n1.5 -0.5 0.5 2\n";
  const Table dump(head + "10" + rows);
  std::string remark;
  const World world = bed_of_file({dump.path}, plan_of(true, false), &remark);
  EXPECT_EQ(world.grains.free_count, 1);
  EXPECT_NEAR(world.grains.x[0], 0.025, 1e-15) << "unwrapped before";
  EXPECT_EQ(remark, dump.path + ": ignored: type; 2 grains with their tops at y = 0 left out as the floor");
  EXPECT_TRUE(
      message_of(head + "11" + rows).starts_with("bed.csv: its periodic box is 11 D long: expected "));
  EXPECT_TRUE(message_of("3,2,0.005\n").ends_with("; it fits with deposition.file_unit = \"m\""));
}

TEST(BedOfTable, has_grains_and_no_frames) {
  EXPECT_EQ(message_of("# none\n"), "bed.csv: no grains: expected lines with x, y and radius");
  const Table table("3,2,0.5\n");
  EXPECT_EQ(message_of(table.path, 1, plan_of(), ExitCode::bad_data),
            "bed.csv: a table has no frames: expected deposition.frame = 0");
}

TEST(BedOfFile, says_what_a_missing_one_is_needed_for) {
  const test::TemporaryFolder folder;
  for (const char* name : {"bed.csv", "run.h5"}) {
    const std::string message = message_of(folder.path(name), 0, plan_of(), ExitCode::missing_input);
    EXPECT_TRUE(message.starts_with(std::string(name) + ": ")) << message;
    EXPECT_NE(message.find("needed to start or replay a run, but not to resume it"), std::string::npos);
  }
}

/// Incomplete run of 30 grains; in each of its three frames a different grain is raised.
struct StoredRun {
  StoredRun() : path(folder.path("run.h5")) {
    scenario::Scenario scenario = test::small_bed();
    scenario.deposition.method = scenario::DepositionMethod::geometric;
    const Session session(scenario);
    io::RunStore store = io::RunStore::create(path, run_header(session, {}), false);
    io::Segment segment;
    for (int k = 0; k < 3; ++k) {
      World world = session.world();
      world.step = k;
      world.tilt = 0.01 * k;
      world.grains.y[29 - k] += 0.05;
      world.grains.x[29 - k] = 0.1 - 1e-12;  // equals the period in single precision
      segment.frames.push_back(make_frame(world, session.law()));
    }
    store.commit(segment, session.checkpoint(0.0));
  }
  test::TemporaryFolder folder;
  std::string path;
};

scenario::Scenario scenario_of(const std::string& file, int frame = 0) {
  scenario::Scenario scenario = test::small_tilted_bed(0.1);
  scenario.deposition.method = scenario::DepositionMethod::file;
  scenario.deposition.file = file;
  scenario.deposition.frame = frame;
  return scenario;
}

TEST(BedOfRun, has_the_grains_of_the_frame_that_is_asked_for) {
  const StoredRun run;
  const io::RunFile file = io::RunFile::open(run.path);
  for (const std::size_t k : {0u, 2u}) {
    const World world = bed_of_file({run.path, static_cast<int>(k)}, plan_of());
    const Frame frame = file.positions(k);
    ASSERT_EQ(world.grains.free_count, 30);
    for (std::size_t i = 0; i < 30; ++i) {
      EXPECT_NEAR(std::remainder(world.grains.x[i] - frame.x[i], 0.1), 0.0, 1e-12);
      EXPECT_GE(world.grains.x[i], 0.0);
      EXPECT_LT(world.grains.x[i], 0.1);
      EXPECT_EQ(world.grains.y[i], frame.y[i]);
      EXPECT_EQ(world.grains.radius[i], file.header().statics.radius[i]);
      EXPECT_EQ(world.grains.mass[i], file.header().statics.mass[i]);
    }
  }
}

TEST(BedOfRun, fits_the_plan) {
  const StoredRun run;
  EXPECT_EQ(message_of(run.path, 3, plan_of(), ExitCode::bad_data),
            "run.h5: there is no frame 3: expected deposition.frame below 3, the number of its frames");
  EXPECT_THROW(bed_of_file({run.path, 0, scenario::LengthUnit::metre}, plan_of()), Error);
  EXPECT_EQ(message_of(run.path, 0, plan_of(false), ExitCode::bad_data),
            "run.h5: the run has a periodic bed: expected bed.boundary = \"periodic\"");
  dynamics::BedPlan longer = plan_of();
  longer.length *= 1.1;
  EXPECT_EQ(message_of(run.path, 0, longer, ExitCode::bad_data),
            "run.h5: the period of the run is 0.1 m, but bed.length makes it 0.11 m; use the values of the "
            "run in the scenario (talus info)");
  dynamics::BedPlan larger = plan_of();
  larger.mean_diameter *= 1.05;
  EXPECT_EQ(message_of(run.path, 0, larger, ExitCode::bad_data),
            "run.h5: the mean diameter of the run is 0.01 m, but grains.mean_diameter makes it 0.0105 m; use "
            "the values of the run in the scenario (talus info)");
}

TEST(RunOfFile, has_as_many_grains_as_the_file) {
  const StoredRun run;
  scenario::Scenario scenario = scenario_of(run.path);
  scenario.bed.depth = 100.0;
  EXPECT_EQ(grain_count(scenario), 30);
  EXPECT_EQ(estimate(scenario).grains, 30);
  EXPECT_EQ(run_statics(scenario, initial_bed(scenario)).free_count, 30);
}

TEST(RunOfFile, comes_to_rest_and_goes_on_without_the_file) {
  std::optional<Session> whole, first;
  {
    const StoredRun run;
    whole.emplace(scenario_of(run.path, 1));
    first.emplace(whole->scenario());
  }
  test::run_session(*whole);
  for (int k = 0; k < 20; ++k) first->advance();
  Session second(first->scenario(), first->checkpoint(0.0));
  test::run_session(second);
  EXPECT_EQ(state_hash(second.world()), state_hash(whole->world()));
  EXPECT_THROW(Session{whole->scenario()}, Error) << "a replay begins with the file";
}

}  // namespace
}  // namespace talus::session
