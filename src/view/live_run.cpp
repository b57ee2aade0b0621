#include "view/live_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <span>
#include <thread>
#include <utility>

#include "base/errors.h"
#include "base/hash.h"
#include "core/trigonometry.h"
#include "session/measure.h"
#include "session/recorder.h"
#include "session/run_header.h"
#include "session/tilt_goal.h"
#include "view/live_history.h"

namespace talus::view {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::duration<double> frame_interval(1.0 / 30.0), speed_interval(0.5);

/// Point at which the run pauses.
struct Goal {
  std::int64_t step = std::numeric_limits<std::int64_t>::max();
  std::optional<session::TiltGoal> tilt{};
  bool end_of_deposition = false;
};

bool is_reached(const Goal& goal, const session::Session& session) {
  return session.world().step >= goal.step ||
         (goal.tilt && (is_passed(*goal.tilt, session) || !why_never(*goal.tilt, session).empty())) ||
         (goal.end_of_deposition && session.phase() != session::Phase::deposition);
}

/// Position in the session's segment up to which the history has copied it, or a position in the history.
struct HistoryCursor {
  std::size_t observables = 0, frames = 0, commands = 0, steps = 0;
};

constexpr std::size_t max_marks = 64;  // some megabytes each in a bed of 8000 grains

/// State of the run before a command.
struct Mark {
  io::Checkpoint state;
  HistoryCursor history;
};

/// Returns whether a command begins an action, rather than continuing or ending a drag.
bool begins(const Command& command, const std::optional<session::Drag>& drag) {
  if (command.kind == CommandKind::drag) return !drag || drag->grain != command.grain;
  return command.kind != CommandKind::release;
}

/// Returns the number of solver threads, which leaves one core to the window.
int solver_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1); }

}  // namespace

/// The session, the store and their data belong to the solver's thread alone once it runs; the rest is shared
/// and protected by the mutex.
struct LiveRun::State {
  session::Session session;
  const RunStatics statics;
  const session::RunOrigin origin;
  std::optional<io::RunStore> store;
  std::optional<session::Recorder> recorder;
  bool is_recorded = false;  ///< remains true after packing
  HistoryCursor cursor;
  std::vector<StepRow> steps;  ///< all steps since the beginning
  std::vector<Mark> marks;     ///< one before each of the last commands given
  Clock::time_point show_at;   ///< time of the next frame
  Clock::time_point speed_since;
  std::int64_t speed_step = 0;
  Clock::time_point due;  ///< time of the next step, set by the pace

  mutable std::mutex mutex;
  std::condition_variable_any asked;
  std::condition_variable answered;
  std::optional<Goal> goal;
  LivePace pace = live_paces[0];
  bool pause_asked = false;
  std::function<void()> request;  ///< pending request; the solver executes it between two steps
  std::exception_ptr refusal;     ///< exception of the last request
  LiveStatus status;
  std::shared_ptr<const Frame> frame;
  LiveHistory history;

  std::jthread solver;  ///< last member: it ends before the data that it uses

  State(const scenario::Scenario& scenario, session::RunOrigin from)
      : session(from.branch ? session::Session(scenario, from.branch->start) : session::Session(scenario)),
        statics(session::run_statics(scenario, session.world())),
        origin(session::with_bed(std::move(from), session)) {
    if (origin.branch) session.record_start();
  }

  void play_to(const Goal& next);
  void submit_request(std::function<void()> next);

  void work(const std::stop_token& stop);
  bool should_step();
  void execute_request();
  void apply(const Command& command);
  void back(const std::string& output);
  io::Segment recorded_until(const HistoryCursor& end) const;
  void record(const std::string& output, bool overwrite);
  void take_step();
  void wait_for_pace(const std::stop_token& stop);
  void keep(const std::function<void()>& store_something);
  void collect_ready();
  void describe();
  void show_frame();
  void show_pause();
  void pack();
  void end();
  void fail(const std::exception& error);
};

// --- requests to the solver, from other threads ---

void LiveRun::State::play_to(const Goal& next) {
  const std::lock_guard lock(mutex);
  if (status.done) return;
  goal = next;
  pause_asked = false;
  status.running = true;
  status.state_hash.clear();
  status.error.clear();
  asked.notify_one();
}

