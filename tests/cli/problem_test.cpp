/// Contact problems of a run: dumped, solved, read by other programs, and corrupted.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "support/places.h"
#include "support/process.h"
#include "support/runs.h"

namespace talus::test {
namespace {

const char* const bed =
    "seed = 8\n[bed]\nlength = 12\ndepth = 5\n[tilt]\nend_angle = 1.0\n[output]\nframe_every = 0.5\n";

bool h5py(const std::string& arguments, const TemporaryFolder& folder) {
  const std::string command = "cd " + folder.path().string() + " && /usr/bin/python3 " + source_folder() +
                              "/tests/cli/problem_with_h5py.py " + arguments + " > h5py.txt 2>&1";
  if (std::system(command.c_str()) == 0) return true;
  std::ifstream file(folder.path("h5py.txt"));
  ADD_FAILURE() << arguments << "\n" << std::string(std::istreambuf_iterator<char>(file), {});
  return false;
}

bool has_h5py() { return std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") == 0; }

/// A short run, and the contact problem after its frame at 0.5 deg.
class Problem : public testing::Test {
 protected:
  void SetUp() override {
    take_run(folder, "bed.h5", bed);
    ASSERT_EQ(talus({"dump", "bed.h5", "--at", "frame1", "-o", "p.h5"}).exit_code, 0);
  }
  Outcome talus(const std::vector<std::string>& arguments) { return run_talus(arguments, folder.path()); }

  TemporaryFolder folder;
};

TEST_F(Problem, is_solved_from_the_guess_and_from_zero) {
  for (const char* solver : {"accelerated", "gauss-seidel"})
    for (const bool cold : {false, true}) {
      std::vector<std::string> arguments = {"solve", "p.h5", "--solver", solver, "--tol", "1e-7", "--json"};
      if (cold) arguments.emplace_back("--cold");
      const Outcome outcome = talus(arguments);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(json_value(outcome.out, "solver"), solver);
      EXPECT_EQ(json_value(outcome.out, "form"), "bodies");
      EXPECT_EQ(json_value(outcome.out, "converged"), "true");
      EXPECT_LE(std::stod(json_value(outcome.out, "eta")), 1e-7);
      EXPECT_LE(std::stod(json_value(outcome.out, "largest_residual")),
                std::stod(json_value(outcome.out, "eta")));
      EXPECT_GT(std::stod(json_value(outcome.out, "siconos_error")), 0.0);
      EXPECT_NEAR(std::stod(json_value(outcome.out, "carried_weight")), 1.0, 0.01);
      EXPECT_GT(std::stoi(json_value(outcome.out, "contacts")), 60);
      if (cold) {
        EXPECT_GT(std::stoi(json_value(outcome.out, "iterations")), 20);
        EXPECT_GT(std::stod(json_value(outcome.out, "ns_per_contact_iteration")), 0.0);
      }
    }
}

TEST_F(Problem, is_solved_to_what_the_run_asked_unless_told_otherwise) {
  const Outcome as_run = talus({"solve", "p.h5", "--json"});
  EXPECT_EQ(json_value(as_run.out, "tolerance"), "3e-07");
  EXPECT_EQ(json_value(as_run.out, "asked_by"), "run");
  EXPECT_EQ(json_value(as_run.out, "run_tolerance"), "3e-07") << "the bed is at rest";
  EXPECT_LT(std::stod(json_value(as_run.out, "bed_velocity")), 0.003);
  EXPECT_EQ(json_value(talus({"solve", "p.h5", "--tol", "1e-5", "--json"}).out, "asked_by"), "option");
  const Outcome text = talus({"solve", "p.h5"});
  EXPECT_NE(text.out.find("(converged, 3.0e-07 required by the run)"), std::string::npos) << text.out;
  EXPECT_EQ(text.out.find("moving"), std::string::npos) << text.out;
}

TEST_F(Problem, of_a_file_that_tells_no_tolerance_is_solved_to_the_default) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  const std::pair<const char*, const char*> cases[] = {{"older", "bodies"}, {"rows", "local"}};
  for (const auto& [how, form] : cases) {
    if (!h5py(std::string("change p.h5 other.h5 ") + how, folder)) return;
    const Outcome outcome = talus({"solve", "other.h5", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << how << ": " << outcome.err;
    EXPECT_EQ(json_value(outcome.out, "form"), form);
    EXPECT_EQ(json_value(outcome.out, "tolerance"), "1e-06");
    EXPECT_EQ(json_value(outcome.out, "asked_by"), "default");
    EXPECT_EQ(json_value(outcome.out, "bed_velocity"), "null");
    const std::string text = talus({"solve", "other.h5"}).out;
    EXPECT_NE(text.find("1.0e-06 required by default)"), std::string::npos) << text;
    EXPECT_EQ(text.find("moving"), std::string::npos) << text;
  }
}

TEST_F(Problem, that_does_not_converge_is_a_result) {
  const Outcome outcome = talus({"solve", "p.h5", "--cold", "--max-iterations", "3"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("NOT CONVERGED"), std::string::npos) << outcome.out;
  const Outcome solved = talus({"solve", "p.h5", "--cold", "--tol", "1e-5"});
  EXPECT_EQ(solved.out.find("NOT CONVERGED"), std::string::npos) << solved.out;
}

TEST_F(Problem, and_its_solution_satisfy_another_reader) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  for (const char* solver : {"accelerated", "gauss-seidel"})
    for (const char* form : {"p.h5", "plain.h5"}) {
      if (!h5py("change p.h5 plain.h5 plain", folder)) return;
      const Outcome outcome = talus({"solve", form, "--solver", solver, "--tol", "1e-8", "--cold", "-o",
                                     "solved.h5", "--overwrite", "--json"});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(json_value(outcome.out, "converged"), "true");
      h5py("check solved.h5 1e-8", folder);
    }
}

TEST_F(Problem, of_another_program_is_solved_in_each_of_its_forms) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  std::string eta;
  for (const char* how : {"rows", "columns", "triplets"}) {
    if (!h5py(std::string("change p.h5 other.h5 ") + how, folder)) return;
    const Outcome outcome = talus({"solve", "other.h5", "--json", "--cold"});
    ASSERT_EQ(outcome.exit_code, 0) << how << ": " << outcome.err;
    EXPECT_EQ(json_value(outcome.out, "form"), "local");
    EXPECT_EQ(json_value(outcome.out, "converged"), "true");
    EXPECT_EQ(json_value(outcome.out, "carried_weight"), "null");
    if (eta.empty()) eta = json_value(outcome.out, "eta");
    EXPECT_EQ(json_value(outcome.out, "eta"), eta) << how << ": the same W in another form has the same bits";
  }
}

TEST_F(Problem, that_is_spoilt_is_refused_with_the_place) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  const std::pair<const char*, const char*> cases[] = {
      {"space", "/fclib_local/spacedim is 3, expected 2"},
      {"no-problem", "has no group /fclib_local"},
      {"no-values", "/fclib_local/W/x is missing"},
      {"constraints", "equality constraints"},
      {"friction", "/fclib_local/vectors/mu holds the negative value -0.5 at index 3"},
      {"nan", "/fclib_local/vectors/q holds a value that is not finite, at index 7"},
      {"index", "/fclib_local/W/i holds 1048576 at index 5"},
      {"size", "/fclib_local/vectors/q has 3 values, expected "},
      {"text", "/fclib_local/vectors/mu does not hold numbers"},
      {"order", "/fclib_local/W/p does not ascend"},
      {"bodies", "/talus/bodies/lever is missing"},
      {"tolerance", "/talus/run/tolerance is missing"},
  };
  for (const auto& [how, message] : cases) {
    if (!h5py(std::string("change p.h5 bad.h5 ") + how, folder)) return;
    const Outcome outcome = talus({"solve", "bad.h5"});
    EXPECT_EQ(outcome.exit_code, 65) << how;
    EXPECT_EQ(outcome.err.find("talus: error: bad.h5: "), 0u) << outcome.err;
    EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
  }
}

TEST_F(Problem, refusals_leave_with_the_code_of_their_cause) {
  EXPECT_EQ(talus({"solve", "none.h5"}).exit_code, 66);
  write_file(folder, "text.h5", "no HDF5");
  EXPECT_EQ(talus({"solve", "text.h5"}).exit_code, 65);
  EXPECT_EQ(talus({"solve", "bed.h5"}).exit_code, 65) << "a run is not a problem";
  EXPECT_EQ(talus({"solve", "p.h5", "--tol", "0"}).exit_code, 64);
  EXPECT_EQ(talus({"solve", "p.h5", "--solver", "magic"}).exit_code, 64);
  EXPECT_EQ(talus({"solve", "p.h5", "-o", "p.h5"}).exit_code, 73);
  EXPECT_EQ(talus({"dump", "none.h5", "--at", "frame0", "-o", "x.h5"}).exit_code, 66);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "frame3", "-o", "x.h5"}).exit_code, 65);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "30", "-o", "x.h5"}).exit_code, 65);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "repose", "-o", "x.h5"}).exit_code, 65);
  EXPECT_EQ(talus({"dump", "bed.h5", "-o", "x.h5"}).exit_code, 64) << "no frame was named";
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "frame0", "--at", "1", "-o", "x.h5"}).exit_code, 64);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "frame0", "-o", "p.h5"}).exit_code, 73);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "0.5", "-o", "p.h5", "--overwrite"}).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder.path("x.h5")));
}

