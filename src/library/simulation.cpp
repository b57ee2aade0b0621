#include "library/simulation.h"

#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <fmt/core.h>
#include <limits>
#include <utility>

#include "base/errors.h"
#include "base/hash.h"
#include "base/output_file.h"
#include "base/text.h"
#include "core/trigonometry.h"
#include "io/child_process.h"
#include "io/run_file.h"
#include "library/measured_frame.h"
#include "runs/analysis_parameters.h"
#include "runs/run_view.h"
#include "session/estimate.h"
#include "session/measure.h"
#include "session/run.h"
#include "session/run_header.h"
#include "session/session.h"

namespace talus {
namespace {

constexpr std::chrono::milliseconds interrupt_interval(50);

/// A crash of HDF5 on a malformed file would end the program or interpreter that uses the library.
[[maybe_unused]] const bool walks_first = io::walk_before_opening();

void require_finite(double value, const char* what) {
  if (!std::isfinite(value)) throw Error(ExitCode::usage, "{} {}: expected a finite number", what, value);
}

}  // namespace

struct Simulation::State {
  session::Session session;
  RunStatics statics;
  session::RunOrigin origin;
  std::optional<io::RunStore> store;
  std::optional<session::Recorder> recorder;
  std::function<bool()> interrupts;
  analysis::AnalysisParameters parameters;
  std::vector<std::string> departures{};  ///< commands given so far, for the history of a branch
  bool is_new = true;                     ///< neither stepped nor changed
  double owed_steps = 0.0;                ///< fraction of a step that Simulation::steps_in carries over
  std::optional<double> aimed{};  ///< tilt (deg) that the last step has reached for Simulation::tilt_to
  std::optional<Frame> begin{};   ///< frame at the start of the tilt, if the simulation reached it

  std::optional<MeasuredFrame> measured{};  ///< measurements of the state after the last step, if requested

  pid_t process;  ///< the creating process; a forked child may only inspect and copy the state

  explicit State(session::Session from);
  bool is_own() const;
  /// Throws Error(usage) in a forked child.
  void require_own() const;

