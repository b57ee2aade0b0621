#include "view/live_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <functional>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

#include "base/errors.h"
#include "base/hash.h"
#include "core/trigonometry.h"
#include "session/measure.h"
#include "session/run.h"
#include "session/run_header.h"

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

/// Position up to which the history has copied the records of the session.
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

/// Session and store belong to the solver's thread once it runs; the mutex protects the rest.
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
  // Recorded since the beginning; changed by the solver's thread alone.
  std::vector<ObservableRow> observables;
  std::vector<std::shared_ptr<const Frame>> frames;
  std::vector<Command> commands;

  std::jthread solver;  ///< last member: it ends before the data that it uses

  State(const scenario::Scenario& scenario, session::RunOrigin from)
      : session(from.branch ? session::Session(scenario, from.branch->start) : session::Session(scenario)),
        statics(session::run_statics(scenario, session.world())),
        origin(session::with_bed(std::move(from), session)) {
    if (origin.branch) session.record_start();
  }

  // --- requests to the solver, from other threads ---

  /// Returns a copy of a member that both threads use.
  template <typename Value>
  Value copy(Value State::*member) const {
    const std::lock_guard lock(mutex);
    return this->*member;
  }

  void play_to(const Goal& next) {
    const std::lock_guard lock(mutex);
    if (status.done) return;
    goal = next;
    pause_asked = false;
    status.running = true;
    status.state_hash.clear();
    status.error.clear();
    asked.notify_one();
  }

  /// Waits until the solver has executed the request between two steps. Rethrows its exceptions.
  void submit_request(std::function<void()> next) {
    std::unique_lock lock(mutex);
    request = std::move(next);
    asked.notify_one();
    answered.wait(lock, [this] { return !request; });
    if (refusal) std::rethrow_exception(std::exchange(refusal, nullptr));
  }

  // --- the solver's thread ---

  void work(const std::stop_token& stop) {
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

  bool should_step() {
    const std::lock_guard lock(mutex);
    if (pause_asked || session.phase() == session::Phase::done || (goal && is_reached(*goal, session)))
      goal.reset();
    pause_asked = false;
    return goal.has_value();
  }

  void execute_request() {
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

  void apply(const Command& command) {
    if (begins(command, session.schedule().drag)) {
      Mark mark{session.checkpoint(0.0), {observables.size(), frames.size(), commands.size(), steps.size()}};
      session.apply(command);
      if (marks.size() == max_marks) marks.erase(marks.begin());
      marks.push_back(std::move(mark));
    } else {
      session.apply(command);
    }
    collect_ready();
    describe();
  }

  /// Returns everything recorded from the beginning up to that position.
  io::Segment recorded_until(const HistoryCursor& end) const {
    io::Segment segment;
    for (std::size_t k = 0; k < end.frames; ++k) segment.frames.push_back(*frames[k]);
    const auto first = [](const auto& all, std::size_t count) {
      return std::vector(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
    };
    segment.observables = first(observables, end.observables);
    segment.commands = first(commands, end.commands);
    segment.steps = first(steps, end.steps);
    return segment;
  }

  void back(const std::string& output) {
    if (marks.empty()) throw Error(ExitCode::usage, "there is no command to undo");
    Mark& mark = marks.back();
    session::Session before(session.scenario(), mark.state, "the state before the command");
    before.use_threads(origin.threads);
    io::Segment segment = recorded_until(mark.history);
    const HistoryCursor whole = mark.history;
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
      frames.resize(whole.frames);
      observables.resize(whole.observables);
      commands.resize(whole.commands);
    }
    marks.pop_back();
    if (recorder) keep([this] { recorder->commit(); });
  }

  /// Records everything that the session has done since its beginning, and what follows.
  void record(const std::string& output, bool overwrite) {
    store = io::RunStore::create(output, session::run_header(session, origin), overwrite);
    recorder.emplace(session, *store);
    is_recorded = true;
  }

  void take_step() {
    bool failed = false;
    try {
      session.advance();
    } catch (const std::exception& error) {
      failed = true;
      fail(error);
    }
    collect_ready();
    keep([this, failed] {
      if (recorder)  // the state before a failure is complete
        failed ? recorder->commit() : recorder->commit_if_due();
    });
    describe();
    if (Clock::now() >= show_at) show_frame();
  }

  /// Waits until the next step is due or a request arrives.
  void wait_for_pace(const std::stop_token& stop) {
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
  void keep(const std::function<void()>& store_something) {
    try {
      store_something();
    } catch (const std::exception& error) {
      fail(error);
    }
    if (session.segment().steps.empty() && session.segment().commands.empty()) cursor = {};
  }

  /// Copies new entries of the segment to those recorded since the beginning.
  void collect_ready() {
    const io::Segment& segment = session.segment();
    std::vector<std::shared_ptr<const Frame>> copies;
    for (std::size_t k = cursor.frames; k < segment.frames.size(); ++k)
      copies.push_back(std::make_shared<const Frame>(segment.frames[k]));
    const std::lock_guard lock(mutex);
    const auto append = [](auto& to, const auto& from, std::size_t first) {
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first), from.end());
    };
    append(frames, copies, 0);
    append(observables, segment.observables, cursor.observables);
    append(commands, segment.commands, cursor.commands);
    append(steps, segment.steps, cursor.steps);
    cursor = {segment.observables.size(), segment.frames.size(), segment.commands.size(),
              segment.steps.size()};
  }

  void describe() {
    const std::lock_guard lock(mutex);
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
    status.solved = {std::ssize(steps), session.schedule().record.unconverged(), {}};
    if (!steps.empty()) status.solved.last = steps.back();
    const std::chrono::duration<double> elapsed = Clock::now() - speed_since;
    if (elapsed < speed_interval) return;
    status.steps_per_second = static_cast<double>(world.step - speed_step) / elapsed.count();
    speed_since = Clock::now();
    speed_step = world.step;
  }

  void show_frame() {
    auto next = std::make_shared<const Frame>(session.frame());
    // A delay of one step is made up by the next.
    const auto interval = std::chrono::duration_cast<Clock::duration>(frame_interval);
    show_at = std::max(show_at + interval, Clock::now());
    const std::lock_guard lock(mutex);
    frame = std::move(next);
  }

  /// Shows the frame and, if nothing more is to run, the paused status with its state hash.
  void show_pause() {
    show_frame();
    const std::string hash = hash_text(state_hash(session.world()));
    describe();
    const std::lock_guard lock(mutex);
    status.running = goal.has_value();
    if (status.running) return;
    status.state_hash = hash;
    status.steps_per_second = 0.0;
  }

  void pack() {
    if (!store || session.phase() != session::Phase::done) return;
    keep([this] {
      if (cursor.steps > 0 || cursor.commands > 0) recorder->commit();
      store->pack();
      recorder.reset();
      store.reset();
    });
  }

  void end() {
    const io::Segment& segment = session.segment();
    if (recorder && !(segment.steps.empty() && segment.commands.empty()))
      keep([this] { recorder->commit(); });
    pack();
  }

  void fail(const std::exception& error) {
    const std::lock_guard lock(mutex);
    status.error = error.what();
    std::ranges::replace(status.error, '\n', ' ');
    const auto* known = dynamic_cast<const Error*>(&error);
    status.error_code = known ? known->code() : ExitCode::internal;
    goal.reset();
  }
};

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
  take_frames();
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
    std::unique_lock lock(state->mutex);
    state->goal.reset();
    lock.unlock();
    state->pack();
  });
}

