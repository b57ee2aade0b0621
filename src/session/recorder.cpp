#include "session/recorder.h"

#include "base/errors.h"

namespace talus::session {

void Recorder::advance() {
  try {
    session_->advance();
  } catch (const Error&) {
    commit();
    throw;
  }
}

void Recorder::commit(const std::vector<TrialRow>& trials) {
  io::Segment segment = session_->segment();
  segment.trials = trials;
  store_->commit(segment, session_->checkpoint(store_->seconds_writing()));
  session_->clear_segment();
  last_ = Clock::now();
}

void Recorder::commit_if_due() {
  const std::chrono::duration<double> since = Clock::now() - last_;
  if (since.count() >= session_->scenario().output.checkpoint_every || !session_->segment().frames.empty())
    commit();
}

}  // namespace talus::session