  /// Takes one step and records it.
  void advance();
  /// Makes recorded data durable, and packs the run when it is over.
  void commit();
  MeasuredFrame& measure();
};

Simulation::State::State(session::Session from)
    : session(std::move(from)),
      statics(session::run_statics(session.scenario(), session.world())),
      process(::getpid()) {}

bool Simulation::State::is_own() const { return process == ::getpid(); }

void Simulation::State::require_own() const {
  if (!is_own())
    throw Error(ExitCode::usage,
                "the simulation, its threads and its recording belong to the parent of this forked process: "
                "use copy() to create one in this process");
}

void Simulation::State::advance() {
  measured.reset();
  aimed.reset();
  is_new = false;
  const session::Phase before = session.phase();
  if (recorder)
    recorder->advance();
  else
    session.advance();
  if (before == session::Phase::deposition && session.phase() == session::Phase::tilt)
    begin = session.frame();
  if (!recorder)
    session.clear_segment();
  else if (session.phase() == session::Phase::done)
    commit();
  else
    recorder->commit_if_due();
}

void Simulation::State::commit() {
  recorder->commit();
  if (session.phase() != session::Phase::done) return;
  store->pack();
  recorder.reset();
  store.reset();
}

MeasuredFrame& Simulation::State::measure() {
  if (!measured) {
    Frame frame = session.frame();
    RunStatics arrived = arrived_statics(statics, frame.grain_count());
    measured.emplace(std::move(frame), std::move(arrived), parameters, session.angle_of_repose(), begin,
                     session.row());
  }
  return *measured;
}

Simulation::Simulation(std::unique_ptr<State> state) : state_(std::move(state)) {}

Simulation::Simulation(const scenario::Scenario& scenario, std::string text) {
  session::require_memory(scenario);
  state_ = std::make_unique<State>(session::Session(scenario));
  state_->origin.scenario_text = text.empty() ? scenario::resolved_toml(scenario) : std::move(text);
}

Simulation Simulation::resume(const std::string& name) {
  io::RunHeader header;
  io::Checkpoint checkpoint;
  const std::string path = absolute_path(name);  // remains valid if the process changes its folder
  io::RunStore store = io::RunStore::resume(path, header, checkpoint);
  const scenario::Scenario scenario = runs::stored_scenario(header, path + ":/parameters");
  session::refuse_unfinished_replay(header, checkpoint.world, path);
  auto state = std::make_unique<State>(session::Session(scenario, std::move(checkpoint), path));
  state->is_new = false;
  state->origin.scenario_text = header.scenario_given;
  state->store.emplace(std::move(store));
  state->recorder.emplace(state->session, *state->store);
  const io::RunFile run = io::RunFile::open(path);
  state->departures = session::departures(run, scenario);
  if (!run.all_frame_tilts().empty()) state->begin = run.frame(0);
  return Simulation(std::move(state));
}

Simulation::Simulation(const Simulation& other)
    : state_(std::make_unique<State>(other.state_->session.copy())) {
  state_->origin = other.state_->origin;
  state_->parameters = other.state_->parameters;
  state_->begin = other.state_->begin;
  state_->departures = other.state_->departures;
  state_->is_new = other.state_->is_new;
  state_->owed_steps = other.state_->owed_steps;
  state_->aimed = other.state_->aimed;
}

Simulation::Simulation(Simulation&&) noexcept = default;

Simulation& Simulation::operator=(Simulation other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

Simulation::~Simulation() {
  // In a forked child, the threads do not exist and the recording belongs to the parent.
  if (state_ && !state_->is_own()) static_cast<void>(state_.release());
  if (!state_ || !state_->recorder) return;
  try {
    state_->commit();
  } catch (const std::exception&) {  // earlier commits are complete; commit() reports the error
  }
}

bool Simulation::advance_until(const std::function<bool(const session::Session&)>& reached) {
  State& state = *state_;
  state.require_own();
  if (done())
    throw Error(ExitCode::usage, "the run is over, at a tilt of {} deg: it has no further step",
                fixed_text(tilt(), 3));
  auto asked = std::chrono::steady_clock::now();
  while (!done() && !reached(state.session)) {
    state.advance();
    const auto now = std::chrono::steady_clock::now();
    if (!state.interrupts || now - asked < interrupt_interval) continue;
    asked = now;
    if (state.interrupts()) return false;
    state.require_own();  // the callback may have forked
  }
  return true;
}

bool Simulation::step(std::int64_t count) {
  if (count < 0) throw Error(ExitCode::usage, "step({}): expected a count of steps, 0 or more", count);
  const std::int64_t last = world().step + std::min(count, std::numeric_limits<std::int64_t>::max() / 2);
  return advance_until([last](const session::Session& session) { return session.world().step >= last; });
}

bool Simulation::deposit() {
  return advance_until(
      [](const session::Session& session) { return session.phase() != session::Phase::deposition; });
}

bool Simulation::tilt_to(double degrees) {
  require_finite(degrees, "a tilt of");
  if (!deposit()) return false;
  const session::TiltGoal goal =
      session::aim(radians(degrees), state_->session, [this](const Command& turn) { apply(turn); });
  const bool completed = advance_until([&goal](const session::Session& session) {
    if (is_passed(goal, session)) return true;
    // A failure ends the run, at once or after its flow; a programme was checked as a whole.
    if (session.phase() != session::Phase::tilt || session.follows_program()) return false;
    if (const std::string reason = why_never(goal, session); !reason.empty())
      throw Error(ExitCode::usage, reason);
    return false;
  });
  if (!done() && is_passed(goal, state_->session)) state_->aimed = degrees;
  return completed;
}

bool Simulation::tilt_by(double degrees) {
  require_finite(degrees, "a tilt by");
  return deposit() && tilt_to(state_->aimed.value_or(tilt()) + degrees);
}

std::int64_t Simulation::steps_in(double seconds) {
  constexpr double most = 1e15;
  const double h = scenario::time_step(scenario()), owed = state_->owed_steps + seconds / h;
  if (!(seconds >= 0.0 && std::isfinite(seconds)))
    throw Error(ExitCode::usage, "a time of {} s: expected 0 s or more", seconds);
  const double steps = std::round(std::min(owed, most));
  if (steps < 1.0 && seconds < 0.5 * h)
    throw Error(ExitCode::usage, "a time of {:g} s takes no step: expected at least half a step, {:g} s",
                seconds, 0.5 * h);
  state_->owed_steps = owed < most ? owed - steps : 0.0;
  return static_cast<std::int64_t>(steps);
}

bool Simulation::run(double seconds) { return step(steps_in(seconds)); }

bool Simulation::run_until(const std::function<bool()>& holds) {
  return advance_until([&holds](const session::Session&) { return holds(); });
}

bool Simulation::finish() {
  return advance_until([](const session::Session& session) {
    if (is_held(session))
      throw Error(ExitCode::usage, "the tilt is held (tilt_rate), so the run has no end: give a duration");
    return false;
  });
}

void Simulation::interrupt_if(std::function<bool()> interrupts) {
  state_->interrupts = std::move(interrupts);
}

void Simulation::use_threads(int threads) {
  state_->require_own();
  if (threads < 1 || threads > 256) throw Error(ExitCode::usage, "{} threads: expected 1 to 256", threads);
  state_->session.use_threads(threads);
}

void Simulation::apply(const Command& command) {
  state_->require_own();
  state_->session.apply(command);
  const session::Schedule& now = state_->session.schedule();
  const bool tilts = phase() != session::Phase::deposition;
  state_->departures.push_back(session::departure_text(
      command, tilts ? tilt() : not_known,
      static_cast<double>(now.tilt_steps + now.flow_steps) * scenario::time_step(scenario())));
  if (command.kind == CommandKind::tilt_rate) state_->aimed.reset();
  state_->measured.reset();
  state_->is_new = false;
  if (!state_->recorder) state_->session.clear_segment();
}

void Simulation::push(Index grain, Vec2 velocity) { push(std::vector{grain}, std::vector{velocity}); }
void Simulation::push(const std::vector<Index>& grains, const std::vector<Vec2>& velocities) {
  const auto command = [&](std::size_t k) {
    return Command{0, CommandKind::push, grains[k], velocities[k].x, velocities[k].y};
  };
  if (grains.size() != velocities.size())
    throw Error(ExitCode::usage, "{} velocities for {} grains: expected one for each", velocities.size(),
                grains.size());
  for (std::size_t k = 0; k < grains.size(); ++k) session::check_command(command(k), scenario(), world());
  for (std::size_t k = 0; k < grains.size(); ++k) apply(command(k));
}
void Simulation::drop(Index grains, double x, double height) {
  apply({0, CommandKind::drop, grains, x, height});
}
void Simulation::drag(Index grain, Vec2 to) { apply({0, CommandKind::drag, grain, to.x, to.y}); }
void Simulation::release() { apply({0, CommandKind::release}); }
void Simulation::set_friction(double friction) { apply({0, CommandKind::friction, -1, friction}); }
void Simulation::set_tilt_rate(double rate) { apply({0, CommandKind::tilt_rate, -1, rate}); }

const scenario::Scenario& Simulation::scenario() const { return state_->session.scenario(); }
const World& Simulation::world() const { return state_->session.world(); }
session::Phase Simulation::phase() const { return state_->session.phase(); }
bool Simulation::done() const { return phase() == session::Phase::done; }
double Simulation::tilt() const { return rounded_degrees(world().tilt); }
double Simulation::tilt_rate() const {
  const std::string text = fmt::format("{:.12g}", degrees(state_->session.tilt_rate()));
  double rate = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), rate);
  return rate;
}
double Simulation::friction() const { return state_->session.law().friction; }
std::optional<double> Simulation::residual() const { return state_->session.schedule().last.residual; }
std::optional<bool> Simulation::converged() const {
  const std::optional<double> converged = state_->session.schedule().last.converged;
  return converged ? std::optional(*converged != 0.0) : std::nullopt;
}
std::string Simulation::state_hash() const { return hash_text(talus::state_hash(world())); }
std::optional<double> Simulation::theta_c() const {
  const std::optional<double> angle = state_->session.angle_of_repose();
  return angle ? std::optional(rounded_degrees(*angle)) : std::nullopt;
}
const RunStatics& Simulation::statics() const { return state_->statics; }