/// Waits until the solver has executed the request between two steps, which takes at most one step. Rethrows
/// its exceptions.
void LiveRun::State::submit_request(std::function<void()> next) {
  std::unique_lock lock(mutex);
  request = std::move(next);
  asked.notify_one();
  answered.wait(lock, [this] { return !request; });
  if (refusal) std::rethrow_exception(std::exchange(refusal, nullptr));
}

// --- the solver's thread ---

void LiveRun::State::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    execute_request();
    if (should_step()) {
      take_step();
      wait_for_pace(stop);
      continue;
    }
    show_pause();
    pack();
    std::unique_lock lock(mutex);
    asked.wait(lock, stop, [this] { return goal || request; });
    speed_since = Clock::now();
    speed_step = session.world().step;
  }
  end();
}

bool LiveRun::State::should_step() {
  const std::lock_guard lock(mutex);
  if (pause_asked || session.phase() == session::Phase::done || (goal && is_reached(*goal, session)))
    goal.reset();
  pause_asked = false;
  return goal.has_value();
}

/// Executes the pending request.
void LiveRun::State::execute_request() {
  std::unique_lock lock(mutex);
  if (!request) return;
  const std::function<void()> next = request;
  lock.unlock();
  std::exception_ptr refused;
  try {
    next();
  } catch (const std::exception&) {
    refused = std::current_exception();
  }
  show_pause();
  lock.lock();
  refusal = refused;
  request = nullptr;
  answered.notify_one();
}

void LiveRun::State::apply(const Command& command) {
  if (begins(command, session.schedule().drag)) {
    const HistoryCursor now = {history.observables.size(), history.frames.size(), history.commands.size(),
                               steps.size()};  // only this thread changes it
    Mark mark{session.checkpoint(0.0), now};
    session.apply(command);
    if (marks.size() == max_marks) marks.erase(marks.begin());
    marks.push_back(std::move(mark));
  } else {
    session.apply(command);
  }
  collect_ready();
  const std::lock_guard lock(mutex);
  describe();
}

/// Returns everything recorded from the beginning up to that position.
io::Segment LiveRun::State::recorded_until(const HistoryCursor& end) const {
  const auto first = [](const auto& list, std::size_t count) { return std::span(list).first(count); };
  io::Segment segment;
  for (const auto& one : first(history.frames, end.frames)) segment.frames.push_back(*one);
  for (const auto& row : first(history.observables, end.observables)) segment.observables.push_back(row);
  for (const Command& command : first(history.commands, end.commands)) segment.commands.push_back(command);
  for (const StepRow& row : first(steps, end.steps)) segment.steps.push_back(row);
  return segment;
}

void LiveRun::State::back(const std::string& output) {
  if (marks.empty()) throw Error(ExitCode::usage, "there is no command to undo");
  Mark& mark = marks.back();
  session::Session before(session.scenario(), mark.state, "the state before the command");
  before.use_threads(origin.threads);
  io::Segment segment = recorded_until(mark.history);
  const HistoryCursor whole = {segment.observables.size(), segment.frames.size(), segment.commands.size(),
                               segment.steps.size()};
  if (is_recorded) {
    io::RunStore next = io::RunStore::create(output, session::run_header(before, origin), false);
    end();
    store.emplace(std::move(next));
    recorder.emplace(session, *store);
  }
  before.restore_segment(std::move(segment));
  session = std::move(before);
  cursor = whole;
  steps.resize(whole.steps);
  {
    const std::lock_guard lock(mutex);
    goal.reset();
    status.error.clear();
    history.frames.resize(whole.frames);
    history.observables.resize(whole.observables);
    history.commands.resize(whole.commands);
    history.steps.clear();
    history.stride = 1;
    add_steps(steps, history);
  }
  marks.pop_back();
  if (recorder) keep([this] { recorder->commit(); });
}

/// Records everything that the session has done since its beginning, and what follows.
void LiveRun::State::record(const std::string& output, bool overwrite) {
  store = io::RunStore::create(output, session::run_header(session, origin), overwrite);
  recorder.emplace(session, *store);
  is_recorded = true;
}

