#include "forces.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "analysis/frame_analysis.h"
#include "base/errors.h"
#include "problems/step_problem.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"
#include "session/measure.h"
#include "solver/solve.h"

namespace py = pybind11;

namespace talus {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

std::vector<double> values_of(const Numbers& array, std::size_t count) {
  if (static_cast<std::size_t>(array.size()) != count)
    throw Error(ExitCode::usage, "the impulses: expected one for each contact");
  return {array.data(), array.data() + array.size()};
}

template <typename Number>
py::array_t<Number> array_of(const std::vector<Number>& values) {
  return py::array_t<Number>(std::ssize(values), values.data());
}

/// A frame of a run with its grains held in place, and the quantities that depend on its forces.
class HeldFrame {
 public:
  HeldFrame(const std::string& path, std::size_t k, const std::vector<std::string>& settings)
      : HeldFrame(io::RunFile::open(path), k, settings) {}

  const problems::FrozenBed& bed() const { return bed_; }
  const problems::StepProblem& step() const { return bed_.step; }
  std::vector<double> factors() const { return parameters_.threshold_factors; }

  /// Measures the forces that the run has stored.
  std::vector<double> stored_values() const { return values(stored_); }

  /// Returns Gamma, the share of critical contacts, and p_o, mean and largest l_c (D) at each threshold, with
  /// these impulses and the velocities that they leave.
  std::vector<double> values(const Numbers& pn, const Numbers& pt) const {
    solver::ContactSolution solution = solution_of(pn, pt);
    solver::velocities_from_impulses(step().problem, solution);
    World world = bed_.world;
    const Index free = world.grains.free_count;
    std::copy_n(solution.vx.begin(), free, world.grains.vx.begin());
    std::copy_n(solution.vy.begin(), free, world.grains.vy.begin());
    std::copy_n(solution.omega.begin(), free, world.grains.omega.begin());
    for (std::size_t c = 0; c < solution.pn.size(); ++c) {
      world.contacts.fn[c] = solution.pn[c] / step().scales.h;
      world.contacts.ft[c] = solution.pt[c] / step().scales.h;
    }
    return values(session::make_frame(world, bed_.law));
  }

  /// Solves the problem from these impulses with its contacts in an order, to a residual eta. Returns the
  /// impulses, the iterations, eta, and whether it has converged.
  py::tuple solve(const Numbers& pn, const Numbers& pt, bool sweeps, double tolerance, int max_iterations,
                  const std::vector<std::size_t>& order) const {
    const solver::ContactSolution guess = solution_of(pn, pt);
    const std::size_t count = guess.pn.size();
    if (order.size() != count) throw Error(ExitCode::usage, "the order: expected all contacts");
    solver::ContactProblem problem = step().problem;
    solver::ContactSolution solution = guess;
    const auto take = [&order](const auto& from, auto& to) {
      for (std::size_t c = 0; c < order.size(); ++c) to[c] = from.at(order[c]);
    };
    take(step().problem.a, problem.a);
    take(step().problem.b, problem.b);
    for (auto field : {&solver::ContactProblem::nx, &solver::ContactProblem::ny, &solver::ContactProblem::cn,
                       &solver::ContactProblem::ct, &solver::ContactProblem::mu})
      take(step().problem.*field, problem.*field);
    take(guess.pn, solution.pn);
    take(guess.pt, solution.pt);
    solver::SolverSettings settings;
    settings.kind = sweeps ? solver::SolverKind::gauss_seidel : solver::SolverKind::accelerated;
    settings.tolerance = tolerance;
    settings.max_iterations = max_iterations;
    solver::SolverWorkspace workspace;
    solver::SolverReport report;
    {
      const py::gil_scoped_release let_go;
      report = solver::solve(problem, settings, workspace, solution);
    }
    solver::ContactSolution found = guess;
    for (std::size_t c = 0; c < count; ++c) {
      found.pn[order[c]] = solution.pn[c];
      found.pt[order[c]] = solution.pt[c];
    }
    return py::make_tuple(array_of(found.pn), array_of(found.pt), report.iterations, report.residual.eta,
                          report.converged);
  }