/// The same bed just after failure.
class MovingBed : public testing::Test {
 protected:
  void SetUp() override {
    take_run(folder, "bed.h5",
             "seed = 8\n[bed]\nlength = 12\ndepth = 5\n[tilt]\nstep = 0.01\n[output]\nframe_every = 1\n");
    const std::string frames = json_value(talus({"info", "bed.h5", "--json"}).out, "frames");
    const std::string last = std::to_string(std::stoi(frames) - 1);
    ASSERT_EQ(talus({"dump", "bed.h5", "--at", "frame" + last, "-o", "p.h5"}).exit_code, 0);
  }
  Outcome talus(const std::vector<std::string>& arguments) { return run_talus(arguments, folder.path()); }

  TemporaryFolder folder;
};

TEST_F(MovingBed, is_named_with_the_tolerances_that_a_solve_has_reached) {
  const Outcome as_run = talus({"solve", "p.h5", "--json"});
  ASSERT_EQ(as_run.exit_code, 0) << as_run.err;
  EXPECT_GT(std::stod(json_value(as_run.out, "bed_velocity")), 0.1);
  EXPECT_GT(std::stod(json_value(as_run.out, "run_tolerance")), 1e-5);
  EXPECT_EQ(json_value(as_run.out, "run_tolerance_at_rest"), "3e-07");
  EXPECT_EQ(json_value(as_run.out, "tolerance"), json_value(as_run.out, "run_tolerance"));
  EXPECT_EQ(json_value(as_run.out, "converged"), "true");

  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{}, "this solve has reached only the first."},
      {{"--tol", "1e-7"}, "this solve has reached both of them."},
      {{"--cold", "--max-iterations", "3"}, "this solve has reached neither of them."},
  };
  for (const auto& [options, end] : cases) {
    std::vector<std::string> arguments = {"solve", "p.h5"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = talus(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("The bed was moving in this step, at "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(end), std::string::npos) << outcome.out;
  }
}

/// Returns the commands of a page that dump or solve a problem, split into words, without comments.
std::vector<std::vector<std::string>> problem_commands(const std::string& page) {
  std::ifstream file(source_folder() + "/" + page);
  std::vector<std::vector<std::string>> found;
  for (std::string line; std::getline(file, line);) {
    std::istringstream text(line.substr(0, line.find('#')));
    std::string program;
    text >> program;
    const std::vector<std::string> words{std::istream_iterator<std::string>(text), {}};
    const bool is_talus = program == "talus" || program.ends_with("/talus");
    if (is_talus && !words.empty() && (words[0] == "dump" || words[0] == "solve")) found.push_back(words);
  }
  return found;
}

// In this bed the step at 10 deg is at rest, and its residual does not reach 3e-7 when started from zero.
TEST(ProblemExamples, of_the_documents_end_as_they_say) {
  const TemporaryFolder folder;
  take_run(folder, "RUN.h5",
           "seed = 4\n[bed]\nlength = 30\ndepth = 10\n[tilt]\nstep = 0.01\nend_angle = 10.5\n");
  std::filesystem::create_directory(folder.path("runs"));
  std::filesystem::copy(folder.path("RUN.h5"), folder.path("runs/paper.h5"));
  for (const char* page : {"README.md", "docs/problem_files.md"}) {
    const std::vector<std::vector<std::string>> commands = problem_commands(page);
    EXPECT_GE(commands.size(), 2u) << page;
    for (const std::vector<std::string>& command : commands) {
      const Outcome outcome = run_talus(command, folder.path());
      EXPECT_EQ(outcome.exit_code, 0) << page << ": " << outcome.err;
      if (command[0] != "solve") continue;
      EXPECT_NE(outcome.out.find("(converged, "), std::string::npos) << page << ":\n" << outcome.out;
    }
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path("SOLVED.h5")));
}

}  // namespace
}  // namespace talus::test
