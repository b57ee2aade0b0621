/// Contact problems and admissible forces of a run.

#include <gtest/gtest.h>

#include <cstdlib>

#include "support/commands.h"
#include "support/places.h"
#include "support/runs.h"

namespace talus::test {
namespace {

const char* const bed =
    "seed = 8\n[bed]\nlength = 12\ndepth = 5\n[tilt]\nend_angle = 1.0\n[output]\nframe_every = 0.5\n";

bool h5py(const std::string& arguments, const CommandFolder& folder) {
  const std::string command = "cd " + folder.path().string() + " && /usr/bin/python3 " + source_folder() +
                              "/tests/cli/problem_with_h5py.py " + arguments + " > h5py.txt 2>&1";
  if (std::system(command.c_str()) == 0) return true;
  ADD_FAILURE() << arguments << "\n" << folder.text("h5py.txt");
  return false;
}

bool has_h5py() { return std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") == 0; }

/// A short run, and the contact problem after its frame at 0.5 deg.
class Problem : public CommandTest {
 protected:
  void SetUp() override {
    take_run(folder_, "bed.h5", bed);
    ASSERT_EQ(talus({"dump", "bed.h5", "--at", "frame1", "-o", "p.h5"}).exit_code, 0);
  }
};

TEST_F(Problem, is_solved_from_the_guess_and_from_zero) {
  for (const char* solver : {"accelerated", "gauss-seidel"})
    for (const bool cold : {false, true}) {
      Words arguments = {"solve", "p.h5", "--solver", solver, "--tol", "1e-7", "--json"};
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
  EXPECT_TRUE(has(text.out, "(converged, 3.0e-07 required by the run)"));
  EXPECT_FALSE(has(text.out, "moving"));
}

TEST_F(Problem, of_a_file_that_tells_no_tolerance_is_solved_to_the_default) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  const std::pair<const char*, const char*> cases[] = {{"older", "bodies"}, {"rows", "local"}};
  for (const auto& [how, form] : cases) {
    if (!h5py(std::string("change p.h5 other.h5 ") + how, folder_)) return;
    const Outcome outcome = talus({"solve", "other.h5", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << how << ": " << outcome.err;
    EXPECT_EQ(json_value(outcome.out, "form"), form);
    EXPECT_EQ(json_value(outcome.out, "tolerance"), "1e-06");
    EXPECT_EQ(json_value(outcome.out, "asked_by"), "default");
    EXPECT_EQ(json_value(outcome.out, "bed_velocity"), "null");
    const std::string text = talus({"solve", "other.h5"}).out;
    EXPECT_TRUE(has(text, "1.0e-06 required by default)"));
    EXPECT_FALSE(has(text, "moving"));
  }
}

TEST_F(Problem, that_does_not_converge_is_a_result) {
  EXPECT_TRUE(ends(talus({"solve", "p.h5", "--cold", "--max-iterations", "3"}), 0, {"NOT CONVERGED"}));
  EXPECT_FALSE(has(talus({"solve", "p.h5", "--cold", "--tol", "1e-5"}).out, "NOT CONVERGED"));
}

TEST_F(Problem, and_its_solution_satisfy_another_reader) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  for (const char* solver : {"accelerated", "gauss-seidel"})
    for (const char* form : {"p.h5", "plain.h5"}) {
      if (!h5py("change p.h5 plain.h5 plain", folder_)) return;
      const Outcome outcome = talus({"solve", form, "--solver", solver, "--tol", "1e-8", "--cold", "-o",
                                     "solved.h5", "--overwrite", "--json"});
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(json_value(outcome.out, "converged"), "true");
      h5py("check solved.h5 1e-8", folder_);
    }
}

TEST_F(Problem, of_another_program_is_solved_in_each_of_its_forms) {
  if (!has_h5py()) GTEST_SKIP() << "python3-h5py is not installed";
  std::string eta;
  for (const char* how : {"rows", "columns", "triplets"}) {
    if (!h5py(std::string("change p.h5 other.h5 ") + how, folder_)) return;
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
      {"constraints", "equality constraints"},
      {"text", "/fclib_local/vectors/mu does not hold numbers"},
      {"order", "/fclib_local/W/p does not ascend"},
  };
  for (const auto& [how, message] : cases) {
    if (!h5py(std::string("change p.h5 bad.h5 ") + how, folder_)) return;
    const Outcome outcome = talus({"solve", "bad.h5"});
    EXPECT_TRUE(ends(outcome, 65, {message})) << how;
    EXPECT_TRUE(outcome.err.starts_with("talus: error: bad.h5: ")) << outcome.err;
  }
}

TEST_F(Problem, refusals_leave_with_the_code_of_their_cause) {
  EXPECT_EQ(talus({"solve", "none.h5"}).exit_code, 66);
  write_file(folder_, "text.h5", "no HDF5");
  EXPECT_TRUE(
      ends(talus({"solve", "text.h5"}), 65, {"text.h5: is not a contact problem; expected a file of"}));
  EXPECT_EQ(talus({"solve", "bed.h5"}).exit_code, 65) << "a run is not a problem";
  EXPECT_EQ(talus({"solve", "p.h5", "--tol", "0"}).exit_code, 64);
  EXPECT_EQ(talus({"solve", "p.h5", "--solver", "magic"}).exit_code, 64);
  EXPECT_EQ(talus({"solve", "p.h5", "-o", "p.h5"}).exit_code, 73);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "frame3", "-o", "x.h5"}).exit_code, 65);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "frame0-frame1", "-o", "x.h5"}).exit_code, 64);
  EXPECT_EQ(talus({"run", "--branch", "bed.h5", "--at", "frame0-frame1", "-o", "x.h5"}).exit_code, 64);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "30", "-o", "x.h5"}).exit_code, 65);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "repose", "-o", "x.h5"}).exit_code, 65);
  EXPECT_EQ(talus({"dump", "bed.h5", "-o", "x.h5"}).exit_code, 64) << "no frame was named";
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "frame0", "--at", "1", "-o", "x.h5"}).exit_code, 64);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "frame0", "-o", "p.h5"}).exit_code, 73);
  EXPECT_EQ(talus({"dump", "bed.h5", "--at", "0.5", "-o", "p.h5", "--overwrite"}).exit_code, 0);
  EXPECT_FALSE(folder_.has_file("x.h5"));
}

