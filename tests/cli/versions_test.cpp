/// Runs that older versions made, kept in tests/runs: one complete and one stopped for each version of the
/// schema.

#include <gtest/gtest.h>

#include "io/run_schema.h"
#include "process.h"

namespace talus::test {
namespace {

const std::filesystem::path kept_runs = std::filesystem::path(TALUS_SOURCE_DIR) / "tests/runs";

std::string kept_run(std::int32_t version) {
  return (kept_runs / ("schema_" + std::to_string(version) + ".h5")).string();
}

Outcome succeed(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  Outcome outcome = run_talus(arguments, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << arguments.front() << " " << arguments.back() << ": " << outcome.err;
  return outcome;
}

std::string state_hash(const std::string& run, const TemporaryFolder& folder) {
  return json_value(succeed({"info", "--json", run}, folder).out, "state_hash");
}

/// Of each version that is still read, up to the one that is written now.
class Versions : public testing::TestWithParam<std::int32_t> {
 protected:
  const TemporaryFolder folder_;
};

TEST_P(Versions, a_run_of_it_opens_in_every_command) {
  ASSERT_TRUE(std::filesystem::exists(kept_run(GetParam())))
      << "a new version of the schema keeps a small run of its own (docs/file_format.md, Versions)";
  const std::string run = folder_.path("run.h5");
  std::filesystem::copy_file(kept_run(GetParam()), run);
  succeed({"check", run}, folder_);
  succeed({"analyze", run, "--quiet"}, folder_);
  succeed({"render", run, "--map", "gamma", "-o", "maps", "--theta-c", "20"}, folder_);
  succeed({"replay", run}, folder_);
  EXPECT_EQ(json_value(succeed({"info", "--json", run}, folder_).out, "frames"), "5");
}

TEST_P(Versions, a_run_that_was_stopped_goes_on_to_the_same_end) {
  const std::string name = "schema_" + std::to_string(GetParam()) + "_stopped.h5.run";
  const std::string run = folder_.path("run.h5");
  std::filesystem::copy(kept_runs / name, run + ".run");
  succeed({"check", run}, folder_);
  succeed({"run", "--quiet", "--resume", run}, folder_);
  EXPECT_EQ(state_hash(run, folder_), state_hash(kept_run(GetParam()), folder_));
  succeed({"check", run}, folder_);
}

INSTANTIATE_TEST_SUITE_P(all, Versions, testing::Range(oldest_run_schema_version, run_schema_version + 1),
                         [](const auto& version) { return "schema_" + std::to_string(version.param); });

}  // namespace
}  // namespace talus::test
