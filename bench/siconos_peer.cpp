#include "siconos_peer.h"

// The headers of Siconos are C.
#define restrict __restrict
#include <FrictionContactProblem.h>
#include <NonSmoothDrivers.h>
#include <NumericsMatrix.h>
#include <SolverOptions.h>
#include <SparseBlockMatrix.h>
#include <fc2d_compute_error.h>
#undef restrict

#include <cmath>
#include <numeric>

#include "processor_time.h"

namespace talus::bench {
namespace {

struct DeleteOptions {
  void operator()(SolverOptions* options) const { solver_options_delete(options); }
};
using Options = std::unique_ptr<SolverOptions, DeleteOptions>;

Options make_options(SiconosSolver solver, double tolerance, int max_iterations) {
  Options options(solver_options_create(static_cast<int>(solver)));
  options->dparam[SICONOS_DPARAM_TOL] = tolerance;
  options->iparam[SICONOS_IPARAM_MAX_ITER] = max_iterations;
  return options;
}

double norm(const std::vector<double>& values) {
  return std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0));
}

std::vector<double> flat(const std::vector<solver::Impulse>& p) {
  std::vector<double> r;
  for (const solver::Impulse& impulse : p) r.insert(r.end(), {impulse.normal, impulse.tangential});
  return r;
}

}  // namespace

struct SiconosProblem::State {
  std::vector<double> q, mu, dense;
  std::vector<solver::DelassusBlock> blocks;
  std::vector<double*> block;
  std::vector<unsigned int> size;  ///< number of rows up to the end of each block row
  std::vector<std::size_t> row_begin, column;
  SparseBlockStructuredMatrix sparse{};
  NumericsMatrix* matrix = nullptr;
  FrictionContactProblem* problem = nullptr;

  void point_at_blocks(const solver::LocalProblem& local);
  void fill_dense(const solver::LocalProblem& local);
};

void SiconosProblem::State::point_at_blocks(const solver::LocalProblem& local) {
  static_assert(sizeof(solver::DelassusBlock) == 4 * sizeof(double));
  const auto contacts = static_cast<std::size_t>(local.contact_count());
  blocks = local.block;
  for (solver::DelassusBlock& each : blocks) block.push_back(&each.nn);
  for (std::size_t c = 0; c < contacts; ++c) size.push_back(static_cast<unsigned int>(2 * (c + 1)));
  row_begin.assign(local.row_begin.begin(), local.row_begin.end());
  column.assign(local.column.begin(), local.column.end());
  sparse.nbblocks = static_cast<unsigned int>(block.size());
  sparse.block = block.data();
  sparse.blocknumber0 = sparse.blocknumber1 = static_cast<unsigned int>(contacts);
  sparse.blocksize0 = sparse.blocksize1 = size.data();
  sparse.filled1 = row_begin.size();
  sparse.filled2 = column.size();
  sparse.index1_data = row_begin.data();
  sparse.index2_data = column.data();
  matrix->storageType = NM_SPARSE_BLOCK;
  matrix->matrix1 = &sparse;
}

void SiconosProblem::State::fill_dense(const solver::LocalProblem& local) {
  const std::size_t n = q.size();
  dense.assign(n * n, 0.0);
  for (std::size_t c = 0; c < mu.size(); ++c)
    for (Index k = local.row_begin[c]; k < local.row_begin[c + 1]; ++k) {
      const solver::DelassusBlock& w = local.block[k];
      double* first = &dense[static_cast<std::size_t>(2 * local.column[k]) * n + 2 * c];
      first[0] = w.nn;
      first[1] = w.tn;
      first[n] = w.nt;
      first[n + 1] = w.tt;
    }
  matrix->storageType = NM_DENSE;
  matrix->matrix0 = dense.data();
}

SiconosProblem::SiconosProblem(const solver::LocalProblem& local, Storage storage)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  for (const solver::RelativeVelocity& q : local.q) s.q.insert(s.q.end(), {q.normal, q.tangential});
  s.mu = local.mu;
  s.matrix = NM_new();
  s.matrix->size0 = s.matrix->size1 = static_cast<int>(s.q.size());
  if (storage == Storage::sparse_blocks)
    s.point_at_blocks(local);
  else
    s.fill_dense(local);
  s.problem =
      frictionContactProblem_new_with_data(2, local.contact_count(), s.matrix, s.q.data(), s.mu.data());
}

SiconosProblem::~SiconosProblem() {
  // The state owns all arrays; Siconos must not free them.
  state_->matrix->matrix0 = nullptr;
  state_->matrix->matrix1 = nullptr;
  state_->problem->q = nullptr;
  state_->problem->mu = nullptr;
  frictionContactProblem_free(state_->problem);
}

SiconosReport SiconosProblem::solve(SiconosSolver solver, double tolerance, int max_iterations,
                                    std::vector<solver::Impulse>& p) {
  const Options options = make_options(solver, tolerance, max_iterations);
  std::vector<double> r = flat(p);
  std::vector<double> u(r.size(), 0.0);
  SiconosReport report;
  const double start = processor_seconds();
  report.info = fc2d_driver(state_->problem, r.data(), u.data(), options.get());
  report.seconds = processor_seconds() - start;
  report.iterations = options->iparam[SICONOS_IPARAM_ITER_DONE];
  report.error = options->dparam[SICONOS_DPARAM_RESIDU];
  for (std::size_t c = 0; c < p.size(); ++c) p[c] = {r[2 * c], r[2 * c + 1]};
  return report;
}

double SiconosProblem::error(std::vector<solver::Impulse> p) {
  std::vector<double> r = flat(p);
  std::vector<double> u(r.size(), 0.0);
  double error = 0.0;
  fc2d_compute_error(state_->problem, r.data(), u.data(), 1.0, norm(state_->q), &error);
  return error;
}

}  // namespace talus::bench
