/// A whole `talus reproduce --quick`: minutes.

#include <gtest/gtest.h>

#include "support/process.h"

namespace talus::test {
namespace {

TEST(QuickReproduction, writes_a_whole_report_and_keeps_all_of_it) {
  const TemporaryFolder folder;
  const std::vector<std::string> command = {"reproduce", "--quick", "-o", "quick"};
  const Outcome first = run_talus(command, folder.path());
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::string page = text_of(folder.path("quick/report.html"));
  for (const char* part : {"Talus beside the paper", "Settling which grains are overloaded",
                           "data:image/png;base64,", "<td>walls, L = 150 D</td>", ">1 of 1</td>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find(">0 of 1</td>"), std::string::npos) << "a bed is missing";
  EXPECT_EQ(page.find("src=\"figures"), std::string::npos) << "the page needs files beside it";

  const auto drawn =
      std::filesystem::last_write_time(folder.path("quick/figures/fig12-coarse-graining-length.png"));
  const auto run = std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.h5"));
  const auto kept =
      std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.readings/averaging=1.csv"));
  const Outcome second = run_talus(command, folder.path());
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("quick/figures/fig12-coarse-graining-length.png")),
            drawn);
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.h5")), run);
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.readings/averaging=1.csv")), kept);
  EXPECT_EQ(text_of(folder.path("quick/report.html")), page);
  EXPECT_EQ(second.out, first.out);

  // What is missing of a member, as after a change of the analysis, is made again, and nothing else.
  std::filesystem::remove(folder.path("quick/pbc/seed-1.readings/averaging=1.csv"));
  const Outcome third = run_talus(command, folder.path());
  ASSERT_EQ(third.exit_code, 0) << third.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("quick/pbc/seed-1.readings/averaging=1.csv")));
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.h5")), run);
  EXPECT_EQ(text_of(folder.path("quick/report.html")), page);
}

}  // namespace
}  // namespace talus::test
