/// Admissible forces for the frames of a run, as requested by a user.

#include <gtest/gtest.h>

#include "support/process.h"
#include "support/runs.h"
#include "unit/io/example_run.h"

namespace talus::test {
namespace {

const char* const bed =
    "seed = 5\n[bed]\nlength = 12\ndepth = 5\n[tilt]\nend_angle = 1.0\n[output]\nframe_every = 0.5\n";

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Forces, of_a_run_are_compared) {
  if (!has_python_package()) GTEST_SKIP() << "the Python package was not built: python3-dev, pybind11-dev";
  const TemporaryFolder folder;
  const auto talus = [&](const std::vector<std::string>& arguments) {
    return run_talus(arguments, folder.path());
  };
  take_run(folder, "bed.h5", bed);

  const std::vector<std::string> ask = {"forces", "bed.h5", "--at", "0,1",   "--solutions",
                                        "7",      "--tol",  "1e-6", "--set", "gamma_c=0.3"};
  std::vector<std::string> as_json = ask;
  as_json.emplace_back("--json");
  const Outcome found = talus(as_json);
  ASSERT_EQ(found.exit_code, 0) << found.err;
  EXPECT_EQ(count_of(found.out, "\"frame\": "), 2);
  EXPECT_EQ(count_of(found.out, "\"start\": "), 16) << "one from the stored forces and seven others, twice";
  EXPECT_EQ(count_of(found.out, "\"quantity\": \"p_o\""), 4) << "two thresholds";
  EXPECT_EQ(json_value(found.out, "others"), "7");
  EXPECT_GE(std::stoi(json_value(found.out, "admissible")), 6);
  EXPECT_EQ(json_value(found.out, "tilt_deg").substr(0, 1), "0");
  EXPECT_GT(std::stod(json_value(found.out, "deviation")), 0.0) << "of Gamma";
  for (const char* name : {"contacts", "threshold_factor", "stored", "mean", "least", "largest", "iterations",
                           "eta", "converged", "momentum_left", "unbalanced", "distance", "values"})
    EXPECT_NE(found.out.find(std::string("\"") + name + "\": "), std::string::npos) << name;
  EXPECT_EQ(talus(as_json).out, found.out) << "the same seed";

  const Outcome text = talus(ask);
  ASSERT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("of 7 other sets of forces are admissible (eta 1.0e-06)"), std::string::npos)
      << text.out;
  EXPECT_NE(text.out.find("p_o at 2 Gamma_c"), std::string::npos) << text.out;

  EXPECT_EQ(talus({"forces", "bed.h5", "--at", "30", "--set", "gamma_c=0.3"}).exit_code, 65);
  const Outcome no_threshold = talus({"forces", "bed.h5", "--at", "0"});
  EXPECT_EQ(no_threshold.exit_code, 65);
  EXPECT_NE(no_threshold.err.find("--set gamma_c=0.3"), std::string::npos) << no_threshold.err;
  EXPECT_EQ(talus({"forces", "bed.h5", "--at", "0", "--set", "colour=red"}).exit_code, 65);
  EXPECT_EQ(talus({"forces", "bed.h5", "--at", "0", "--solutions", "0"}).exit_code, 64);
  EXPECT_EQ(talus({"forces", "none.h5"}).exit_code, 66);
}

TEST(Forces, of_a_run_without_frames_are_refused) {
  const TemporaryFolder folder;
  example::store_with_commits(folder.path("begun.h5"), 1);
  const Outcome outcome = run_talus({"forces", "begun.h5", "--at", "0"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 65);
  EXPECT_NE(outcome.err.find("begun.h5 has no frames yet"), std::string::npos) << outcome.err;
}

// A set of forces does not determine the rolling moments, and problem files cannot store them.
TEST(Forces, of_contacts_that_resist_rolling_are_refused_and_so_are_their_problems) {
  const TemporaryFolder folder;
  take_run(folder, "bed.h5", std::string(bed) + "[contact]\nrolling_friction = 0.1\n");
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{"forces", "bed.h5", "--at", "0", "--set", "gamma_c=0.3"},
        {"dump", "bed.h5", "--at", "frame1", "-o", "p.h5"}}) {
    const Outcome outcome = run_talus(asked, folder.path());
    EXPECT_EQ(outcome.exit_code, 65) << asked[0];
    EXPECT_NE(outcome.err.find("resist rolling (contact.rolling_friction = 0.1)"), std::string::npos)
        << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path("p.h5")));
}

}  // namespace
}  // namespace talus::test
