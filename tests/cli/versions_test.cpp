/// Runs in tests/runs, complete and interrupted ones, written with the current version of the schema, under
/// several versions of HDF5. A change of their meaning requires another version of the schema.

#include <gtest/gtest.h>

#include "io/run_schema.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::test {
namespace {

const std::filesystem::path kept_runs = std::filesystem::path(source_folder()) / "tests/runs";

const std::string schema = "schema_" + std::to_string(io::run_schema_version);

Outcome succeed(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  Outcome outcome = run_talus(arguments, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << arguments.front() << " " << arguments.back() << ": " << outcome.err;
  return outcome;
}

std::string state_hash(const std::string& run, const TemporaryFolder& folder) {
  return json_value(succeed({"info", "--json", run}, folder).out, "state_hash");
}

class KeptRun : public testing::TestWithParam<std::string> {
 protected:
  std::string kept_run() const { return (kept_runs / (GetParam() + ".h5")).string(); }

  const TemporaryFolder folder_;
};

// HDF5 1.10 of Debian 12, and its versions of Debian 13 and of testing.
INSTANTIATE_TEST_SUITE_P(WrittenUnder, KeptRun,
                         testing::Values(schema, schema + "_hdf5_1.14", schema + "_hdf5_2.2"));

TEST_P(KeptRun, opens_in_every_command) {
  ASSERT_TRUE(std::filesystem::exists(kept_run()))
      << "each version of the schema keeps a small run (docs/file_format.md, Versions)";
  const std::string run = folder_.path("run.h5");
  std::filesystem::copy_file(kept_run(), run);
  succeed({"check", run}, folder_);
  succeed({"analyze", run, "--quiet"}, folder_);
  succeed({"render", run, "--map", "gamma", "-o", "maps", "--theta-c", "20"}, folder_);
  succeed({"replay", run}, folder_);
  EXPECT_EQ(json_value(succeed({"info", "--json", run}, folder_).out, "frames"), "5");
}

TEST_P(KeptRun, that_was_stopped_goes_on_to_the_same_end) {
  const std::string run = folder_.path("run.h5");
  std::filesystem::copy(kept_runs / (GetParam() + "_stopped.h5.run"), run + ".run");
  succeed({"check", run}, folder_);
  const Outcome resumed = succeed({"run", "--quiet", "--resume", run}, folder_);
  EXPECT_NE(resumed.err.find("was started by version"), std::string::npos) << resumed.err;
  EXPECT_EQ(state_hash(run, folder_), state_hash(kept_run(), folder_));
  succeed({"check", run}, folder_);
}

}  // namespace
}  // namespace talus::test
