/// `talus solve`: solves a contact problem from a file, written by Talus or another program.

#include <chrono>
#include <cstdio>
#include <fmt/core.h>
#include <limits>
#include <memory>
#include <optional>

#include "app/commands.h"
#include "app/frame_options.h"
#include "app/json.h"
#include "app/options.h"
#include "app/run_files.h"
#include "app/terminal.h"
#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "pictures/frame_choice.h"
#include "problems/local_solvers.h"
#include "problems/problem_file.h"
#include "scenario/text.h"

namespace talus::app {
namespace {

/// Source of the tolerance of a solve.
enum class ToleranceSource { option, run, default_value };

struct SolveArguments {
  std::string problem;
  std::string output;
  solver::SolverSettings settings;
  std::optional<double> tolerance;
  ToleranceSource tolerance_source = ToleranceSource::default_value;
  bool cold = false;
  bool overwrite = false;
  bool json = false;
};

struct SolveResult {
  Index contacts = 0;
  Index bodies = 0;  ///< 0 if unknown
  solver::SolverReport report;
  std::optional<problems::StepTolerance> run_tolerance;
  double siconos_error = 0.0;
  double carried_weight = std::numeric_limits<double>::quiet_NaN();
  double seconds = 0.0;
  solver::LocalSolution solution;
};

const char* name_of(solver::SolverKind kind) {
  return kind == solver::SolverKind::gauss_seidel ? "gauss-seidel" : "accelerated";
}

/// Returns a sentence on a step in which the bed was moving, so that the run required less than for a bed at
/// rest: the velocity of the bed, and which of the two tolerances of the run a solve has reached.
std::string remark_on_moving(const problems::StepTolerance& run_tolerance, double eta) {
  // The criterion of the solvers (solver/solve.cpp).
  const auto reached = [eta](double tolerance) { return eta <= tolerance * (1.0 + 1e-9); };
  return fmt::format(
      "The bed was moving in this step, at {:.2g} g h (rms), so the run required {:.1e} instead of the "
      "{:.1e} of a bed at rest; this solve has reached {}.",
      run_tolerance.velocity, run_tolerance.asked, run_tolerance.at_rest,
      reached(run_tolerance.at_rest) ? "both of them"
      : reached(run_tolerance.asked) ? "only the first"
                                     : "neither of them");
}

/// Sources of the tolerance, in words and in JSON.
constexpr std::pair<const char*, const char*> tolerance_sources[] = {
    {"--tol", "option"}, {"the run", "run"}, {"default", "default"}};

/// Chooses the tolerance: that of the option, else that of the run from which the problem comes.
void choose_tolerance(const problems::StoredProblem& stored, SolveArguments& arguments) {
  if (arguments.tolerance) {
    arguments.settings.tolerance = *arguments.tolerance;
    arguments.tolerance_source = ToleranceSource::option;
  } else if (stored.step && stored.step->tolerance) {
    arguments.settings.tolerance = stored.step->tolerance->asked;
    arguments.tolerance_source = ToleranceSource::run;
  }
}

/// Returns the wall seconds that `work` takes.
template <typename Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void solve_bodies(const problems::StepProblem& step, const SolveArguments& arguments, SolveResult& result) {
  solver::ContactSolution solution = step.guess;
  if (arguments.cold) {
    solution.pn.assign(solution.pn.size(), 0.0);
    solution.pt.assign(solution.pt.size(), 0.0);
  }
  solver::SolverWorkspace workspace;
  result.seconds = seconds_of(
      [&] { result.report = solver::solve(step.problem, arguments.settings, workspace, solution); });
  result.bodies = step.problem.body_count();
  result.run_tolerance = step.tolerance;
  result.siconos_error = problems::siconos_error(step.problem, solution);
  result.carried_weight = problems::carried_weight(step, solution);
  result.solution = solver::local_form(step.problem, solution);
}

void solve_local(const problems::StoredProblem& stored, const SolveArguments& arguments,
                 SolveResult& result) {
  result.solution.p = arguments.cold ? std::vector<solver::Impulse>(stored.guess.size()) : stored.guess;
  result.seconds =
      seconds_of([&] { result.report = problems::solve(stored.local, arguments.settings, result.solution); });
  result.siconos_error = problems::siconos_error(stored.local, result.solution.p);
}

SolveResult solve(const problems::StoredProblem& stored, const SolveArguments& arguments) {
  SolveResult result;
  result.contacts = stored.local.contact_count();
  if (stored.step)
    solve_bodies(*stored.step, arguments, result);
  else
    solve_local(stored, arguments, result);
  return result;
}

std::vector<Fact> facts_of(const SolveArguments& arguments, const SolveResult& result) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const solver::SolverReport& report = result.report;
  const problems::StepTolerance run =
      result.run_tolerance.value_or(problems::StepTolerance{none, none, none});
  const double tolerance = arguments.settings.tolerance;
  const double nanoseconds =
      1e9 * result.seconds / (static_cast<double>(result.contacts) * result.report.iterations);
  const char* const solver = name_of(arguments.settings.kind);
  const auto& [words, asked_by] = tolerance_sources[static_cast<std::size_t>(arguments.tolerance_source)];
  return {
      {"", "", "problem", arguments.problem},
      {"solver",
       fmt::format("{}, on {}, from {}", solver, result.bodies > 0 ? "bodies" : "W, q and mu alone",
                   arguments.cold ? "zero" : "the guess"),
       "solver", solver},
      {"", "", "form", result.bodies > 0 ? "bodies" : "local"},
      {"", "", "start", arguments.cold ? "zero" : "guess"},
      {"contacts", std::to_string(result.contacts), "contacts", result.contacts},
      {"iterations", std::to_string(report.iterations), "iterations", report.iterations},
      {"residual eta",
       fmt::format("{:.3e} ({}, {:.1e} required by {})", report.residual.eta,
                   report.converged ? "converged" : "NOT CONVERGED", tolerance, words),
       "eta", report.residual.eta},
      {"", "", "tolerance", tolerance},
      {"", "", "asked_by", asked_by},
      {"", "", "converged", report.converged},
      {"largest of one contact", number_text(report.residual.largest, "{:.3e}"), "largest_residual",
       report.residual.largest},
      {"Siconos's error", number_text(result.siconos_error, "{:.3e}"), "siconos_error", result.siconos_error},
      {"weight carried", number_text(result.carried_weight, "{:.6f}"), "carried_weight",
       result.carried_weight},
      {"", "", "bed_velocity", run.velocity},
      {"", "", "run_tolerance", run.asked},
      {"", "", "run_tolerance_at_rest", run.at_rest},
      {"seconds", number_text(result.seconds, "{:.6f}"), "seconds", result.seconds},
      {"ns / contact / iteration", number_text(nanoseconds, "{:.2f}"), "ns_per_contact_iteration",
       nanoseconds},
      {run.asked > run.at_rest ? remark_on_moving(run, report.residual.eta) : "", ""}};
}

void run(SolveArguments& arguments) {
  if (!arguments.output.empty()) output_target(arguments.output, {arguments.overwrite, {arguments.problem}});
  const problems::StoredProblem stored = problems::read_problem(arguments.problem);
  choose_tolerance(stored, arguments);
  const SolveResult result = solve(stored, arguments);
  print_facts(facts_of(arguments, result), arguments.json, 25);
  if (arguments.output.empty()) return;
  prepare_folder_of(arguments.output);
  problems::write_solution(arguments.problem, arguments.output, result.solution);
}

void add_settings(CLI::App& command, SolveArguments& arguments) {
  solver::SolverSettings& settings = arguments.settings;
  settings.max_iterations = 100000;
  const std::map<std::string, solver::SolverKind> kinds = {
      {"accelerated", solver::SolverKind::accelerated}, {"gauss-seidel", solver::SolverKind::gauss_seidel}};
  command
      .add_option_function<std::string>(
          "--solver", [&settings, kinds](const std::string& name) { settings.kind = kinds.at(name); },
          "accelerated, or the reference gauss-seidel")
      ->default_str("accelerated")
      ->check(one_of({"accelerated", "gauss-seidel"}));
  add_option(command, "--tol", arguments.tolerance, "ETA",
             fmt::format("Natural-map residual eta to reach [that required by the run, or {} if unknown]",
                         scenario::short_text(settings.tolerance)))
      ->check(in_range(1e-15, 1.0));
  add_option(command, "--max-iterations", settings.max_iterations, "N", "Maximum number of iterations")
      ->capture_default_str()
      ->check(in_range(0, 1000000000));
  add_threads_option(command, settings.threads, "Threads of the accelerated solver, if the bodies are known");
}

}  // namespace

