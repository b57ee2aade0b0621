/// Every file of tests/scenarios/bad as a user meets it: exit code, message, and no files left behind.

#include <gtest/gtest.h>

#include <iterator>

#include "support/places.h"
#include "support/process.h"

namespace talus::test {
namespace {

namespace fs = std::filesystem;

const fs::path bad = fs::path(test::source_folder()) / "tests/scenarios/bad";

std::size_t file_count(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::recursive_directory_iterator(folder.path()), fs::recursive_directory_iterator()));
}

TEST(HostileScenarios, are_refused_by_talus_run_with_nothing_left_behind) {
  const TemporaryFolder folder;
  std::size_t count = 0;
  run_talus({"--version"}, folder.path());  // creates the files that the tests themselves write
  for (const auto& entry : fs::directory_iterator(bad)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().filename().string();
    fs::copy_file(entry.path(), folder.path(name));
    const std::size_t before = file_count(folder);
    const Outcome outcome = run_talus({"run", name, "-o", "run.h5"}, folder.path());
    EXPECT_EQ(outcome.exit_code, 65) << name;
    // A file that begins like a run is not parsed (MistakenPath).
    const std::string expected = name == "run_file.toml"
                                     ? "talus: error: run_file.toml is not a scenario but a complete run; "
                                       "talus info run_file.toml shows what it holds, and talus replay "
                                       "run_file.toml computes it again\n"
                                     : text_of(fs::path(entry.path()).replace_extension(".expected"));
    EXPECT_EQ(outcome.err, expected) << name;
    EXPECT_EQ(outcome.out, "") << name;
    EXPECT_EQ(file_count(folder), before) << name << ": files were left behind";
    fs::remove(folder.path(name));
    ++count;
  }
  EXPECT_GE(count, 300u);
}

}  // namespace
}  // namespace talus::test
