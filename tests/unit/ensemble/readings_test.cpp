/// Further analyses of a member of a reproduction: missing ones are made, existing ones are kept.

#include "ensemble/readings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/hash.h"
#include "core/snapshot.h"
#include "ensemble/member_values.h"
#include "io/analysis_file.h"
#include "io/durable_file.h"
#include "runs/analysis_parameters.h"
#include "session/run.h"
#include "session/run_header.h"
#include "support/places.h"
#include "support/small_bed.h"
#include "support/temporary_folder.h"

namespace talus::ensemble {
namespace {

namespace fs = std::filesystem;

class ReadingsTest : public testing::Test {
 protected:
  /// Returns a member whose run and analysis are complete.
  Member computed(const scenario::Scenario& scenario) const {
    const Member member =
        plan_ensemble({1}, {{"bed", "", scenario}}, folder_.path().string()).members.front();
    fs::create_directories(folder_.path("bed"));
    session::Session session(member.scenario);
    io::RunStore store =
        io::RunStore::create(member.path, session::run_header(session, {"", {}, "", 1}), false);
    session::run_to_end(session, store, {});
    const io::RunFile run = io::RunFile::open(member.path);
    const analysis::Analysis analysis = runs::analyse_run(run, analysis::AnalysisParameters(), 1, {});
    io::store_analysis(member.path, analysis, hash_text(state_hash(run.checkpoint().world)));
    return member;
  }
  static std::vector<io::StoredReading> readings_of(const Member& member) {
    return io::read_readings(io::RunFile::open(member.path));
  }
  test::TemporaryFolder folder_;
};

TEST_F(ReadingsTest, are_made_where_they_are_missing) {
  const Member member = computed(test::small_tilted_bed(1.0));
  complete_readings(member);
  const std::vector<io::StoredReading> before = readings_of(member);
  ASSERT_EQ(before.size(), 12u);
  for (const io::StoredReading& reading : before) {
    EXPECT_EQ(reading.thresholds, 2u);
    EXPECT_EQ(reading.values.size(), 24u);
    EXPECT_EQ(reading.at_most.size(), 24u);
  }
  const std::string state = hash_text(state_hash(io::RunFile::open(member.path).checkpoint().world));
  std::vector<io::StoredReading> changed = before;
  changed[3].key = "of another version";
  changed[4].values[0] = 7.5;  // valid by its key, so it is accepted as it is
  io::store_readings(member.path, changed, state);
  complete_readings(member);
  EXPECT_EQ(readings_of(member)[3].key, before[3].key);
  EXPECT_EQ(readings_of(member)[4].values[0], 7.5);
  io::store_analysis(member.path, *io::read_analysis(member.path), state);
  EXPECT_EQ(readings_of(member).size(), 12u) << "a run that is analysed again keeps them";
  EXPECT_EQ(io::RunFile::open(member.path).changed_data_sets(), std::vector<std::string>());
  const auto written = fs::last_write_time(member.path);
  complete_readings(member);
  EXPECT_EQ(fs::last_write_time(member.path), written) << "nothing is missing";
}

/// Returns the names of the columns, as docs/reproduce.md lists them.
std::vector<std::string> documented_columns() {
  const std::string page = io::read_text(test::source_folder() + "/docs/reproduce.md");
  std::vector<std::string> names;
  for (std::size_t at = page.find("one column for each of");
       (at = page.find('`', at)) != std::string::npos;) {
    const std::size_t end = page.find('`', at + 1);
    names.push_back(page.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  return names;
}

TEST_F(ReadingsTest, have_the_numbers_of_an_analysis_in_the_order_of_the_document) {
  scenario::Scenario scenario = test::small_tilted_bed(60.0);
  scenario.tilt.end_angle.reset();  // until it fails
  scenario.output.frame_every = 4.0;
  const Member member = computed(scenario);
  complete_readings(member);
  const io::StoredReading reading = readings_of(member).back();
  ASSERT_EQ(reading.name, "l_min=4");
  const io::RunFile run = io::RunFile::open(member.path);
  const analysis::Analysis analysis =
      runs::analyse_run(run, runs::parse_analysis_settings({reading.name}), 1, {});
  const MemberNumbers numbers = member_numbers(run, analysis);
  const std::vector<std::string> names = documented_columns();
  ASSERT_EQ(reading.values.size(), 2 * names.size());
  int known = 0;
  for (std::size_t k = 0; k < reading.values.size(); ++k) {
    const double expected = number_called(numbers, element_name(names[k % names.size()], k / names.size()));
    known += std::isnan(expected) ? 0 : 1;
    EXPECT_TRUE(reading.values[k] == expected || (std::isnan(reading.values[k]) && std::isnan(expected)))
        << names[k % names.size()];
  }
  EXPECT_GT(known, 6);
}

TEST_F(ReadingsTest, are_none_between_walls) {
  scenario::Scenario scenario = test::small_tilted_bed(1.0);
  scenario.bed.boundary = scenario::BedBoundary::walls;
  const Member member = computed(scenario);
  complete_readings(member);
  EXPECT_TRUE(readings_of(member).empty());
}

}  // namespace
}  // namespace talus::ensemble
