/// `talus solve`: solves a contact problem from a file, written by Talus or another program.

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fmt/core.h>
#include <limits>
#include <memory>
#include <optional>

#include "app/choices.h"
#include "app/commands.h"
#include "app/json.h"
#include "app/moving_step.h"
#include "app/terminal.h"
#include "base/output_file.h"
#include "problems/local_solvers.h"
#include "problems/problem_file.h"
#include "problems/siconos_error.h"
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

  double nanoseconds_per_contact() const {
    return 1e9 * seconds / (static_cast<double>(contacts) * report.iterations);
  }
};

const char* name_of(solver::SolverKind kind) {
  return kind == solver::SolverKind::gauss_seidel ? "gauss-seidel" : "accelerated";
}

const char* name_of(ToleranceSource tolerance_source) {
  if (tolerance_source == ToleranceSource::default_value) return "default";
  return tolerance_source == ToleranceSource::option ? "option" : "run";
}

const char* words_of(ToleranceSource tolerance_source) {
  if (tolerance_source == ToleranceSource::default_value) return "default";
  return tolerance_source == ToleranceSource::option ? "--tol" : "the run";
}

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

void print_json(const SolveArguments& arguments, const SolveResult& result) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const problems::StepTolerance run_tolerance =
      result.run_tolerance.value_or(problems::StepTolerance{none, none, none});
  const Json json = {{"problem", arguments.problem},
                     {"solver", name_of(arguments.settings.kind)},
                     {"form", result.bodies > 0 ? "bodies" : "local"},
                     {"start", arguments.cold ? "zero" : "guess"},
                     {"contacts", result.contacts},
                     {"tolerance", arguments.settings.tolerance},
                     {"asked_by", name_of(arguments.tolerance_source)},
                     {"converged", result.report.converged},
                     {"iterations", result.report.iterations},
                     {"eta", result.report.residual.eta},
                     {"siconos_error", result.siconos_error},
                     {"largest_residual", result.report.residual.largest},
                     {"carried_weight", result.carried_weight},
                     {"bed_velocity", run_tolerance.velocity},
                     {"run_tolerance", run_tolerance.asked},
                     {"run_tolerance_at_rest", run_tolerance.at_rest},
                     {"seconds", result.seconds},
                     {"ns_per_contact_iteration", result.nanoseconds_per_contact()}};
  print("%s\n", json_text(json).c_str());
}

void print_number(const char* name, const char* format, double value) {
  print("%-25s", name);
  if (std::isfinite(value))
    print(format, value);
  else
    print("none");
  print("\n");
}

void print_report(const SolveArguments& arguments, const SolveResult& result) {
  const solver::SolverReport& report = result.report;
  print("%-25s%s, on %s, from %s\n", "solver", name_of(arguments.settings.kind),
        result.bodies > 0 ? "bodies" : "W, q and mu alone", arguments.cold ? "zero" : "the guess");
  print("%-25s%d\n", "contacts", result.contacts);
  print("%-25s%d\n", "iterations", report.iterations);
  print("%-25s%.3e (%s, %.1e required by %s)\n", "residual eta", report.residual.eta,
        report.converged ? "converged" : "NOT CONVERGED", arguments.settings.tolerance,
        words_of(arguments.tolerance_source));
  print_number("largest of one contact", "%.3e", report.residual.largest);
  print_number("Siconos's error", "%.3e", result.siconos_error);
  print_number("weight carried", "%.6f", result.carried_weight);
  print_number("seconds", "%.6f", result.seconds);
  print_number("ns / contact / iteration", "%.2f", result.nanoseconds_per_contact());
  if (result.run_tolerance && is_moving(*result.run_tolerance))
    print("%s\n", remark_on_moving(*result.run_tolerance, report.residual.eta).c_str());
}

void run(SolveArguments& arguments) {
  if (!arguments.output.empty()) output_target(arguments.output, {arguments.overwrite, {arguments.problem}});
  const problems::StoredProblem stored = problems::read_problem(arguments.problem);
  choose_tolerance(stored, arguments);
  const SolveResult result = solve(stored, arguments);
  if (arguments.json)
    print_json(arguments, result);
  else
    print_report(arguments, result);
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
  command
      .add_option(
          "--tol", arguments.tolerance,
          fmt::format("Natural-map residual eta to reach [that required by the run, or {} if unknown]",
                      scenario::short_text(settings.tolerance)))
      ->check(in_range(1e-15, 1.0));
  command.add_option("--max-iterations", settings.max_iterations, "Maximum number of iterations")
      ->capture_default_str()
      ->check(in_range(0, 1000000000));
  command
      .add_option(
          "--threads", settings.threads,
          "Threads of the accelerated solver, if the bodies are known; the result does not depend on it")
      ->capture_default_str()
      ->check(in_range(1, 256));
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
  command->add_option("-o,--output", arguments->output,
                      "Write a copy of the problem that includes the solution in /solution");
  command->add_flag("--overwrite", arguments->overwrite, "Replace an existing file");
  command->add_flag("--json", arguments->json, "Print JSON; the seconds are those of the solver alone");
  command->footer(
      "A solver that does not converge is a valid result: it is reported with its\nresidual, and the exit "
      "code is 0. If the bed was moving in the step, a\nsentence says so and compares the result with the "
      "tolerance that the run\nrequired.");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace talus::app