void LiveRun::State::take_step() {
  bool failed = false;
  try {
    session.advance();
  } catch (const std::exception& error) {
    failed = true;
    fail(error);
  }
  collect_ready();
  keep([this, failed] {
    if (!recorder) return;
    if (failed)
      recorder->commit();  // the state before the failure is complete
    else
      recorder->commit_if_due();
  });
  {
    const std::lock_guard lock(mutex);
    describe();
  }
  if (Clock::now() >= show_at) show_frame();
}

/// Waits until the next step is due or a request arrives.
void LiveRun::State::wait_for_pace(const std::stop_token& stop) {
  std::unique_lock lock(mutex);
  const bool tilts = status.tilt_rate != 0.0 && !status.depositing;
  const double seconds = pace.tilt > 0.0 && tilts ? pace.tilt / std::abs(status.tilt_rate) : pace.seconds;
  if (!(seconds > 0.0)) return;
  const std::chrono::duration<double> step(scenario::time_step(session.scenario()) / seconds);
  // Lost time is not made up, so that the run does not rush after a slow step.
  due = std::max(due + std::chrono::duration_cast<Clock::duration>(step), Clock::now());
  asked.wait_until(lock, stop, due, [this] { return pause_asked || request; });
}

/// Performs an action that empties the segment unless it fails.
void LiveRun::State::keep(const std::function<void()>& store_something) {
  try {
    store_something();
  } catch (const std::exception& error) {
    fail(error);
  }
  if (session.segment().steps.empty() && session.segment().commands.empty()) cursor = {};
}

/// Copies new entries of the segment to the history.
void LiveRun::State::collect_ready() {
  const io::Segment& segment = session.segment();
  std::vector<std::shared_ptr<const Frame>> frames;
  for (std::size_t k = cursor.frames; k < segment.frames.size(); ++k)
    frames.push_back(std::make_shared<const Frame>(segment.frames[k]));
  const std::lock_guard lock(mutex);
  const auto append = [](auto& to, const auto& from, std::size_t first) {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first), from.end());
  };
  append(history.frames, frames, 0);
  append(history.observables, segment.observables, cursor.observables);
  append(history.commands, segment.commands, cursor.commands);
  append(steps, segment.steps, cursor.steps);
  add_steps(std::span(segment.steps).subspan(cursor.steps), history);
  cursor = {segment.observables.size(), segment.frames.size(), segment.commands.size(), segment.steps.size()};
}

/// Updates the status from the session; requires the mutex.
void LiveRun::State::describe() {
  const World& world = session.world();
  status.step = world.step;
  status.time = world.time;
  status.tilt = world.tilt;
  status.depositing = session.phase() == session::Phase::deposition;
  status.done = session.phase() == session::Phase::done;
  status.theta_c = session.angle_of_repose();
  status.tilt_rate = degrees(session.tilt_rate());
  status.friction = session.law().friction;
  status.dragged.reset();
  if (session.schedule().drag) status.dragged = session.schedule().drag->grain;
  status.commands_given = marks.size();
  const std::chrono::duration<double> elapsed = Clock::now() - speed_since;
  if (elapsed < speed_interval) return;
  status.steps_per_second = static_cast<double>(world.step - speed_step) / elapsed.count();
  speed_since = Clock::now();
  speed_step = world.step;
}

void LiveRun::State::show_frame() {
  auto next = std::make_shared<const Frame>(session.frame());
  // A delay of one step is made up by the next.
  const auto interval = std::chrono::duration_cast<Clock::duration>(frame_interval);
  show_at = std::max(show_at + interval, Clock::now());
  const std::lock_guard lock(mutex);
  frame = std::move(next);
}

/// Shows the frame and, if nothing more is to run, the paused status with its state hash.
void LiveRun::State::show_pause() {
  show_frame();
  const std::string hash = hash_text(state_hash(session.world()));
  const std::lock_guard lock(mutex);
  describe();
  status.running = goal.has_value();
  if (status.running) return;
  status.state_hash = hash;
  status.steps_per_second = 0.0;
}