/// The same bed just after failure.
class MovingBed : public CommandTest {
 protected:
  void SetUp() override {
    take_run(folder_, "bed.h5",
             "seed = 8\n[bed]\nlength = 12\ndepth = 5\n[tilt]\nstep = 0.01\n[output]\nframe_every = 1\n");
    const std::string frames = info("bed.h5", "frames");
    const std::string last = std::to_string(std::stoi(frames) - 1);
    ASSERT_EQ(talus({"dump", "bed.h5", "--at", "frame" + last, "-o", "p.h5"}).exit_code, 0);
  }
};

TEST_F(MovingBed, is_named_with_the_tolerances_that_a_solve_has_reached) {
  const Outcome as_run = talus({"solve", "p.h5", "--json"});
  ASSERT_EQ(as_run.exit_code, 0) << as_run.err;
  EXPECT_GT(std::stod(json_value(as_run.out, "bed_velocity")), 0.1);
  EXPECT_GT(std::stod(json_value(as_run.out, "run_tolerance")), 1e-5);
  EXPECT_EQ(json_value(as_run.out, "run_tolerance_at_rest"), "3e-07");
  EXPECT_EQ(json_value(as_run.out, "tolerance"), json_value(as_run.out, "run_tolerance"));
  EXPECT_EQ(json_value(as_run.out, "converged"), "true");

  const std::pair<Words, const char*> cases[] = {
      {{}, "this solve has reached only the first."},
      {{"--tol", "1e-7"}, "this solve has reached both of them."},
      {{"--cold", "--max-iterations", "3"}, "this solve has reached neither of them."},
  };
  for (const auto& [options, end] : cases)
    EXPECT_TRUE(
        ends(talus(Words{"solve", "p.h5"} + options), 0, {"The bed was moving in this step, at ", end}));
}

