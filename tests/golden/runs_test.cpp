/// Complete runs, compared bit for bit. The hashes below hold for every build of these sources: with any
/// number of threads, with and without optimisation, sanitizers or AVX2. A change that alters bits must be
/// listed in CHANGELOG.md and must update the hashes here.

#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>

#include "session/session.h"

namespace talus {
namespace {

/// Returns a bed that collapses, comes almost to rest and is tilted by a twentieth of a degree.
scenario::Scenario bed(double length, double depth) {
  scenario::Scenario scenario;
  scenario.bed.length = length;
  scenario.bed.depth = depth;
  scenario.deposition.method = scenario::DepositionMethod::collapse;
  scenario.deposition.rest_velocity = 0.1;
  scenario.tilt.end_angle = 0.05;
  return scenario;
}

std::string final_hash(const scenario::Scenario& scenario, int threads) {
  session::Session session(scenario);
  session.use_threads(threads);
  while (session.phase() != session::Phase::done) session.advance();
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, state_hash(session.world()));
  return text;
}

scenario::Scenario poured_bed(double length, double depth) {
  scenario::Scenario scenario = bed(length, depth);
  scenario.deposition.method = scenario::DepositionMethod::pour;
  scenario.deposition.rate = 1.0;
  return scenario;
}

TEST(GoldenRun, on_one_and_two_threads) {
  for (const auto& [scenario, golden] : {std::pair(bed(60.0, 20.0), "18be6dfdce6d13a9"),  // work for two
                                         {poured_bed(60.0, 5.0), "ee0bf7fa864fd8e6"}})
    for (const int threads : {1, 2}) EXPECT_EQ(final_hash(scenario, threads), golden) << threads;
}

TEST(GoldenRun, poured_bed_between_walls) {
  scenario::Scenario scenario = poured_bed(20.0, 10.0);
  scenario.bed.boundary = scenario::BedBoundary::walls;
  scenario.deposition.wall_friction = 0.0;
  EXPECT_EQ(final_hash(scenario, 1), "38c7a745db85af72");
}

TEST(GoldenRun, walled_bed_with_restitution) {
  scenario::Scenario scenario = bed(20.0, 10.0);
  scenario.bed.boundary = scenario::BedBoundary::walls;
  scenario.contact.restitution = 0.3;
  EXPECT_EQ(final_hash(scenario, 1), "bb0e37a339c5cffb");
}

TEST(GoldenRun, gauss_seidel) {
  scenario::Scenario scenario = bed(20.0, 8.0);
  scenario.solver.method = scenario::SolverMethod::gauss_seidel;
  EXPECT_EQ(final_hash(scenario, 1), "1fde067ee5348c6b");
}

}  // namespace
}  // namespace talus
