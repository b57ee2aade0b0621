/// A complete `talus reproduce --quick`, which takes minutes.

#include <gtest/gtest.h>

#include "support/commands.h"

namespace talus::test {
namespace {

TEST(QuickReproduction, writes_a_whole_report_and_keeps_all_of_it) {
  const CommandFolder folder;
  const Words command = {"reproduce", "--quick", "-o", "quick"};
  const Outcome first = folder.talus(command);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  const std::string page = folder.text("quick/report.html"), values = folder.text("quick/values.csv");
  EXPECT_TRUE(has_all(page, {"Talus and the paper", "Settling which grains are overloaded",
                             "data:image/png;base64,", "<td>walls, L = 150 D</td>", ">1 of 1</td>"}));
  EXPECT_FALSE(has(page, ">0 of 1</td>")) << "a bed is missing";
  EXPECT_FALSE(has(page, "src=\"figures")) << "the page requires other files";

  const auto drawn =
      std::filesystem::last_write_time(folder.path("quick/figures/fig12-coarse-graining-length.png"));
  const auto run = std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.h5"));
  const Outcome second = folder.talus(command);
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("quick/figures/fig12-coarse-graining-length.png")),
            drawn);
  EXPECT_EQ(std::filesystem::last_write_time(folder.path("quick/pbc/seed-1.h5")), run);
  EXPECT_EQ(folder.text("quick/report.html"), page);
  EXPECT_EQ(second.out, first.out);

  // Data missing from a member, as after a change of the analysis, are recomputed, and nothing else is.
  const std::string other = folder.path("quick/pbc-collapse/seed-1.h5"),
                    readings = "cd " + folder.path().string() +
                               " && /usr/bin/python3 -c 'import h5py; print(len(h5py.File(\"quick/pbc/"
                               "seed-1.h5\")[\"readings/key\"]))' > readings.txt";
  const auto untouched = std::filesystem::last_write_time(other);
  ASSERT_EQ(folder
                .talus({"run", "quick/scenarios/pbc.toml", "--seed", "1", "-o", "quick/pbc/seed-1.h5",
                        "--overwrite"})
                .exit_code,
            0)
      << "like the output of talus run, without an analysis and readings";
  ASSERT_TRUE(ends(folder.talus(command), 0));
  EXPECT_EQ(std::filesystem::last_write_time(other), untouched);
  EXPECT_EQ(std::system(readings.c_str()), 0);
  EXPECT_EQ(folder.text("readings.txt"), "12\n");
  EXPECT_EQ(folder.text("quick/values.csv"), values) << "the page also has the time of the new run";
}

}  // namespace
}  // namespace talus::test