// In this bed the step at 10 deg is at rest, and its residual does not reach 3e-7 when started from zero.
TEST(ProblemExamples, of_the_documents_end_as_they_say) {
  const CommandFolder folder;
  take_run(folder, "RUN.h5",
           "seed = 4\n[bed]\nlength = 30\ndepth = 10\n[tilt]\nstep = 0.01\nend_angle = 10.5\n");
  std::filesystem::create_directory(folder.path("runs"));
  std::filesystem::copy(folder.path("RUN.h5"), folder.path("runs/paper.h5"));
  for (const char* page : {"README.md", "docs/problem_files.md"}) {
    const std::vector<Words> commands = talus_commands(page, {"dump", "solve"});
    EXPECT_GE(commands.size(), 2u) << page;
    for (const Words& command : commands) {
      const Outcome outcome = folder.talus(command);
      EXPECT_EQ(outcome.exit_code, 0) << page << ": " << outcome.err;
      if (command[0] != "solve") continue;
      EXPECT_TRUE(has(outcome.out, "(converged, ")) << page;
    }
  }
  EXPECT_TRUE(folder.has_file("SOLVED.h5"));
}

using Forces = CommandTest;

TEST_F(Forces, of_a_run_are_compared) {
  if (!has_python_package()) GTEST_SKIP() << "the Python package was not built: python3-dev, pybind11-dev";
  take_run(folder_, "bed.h5", bed);
  const Words ask = {"forces", "bed.h5", "--at", "0,1",   "--solutions",
                     "7",      "--tol",  "1e-6", "--set", "gamma_c=0.3"};
  const Words as_json = ask + Words{"--json"};
  const Outcome found = talus(as_json);
  ASSERT_EQ(found.exit_code, 0) << found.err;
  EXPECT_EQ(count_of(found.out, "\"frame\": "), 2u);
  EXPECT_EQ(count_of(found.out, "\"start\": "), 16u) << "one from the stored forces and seven others, twice";
  EXPECT_EQ(count_of(found.out, "\"quantity\": \"p_o\""), 4u) << "two thresholds";
  EXPECT_EQ(json_value(found.out, "others"), "7");
  EXPECT_GE(std::stoi(json_value(found.out, "admissible")), 6);
  EXPECT_EQ(json_value(found.out, "tilt_deg").substr(0, 1), "0");
  EXPECT_GT(std::stod(json_value(found.out, "deviation")), 0.0) << "of Gamma";
  for (const char* name : {"contacts", "threshold_factor", "stored", "mean", "least", "largest", "iterations",
                           "eta", "converged", "momentum_left", "unbalanced", "distance", "values"})
    EXPECT_TRUE(has(found.out, std::string("\"") + name + "\": ")) << name;
  EXPECT_EQ(talus(as_json).out, found.out) << "the same seed";

  ASSERT_TRUE(
      ends(talus(ask), 0, {"of 7 other sets of forces are admissible (eta 1.0e-06)", "p_o at 2 Gamma_c"}));

  EXPECT_EQ(talus({"forces", "bed.h5", "--at", "30", "--set", "gamma_c=0.3"}).exit_code, 65);
  EXPECT_TRUE(ends(talus({"forces", "bed.h5", "--at", "0"}), 65, {"--set gamma_c=0.3"}));
  EXPECT_EQ(talus({"forces", "bed.h5", "--at", "0", "--set", "colour=red"}).exit_code, 65);
  EXPECT_EQ(talus({"forces", "bed.h5", "--at", "0", "--solutions", "0"}).exit_code, 64);
}

// A set of forces does not determine the rolling moments, and problem files cannot store them.
TEST_F(Forces, of_contacts_that_resist_rolling_are_refused_and_so_are_their_problems) {
  take_run(folder_, "bed.h5", std::string(bed) + "[contact]\nrolling_friction = 0.1\n");
  for (const Words& asked : {Words{"forces", "bed.h5", "--at", "0", "--set", "gamma_c=0.3"},
                             {"dump", "bed.h5", "--at", "frame1", "-o", "p.h5"}})
    EXPECT_TRUE(ends(talus(asked), 65, {"resist rolling (contact.rolling_friction = 0.1)"})) << asked[0];
  EXPECT_FALSE(folder_.has_file("p.h5"));
}

}  // namespace
}  // namespace talus::test
