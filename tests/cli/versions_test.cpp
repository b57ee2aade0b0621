/// Runs in tests/runs, one complete and one interrupted, written with the current version of the schema. A
/// change of their meaning requires another version.

#include <gtest/gtest.h>

#include "io/run_schema.h"
#include "support/places.h"
#include "support/process.h"

namespace talus::test {
namespace {

const std::filesystem::path kept_runs = std::filesystem::path(source_folder()) / "tests/runs";

const std::string kept_name = "schema_" + std::to_string(io::run_schema_version);

std::string kept_run() { return (kept_runs / (kept_name + ".h5")).string(); }

Outcome succeed(const std::vector<std::string>& arguments, const TemporaryFolder& folder) {
  Outcome outcome = run_talus(arguments, folder.path());
  EXPECT_EQ(outcome.exit_code, 0) << arguments.front() << " " << arguments.back() << ": " << outcome.err;
  return outcome;
}

std::string state_hash(const std::string& run, const TemporaryFolder& folder) {
  return json_value(succeed({"info", "--json", run}, folder).out, "state_hash");
}

class KeptRun : public testing::Test {
 protected:
  const TemporaryFolder folder_;
};

TEST_F(KeptRun, opens_in_every_command) {
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

TEST_F(KeptRun, that_was_stopped_goes_on_to_the_same_end) {
  const std::string run = folder_.path("run.h5");
  std::filesystem::copy(kept_runs / (kept_name + "_stopped.h5.run"), run + ".run");
  succeed({"check", run}, folder_);
  const Outcome resumed = succeed({"run", "--quiet", "--resume", run}, folder_);
  EXPECT_NE(resumed.err.find("was started by version"), std::string::npos) << resumed.err;
  EXPECT_EQ(state_hash(run, folder_), state_hash(kept_run(), folder_));
  succeed({"check", run}, folder_);
}

}  // namespace
}  // namespace talus::test