 private:
  HeldFrame(const io::RunFile& run, std::size_t k, const std::vector<std::string>& settings)
      : bed_(problems::frozen_frame(run, k)),
        stored_(run.frame(k)),
        statics_(run.header().statics),
        parameters_(runs::parse_analysis_settings(settings)),
        analysis_(analysis::begin_analysis(
            statics_, parameters_, find_value(run.checkpoint().results, "theta_c").value_or(not_known))) {
    if (parameters_.averaging > 0.0)
      throw Error(ExitCode::bad_data, "the forces of one frame cannot be averaged over frames");
    if (analysis_.thresholds.empty())
      throw Error(ExitCode::bad_data,
                  "the slope has not failed, so Gamma_c is not known; give it with --set gamma_c=0.3");
  }

  solver::ContactSolution solution_of(const Numbers& pn, const Numbers& pt) const {
    const std::size_t count = step().guess.pn.size();
    solver::ContactSolution solution = step().guess;
    solution.pn = values_of(pn, count);
    solution.pt = values_of(pt, count);
    return solution;
  }

  std::vector<double> values(Frame frame) const {
    const analysis::FrameRecord record = analysis::analyse_frame(
        {analysis::with_analysed_gamma(std::move(frame), statics_, parameters_), statics_}, parameters_,
        analysis_);
    std::vector<double> found = {record.stress_ratio, record.critical_share};
    for (const analysis::FrameThreshold& at : record.thresholds)
      found.insert(found.end(), {at.overloaded_fraction, at.lc_mean / statics_.mean_diameter,
                                 at.lc_max / statics_.mean_diameter});
    return found;
  }

  problems::FrozenBed bed_;
  Frame stored_;
  RunStatics statics_;
  analysis::AnalysisParameters parameters_;
  analysis::Analysis analysis_;  ///< thresholds and cut of l_c, without frames
};

}  // namespace

void bind_forces(py::module_& module) {
  py::class_<HeldFrame> type(module, "HeldFrame");
  type.def(py::init<const std::string&, std::size_t, const std::vector<std::string>&>());
  using Problem = solver::ContactProblem;
  const auto reals = [&type](const char* name, std::vector<double> Problem::*field) {
    type.def_property_readonly(
        name, [field](const HeldFrame& frame) { return array_of(frame.step().problem.*field); });
  };
  reals("vx", &Problem::vx);
  reals("vy", &Problem::vy);
  reals("omega", &Problem::omega);
  reals("inverse_mass", &Problem::inverse_mass);
  reals("inverse_inertia", &Problem::inverse_inertia);
  reals("lever", &Problem::lever);
  reals("nx", &Problem::nx);
  reals("ny", &Problem::ny);
  reals("cn", &Problem::cn);
  reals("mu", &Problem::mu);
  type.def_property_readonly("a", [](const HeldFrame& frame) { return array_of(frame.step().problem.a); });
  type.def_property_readonly("b", [](const HeldFrame& frame) { return array_of(frame.step().problem.b); });
  type.def_property_readonly("pn", [](const HeldFrame& frame) { return array_of(frame.step().guess.pn); });
  type.def_property_readonly("pt", [](const HeldFrame& frame) { return array_of(frame.step().guess.pt); });
  type.def_property_readonly("free_count",
                             [](const HeldFrame& frame) { return frame.bed().world.grains.free_count; });
  type.def_property_readonly(
      "radius", [](const HeldFrame& frame) { return array_of(frame.bed().world.grains.radius); });
  type.def_property_readonly(
      "fall", [](const HeldFrame& frame) { return frame.step().scales.gravity * frame.step().scales.h; });
  type.def_property_readonly("tilt", [](const HeldFrame& frame) { return frame.step().scales.tilt; });
  type.def_property_readonly("factors", &HeldFrame::factors);
  type.def("stored_values", &HeldFrame::stored_values);
  type.def("values", py::overload_cast<const Numbers&, const Numbers&>(&HeldFrame::values, py::const_));
  type.def("solve", &HeldFrame::solve);
}

}  // namespace talus