/// Packs a finished run.
void LiveRun::State::pack() {
  if (!store || session.phase() != session::Phase::done) return;
  keep([this] {
    if (cursor.steps > 0 || cursor.commands > 0) recorder->commit();
    store->pack();
    recorder.reset();
    store.reset();
  });
}

void LiveRun::State::end() {
  const io::Segment& segment = session.segment();
  if (recorder && !(segment.steps.empty() && segment.commands.empty())) keep([this] { recorder->commit(); });
  pack();
}

void LiveRun::State::fail(const std::exception& error) {
  const std::lock_guard lock(mutex);
  status.error = error.what();
  std::ranges::replace(status.error, '\n', ' ');
  const auto* known = dynamic_cast<const Error*>(&error);
  status.error_code = known ? known->code() : ExitCode::internal;
  goal.reset();
}

// --- the interface ---

LiveRun::LiveRun(const scenario::Scenario& scenario, const std::string& scenario_text,
                 const std::string& output, bool overwrite, const std::string& command_line,
                 const std::optional<io::BranchOrigin>& branch)
    : state_(std::make_unique<State>(
          scenario, session::RunOrigin{scenario_text, {}, command_line, solver_threads(), branch})) {
  state_->session.use_threads(state_->origin.threads);
  state_->collect_ready();
  if (!output.empty()) state_->record(output, overwrite);
  state_->show_pause();
  state_->solver = std::jthread([state = state_.get()](const std::stop_token& stop) { state->work(stop); });
}

LiveRun::~LiveRun() = default;

void LiveRun::play() { state_->play_to({}); }

void LiveRun::pause() {
  const std::lock_guard lock(state_->mutex);
  state_->pause_asked = true;
  state_->asked.notify_one();
}

void LiveRun::set_pace(const LivePace& pace) {
  const std::lock_guard lock(state_->mutex);
  state_->pace = pace;
}

void LiveRun::step(std::int64_t count) { state_->play_to({.step = status().step + count}); }

void LiveRun::run_to(double tilt) {
  state_->submit_request([state = state_.get(), tilt] {
    state->play_to({.tilt = aim(tilt, state->session, std::bind_front(&State::apply, state))});
  });
}

void LiveRun::finish_deposition() { state_->play_to({.end_of_deposition = true}); }

void LiveRun::halt() {
  state_->submit_request([state = state_.get()] {
    {
      const std::lock_guard lock(state->mutex);
      state->goal.reset();
    }
    state->pack();
  });
}

void LiveRun::apply(Command command) {
  state_->submit_request([state = state_.get(), command] { state->apply(command); });
}

void LiveRun::back(const std::string& output) {
  state_->submit_request([state = state_.get(), &output] { state->back(output); });
}

void LiveRun::record(const std::string& output, bool overwrite) {
  state_->submit_request([state = state_.get(), &output, overwrite] {
    if (state->is_recorded) throw Error(ExitCode::usage, "this run is already being recorded");
    state->record(output, overwrite);
    state->keep([state] { state->recorder->commit(); });
    state->pack();
  });
}

void LiveRun::save() {
  state_->submit_request([state = state_.get()] {
    if (state->recorder) state->keep([state] { state->recorder->commit(); });
  });
}

const RunStatics& LiveRun::statics() const { return state_->statics; }

LiveStatus LiveRun::status() const {
  const std::lock_guard lock(state_->mutex);
  return state_->status;
}

std::shared_ptr<const Frame> LiveRun::frame() const {
  const std::lock_guard lock(state_->mutex);
  return state_->frame;
}

std::vector<ObservableRow> LiveRun::observables(std::size_t from) const {
  const std::lock_guard lock(state_->mutex);
  return since(state_->history.observables, from);
}

std::vector<std::shared_ptr<const Frame>> LiveRun::recorded_frames(std::size_t from) const {
  const std::lock_guard lock(state_->mutex);
  return since(state_->history.frames, from);
}

std::vector<StepRow> LiveRun::steps(std::size_t from) const {
  const std::lock_guard lock(state_->mutex);
  return since(state_->history.steps, from);
}

std::vector<Command> LiveRun::commands() const {
  const std::lock_guard lock(state_->mutex);
  return state_->history.commands;
}

}  // namespace talus::view