void Simulation::set_analysis(const std::vector<std::string>& settings) {
  state_->parameters = runs::parse_analysis_settings(settings);
  state_->measured.reset();
}

MeasuredFrame& Simulation::measured() { return state_->measure(); }
double Simulation::quantity(std::string_view name) { return state_->measure().quantity(name); }
const Frame& Simulation::frame() { return state_->measure().bed().frame; }
std::vector<double> Simulation::grain_values(std::string_view name) {
  return state_->measure().grain_values(name);
}
std::vector<double> Simulation::contact_values(std::string_view name) {
  return state_->measure().contact_values(name);
}
render::Image Simulation::draw(const pictures::MapChoice& what, const pictures::MapOptions& options) {
  return state_->measure().draw(what, options);
}

void Simulation::record(const std::string& name, bool overwrite) {
  State& state = *state_;
  state.require_own();
  if (state.recorder) throw Error(ExitCode::usage, "the simulation is being recorded already");
  if (done()) throw Error(ExitCode::usage, "the run is over: there is nothing more to record");
  if (!state.is_new && phase() == session::Phase::deposition)
    throw Error(ExitCode::usage,
                "a recording cannot begin during the deposition: begin it before the first step, or when the "
                "bed is at rest (deposit)");
  if (!state.is_new && state.session.adopt_friction())
    state.origin.scenario_text = scenario::resolved_toml(scenario());
  session::RunOrigin origin = state.origin;
  const World& now = world();
  if (!state.is_new)
    origin.branch = io::BranchOrigin{"a program", 0, hash_text(talus::state_hash(now)),
                                     state.session.checkpoint(0.0), session::history_text(state.departures)};
  const std::string path = absolute_path(name);  // remains valid if the process changes its folder
  state.session.clear_segment();
  state.store.emplace(io::RunStore::create(
      path, session::run_header(state.session, session::with_bed(origin, state.session)), overwrite));
  state.recorder.emplace(state.session, *state.store);
  if (!state.is_new) state.session.record_start();
  try {
    state.recorder->commit();
  } catch (...) {  // no run has been created
    state.recorder.reset();
    state.store.reset();
    throw;
  }
}

void Simulation::save(const std::string& path, bool overwrite) const {
  Simulation(*this).record(path, overwrite);
}

bool Simulation::recorded() const { return state_->recorder.has_value(); }

void Simulation::commit() {
  state_->require_own();
  if (state_->recorder) state_->commit();
}

}  // namespace talus
