#pragma once
/// What a Simulation holds.

#include <sys/types.h>

#include <memory>
#include <optional>

#include "library/measured_frame.h"
#include "library/simulation.h"
#include "session/recorder.h"
#include "session/run_header.h"
#include "session/session.h"

namespace talus {

struct Simulation::State {
  session::Session session;
  RunStatics statics;
  session::RunOrigin origin;
  std::optional<io::RunStore> store;
  std::optional<session::Recorder> recorder;
  std::function<bool()> interrupts;
  analysis::AnalysisParameters parameters;
  bool is_new = true;            ///< neither stepped nor changed
  std::optional<Frame> begin{};  ///< as the tilt began, where that was seen

  std::optional<MeasuredFrame> measured{};  ///< of the state after the last step, once it was asked for

  pid_t process;  ///< that made it: in a child of fork it can only be looked at and copied

  explicit State(session::Session from);
  bool is_own() const;
  /// Throws Error(usage) in a child of fork.
  void require_own() const;

  /// Steps once, and records it.
  void advance();
  /// Makes durable what was recorded, and packs the run once it is over.
  void commit();
  MeasuredFrame& measure();
};

}  // namespace talus