void add_solve_command(CLI::App& app) {
  auto arguments = std::make_shared<SolveArguments>();
  CLI::App* command =
      app.add_subcommand("solve", "Solve a contact problem from a file and report on the solution");
  command
      ->add_option("PROBLEM", arguments->problem,
                   "Problem file from talus dump, or an FCLIB local problem in 2D")
      ->required();
  add_settings(*command, *arguments);
  command->add_flag("--cold", arguments->cold, "Start from zero instead of the guess in the file");
  add_option(*command, "-o,--output", arguments->output, "FILE",
             "Write a copy of the problem that includes the solution in /solution");
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->add_flag("--json", arguments->json, "Print JSON; the seconds are those of the solver alone");
  command->footer(
      "A solver that does not converge is a valid result: it is reported with its\nresidual, and the exit "
      "code is 0. If the bed was moving in the step, a\nsentence says so and compares the result with the "
      "tolerance that the run\nrequired.");
  command->callback([arguments] { run(*arguments); });
}

namespace {

struct DumpArguments {
  std::string run;
  std::string output;
  std::string at;  ///< syntax of frames_at
  bool overwrite = false;
};

void dump(const DumpArguments& arguments) {
  output_target(arguments.output, output_of_run(arguments.run, arguments.overwrite));
  const io::RunFile run = io::RunFile::open(arguments.run);
  const std::size_t k = pictures::single_frame(
      chosen_frames(run, arguments.run, {.at = {arguments.at}, .every = {}}), arguments.at);
  const std::int64_t number = run.frame(k).step + 1;
  const problems::StepProblem step = problems::problem_after_frame(run, k);
  const std::string from = fmt::format("step {} at {} deg", number, degrees_text(step.scales.tilt, 3));
  prepare_folder_of(arguments.output);
  problems::write_problem(arguments.output, step,
                          fmt::format("Talus, {} of a run with seed {}", from, run.header().seed));
  print("{}: {}, after frame {}: {} contacts of {} bodies{}\n", arguments.output, from, k,
        step.problem.contact_count(), step.problem.body_count(),
        number == run.checkpoint().world.step + 1 ? ", bit-identical to the run"
                                                  : ", from a frame in single precision");
}

}  // namespace

void add_dump_command(CLI::App& app) {
  auto arguments = std::make_shared<DumpArguments>();
  CLI::App* command = app.add_subcommand(
      "dump", "Write the contact problem of a step for external solvers (FCLIB local problem)");
  add_run_argument(*command, arguments->run);
  add_option(*command, "--at", arguments->at, "DEG",
             "Frame that precedes the step: an angle in degrees (nearest frame), repose for the last frame "
             "before failure, or frame42 by number")
      ->required();
  add_option(*command, "-o,--output", arguments->output, "FILE",
             "Problem file to write (HDF5; see docs/problem_files.md)")
      ->required();
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->callback([arguments] { dump(*arguments); });
}

}  // namespace talus::app