void LiveRun::apply(Command command) {
  state_->submit_request([state = state_.get(), command] { state->apply(command); });
}

void LiveRun::back(const std::string& output) {
  state_->submit_request([state = state_.get(), &output] { state->back(output); });
  instants_ = {};
  take_frames();
}

void LiveRun::record(const std::string& output) {
  state_->submit_request([state = state_.get(), &output] {
    if (state->is_recorded) throw Error(ExitCode::usage, "this run is already being recorded");
    state->record(output, false);
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

LiveStatus LiveRun::status() const { return state_->copy(&State::status); }

std::shared_ptr<const Frame> LiveRun::newest() const { return state_->copy(&State::frame); }

std::vector<Command> LiveRun::commands() const { return state_->copy(&State::commands); }

std::vector<ObservableRow> LiveRun::observables(std::size_t from) const {
  const std::lock_guard lock(state_->mutex);
  return {state_->observables.begin() + static_cast<std::ptrdiff_t>(from), state_->observables.end()};
}

std::shared_ptr<const Frame> LiveRun::read(std::size_t k) {
  const std::lock_guard lock(state_->mutex);
  return state_->frames.at(k);
}

void LiveRun::take_frames() {
  const std::lock_guard lock(state_->mutex);
  for (std::size_t& k = instants_.tilt_count; k < state_->frames.size(); ++k) {
    instants_.tilts.push_back(state_->frames[k]->tilt);
    instants_.times.push_back(state_->frames[k]->time);
  }
}

}  // namespace talus::view
