#include "problems/problem_file.h"

#include <algorithm>
#include <array>
#include <fmt/core.h>

#include "base/errors.h"
#include "problems/fclib_file.h"

namespace talus::problems {
namespace {

/// A data set and the member that it holds.
template <typename Record, typename Value>
struct Field {
  const char* path;
  Value Record::*value;
};

constexpr std::array<Field<solver::ContactProblem, std::vector<double>>, 10> real_fields = {{
    {"/talus/bodies/vx", &solver::ContactProblem::vx},
    {"/talus/bodies/vy", &solver::ContactProblem::vy},
    {"/talus/bodies/omega", &solver::ContactProblem::omega},
    {"/talus/bodies/inverse_mass", &solver::ContactProblem::inverse_mass},
    {"/talus/bodies/inverse_inertia", &solver::ContactProblem::inverse_inertia},
    {"/talus/bodies/lever", &solver::ContactProblem::lever},
    {"/talus/contacts/nx", &solver::ContactProblem::nx},
    {"/talus/contacts/ny", &solver::ContactProblem::ny},
    {"/talus/contacts/cn", &solver::ContactProblem::cn},
    {"/talus/contacts/ct", &solver::ContactProblem::ct},
}};

constexpr std::array<Field<StepScales, double>, 5> scale_fields = {{
    {"/talus/scales/time_step", &StepScales::h},
    {"/talus/scales/gravity", &StepScales::gravity},
    {"/talus/scales/tilt", &StepScales::tilt},
    {"/talus/scales/mean_diameter", &StepScales::mean_diameter},
    {"/talus/scales/weight", &StepScales::weight},
}};

constexpr std::array<Field<StepTolerance, double>, 3> tolerance_fields = {{
    {"/talus/run/velocity", &StepTolerance::velocity},
    {"/talus/run/tolerance", &StepTolerance::asked},
    {"/talus/run/tolerance_at_rest", &StepTolerance::at_rest},
}};

constexpr const char* first_body = "/talus/contacts/a";
constexpr const char* second_body = "/talus/contacts/b";
constexpr const char* column = "/talus/bodies/column";

/// Returns the components as (n, t) of contact 0, (n, t) of contact 1, ...
template <typename Pair>
std::vector<double> flat(const std::vector<Pair>& pairs) {
  std::vector<double> values;
  values.reserve(2 * pairs.size());
  for (const Pair& pair : pairs) values.insert(values.end(), {pair.normal, pair.tangential});
  return values;
}

template <typename Pair>
std::vector<Pair> pairs(const std::vector<double>& values) {
  std::vector<Pair> result(values.size() / 2);
  for (std::size_t c = 0; c < result.size(); ++c) result[c] = {values[2 * c], values[2 * c + 1]};
  return result;
}

/// Writes the entries of W by rows.
void put_matrix(const solver::LocalProblem& local, FclibProblem& file) {
  for (Index row = 0; row < 2 * local.contact_count(); ++row) {
    const Index c = row / 2;
    for (Index k = local.row_begin[c]; k < local.row_begin[c + 1]; ++k) {
      const solver::DelassusBlock& w = local.block[k];
      file.row.insert(file.row.end(), 2, row);
      file.column.insert(file.column.end(), {2 * local.column[k], 2 * local.column[k] + 1});
      if (row % 2 == 0)
        file.value.insert(file.value.end(), {w.nn, w.nt});
      else
        file.value.insert(file.value.end(), {w.tn, w.tt});
    }
  }
}

solver::LocalProblem local_problem_of(const FclibProblem& file) {
  std::vector<solver::MatrixEntry> entries(file.value.size());
  for (std::size_t k = 0; k < entries.size(); ++k) entries[k] = {file.row[k], file.column[k], file.value[k]};
  return solver::local_problem(std::move(entries), pairs<solver::RelativeVelocity>(file.q), file.mu);
}

/// Checks conditions on which solvers rely, beyond sizes and ranges.
void check_bodies(const std::string& path, const solver::ContactProblem& problem) {
  const auto refuse = [&path](const char* set, Index k, const char* what) {
    throw Error(ExitCode::bad_data, "{}: data set {} {}, at index {}", path, set, what, k);
  };
  for (Index c = 0; c < problem.contact_count(); ++c) {
    if (problem.a[c] == problem.b[c]) refuse(second_body, c, "names the same body as /talus/contacts/a");
    if (c > 0 && problem.a[c] < problem.a[c - 1]) refuse(first_body, c, "does not ascend");
  }
  for (Index i = 0; i < problem.body_count(); ++i) {
    if (problem.inverse_mass[i] < 0.0) refuse("/talus/bodies/inverse_mass", i, "is negative");
    if (problem.inverse_inertia[i] < 0.0) refuse("/talus/bodies/inverse_inertia", i, "is negative");
  }
}

/// Returns the tolerance of the run; no value if the file does not contain it.
std::optional<StepTolerance> tolerance_of(const std::string& path, const FclibProblem& file) {
  if (!file.reals.contains(tolerance_fields[0].path)) return std::nullopt;
  StepTolerance tolerance;
  for (const auto& field : tolerance_fields) {
    tolerance.*field.value = file.reals.at(field.path)[0];
    if (tolerance.*field.value < 0.0)
      throw Error(ExitCode::bad_data, "{}: data set {} is negative", path, field.path);
  }
  for (const double asked : {tolerance.asked, tolerance.at_rest})
    if (!(asked > 0.0))
      throw Error(ExitCode::bad_data, "{}: a tolerance in /talus/run is 0, but must be positive", path);
  return tolerance;
}

StepProblem step_problem_of(const std::string& path, const FclibProblem& file,
                            const std::vector<solver::Impulse>& guess) {
  StepProblem step;
  for (const auto& field : real_fields) step.problem.*field.value = file.reals.at(field.path);
  for (const auto& field : scale_fields) step.scales.*field.value = file.reals.at(field.path)[0];
  step.tolerance = tolerance_of(path, file);
  step.problem.a = file.integers.at(first_body);
  step.problem.b = file.integers.at(second_body);
  step.problem.mu = file.mu;
  if (file.integers.contains(column)) step.problem.column = file.integers.at(column);
  for (const Index k : step.problem.column) step.problem.columns = std::max(step.problem.columns, k + 1);
  check_bodies(path, step.problem);
  for (const solver::Impulse& p : guess) {
    step.guess.pn.push_back(p.normal);
    step.guess.pt.push_back(p.tangential);
  }
  solver::velocities_from_impulses(step.problem, step.guess);
  return step;
}

}  // namespace

void write_problem(const std::string& path, const StepProblem& step, const std::string& title) {
  const solver::LocalProblem local = solver::local_problem(step.problem);
  const solver::LocalSolution guess = solver::local_form(step.problem, step.guess);
  FclibProblem file;
  file.title = title;
  put_matrix(local, file);
  file.q = flat(local.q);
  file.mu = local.mu;
  file.guess_r = flat(guess.p);
  for (const auto& field : real_fields) file.reals[field.path] = step.problem.*field.value;
  for (const auto& field : scale_fields) file.reals[field.path] = {step.scales.*field.value};
  if (step.tolerance)
    for (const auto& field : tolerance_fields) file.reals[field.path] = {(*step.tolerance).*field.value};
  file.integers[first_body] = step.problem.a;
  file.integers[second_body] = step.problem.b;
  if (!step.problem.column.empty()) file.integers[column] = step.problem.column;
  write_fclib(path, file, flat(guess.u));
}

StoredProblem stored_problem(const std::string& path, const FclibProblem& file) {
  StoredProblem stored;
  stored.local = local_problem_of(file);
  stored.guess = pairs<solver::Impulse>(file.guess_r);
  stored.guess.resize(file.mu.size());
  if (!file.reals.empty()) stored.step = step_problem_of(path, file, stored.guess);
  return stored;
}

StoredProblem read_problem(const std::string& path) { return stored_problem(path, read_fclib(path)); }

void write_solution(const std::string& from, const std::string& to, const solver::LocalSolution& solution) {
  write_fclib_solution(from, to, flat(solution.p), flat(solution.u));
}

}  // namespace talus::problems
