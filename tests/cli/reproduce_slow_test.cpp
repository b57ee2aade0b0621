/// A complete `talus reproduce --quick`, which takes minutes.

#include <gtest/gtest.h>

#include "support/process.h"

namespace talus::test {
namespace {

TEST(QuickReproduction, writes_a_whole_report_and_keeps_all_of_it) {
  const TemporaryFolder folder;
  const std::vector<std::string> command = {"reproduce", "--quick", "-o", "quick"};
  const Outcome first = run_talus(command, folder.path());
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::string page = text_of(folder.path("quick/report.html")),
                    values = text_of(folder.path("quick/values.csv"));
  for (const char* part : {"Talus and the paper", "Settling which grains are overloaded",
                           "data:image/png;base64,", "<td>walls, L = 150 D</td>", ">1 of 1</td>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find(">0 of 1</td>"), std::string::npos) << "a bed is missing";
  EXPECT_EQ(page.find("src=\"figures"), std::string::npos) << "the page requires other files";

  const auto drawn =
      std::filesystem::last_write_time(folder.path("quick/figures/fig12-coarse-graining-length.png"));
  const auto run = std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.h5"));
  const Outcome second = run_talus(command, folder.path());
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("quick/figures/fig12-coarse-graining-length.png")),
            drawn);
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.h5")), run);
  EXPECT_EQ(text_of(folder.path("quick/report.html")), page);
  EXPECT_EQ(second.out, first.out);

  // Data missing from a member, as after a change of the analysis, are recomputed, and nothing else is.
  const std::string other = folder.path("quick/pbc-collapse/seed-1.h5"),
                    readings = "cd " + folder.path().string() +
                               " && /usr/bin/python3 -c 'import h5py; print(len(h5py.File(\"quick/pbc/"
                               "seed-1.h5\")[\"readings/key\"]))' > readings.txt";
  const auto untouched = std::filesystem::last_write_time(other);
  ASSERT_EQ(run_talus({"run", "quick/scenarios/pbc.toml", "--seed", "1", "-o", "quick/pbc/seed-1.h5",
                       "--overwrite"},
                      folder.path())
                .exit_code,
            0)
      << "like the output of talus run, without an analysis and readings";
  const Outcome third = run_talus(command, folder.path());
  ASSERT_EQ(third.exit_code, 0) << third.err;
  EXPECT_EQ(std::filesystem::last_write_time(other), untouched);
  EXPECT_EQ(std::system(readings.c_str()), 0);
  EXPECT_EQ(text_of(folder.path("readings.txt")), "12\n");
  EXPECT_EQ(text_of(folder.path("quick/values.csv")), values) << "the page also has the time of the new run";
}

}  // namespace
}  // namespace talus::test
