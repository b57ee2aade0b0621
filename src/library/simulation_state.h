#pragma once
/// What a Simulation holds.

#include <memory>
#include <optional>

#include "library/measured_frame.h"
#include "library/simulation.h"
#include "session/recorder.h"
#include "session/run_header.h"
#include "session/session.h"

namespace talus {

struct Simulation::State {
  Session session;
  RunStatics statics;
  RunOrigin origin;
  std::optional<RunStore> store;
  std::optional<Recorder> recorder;
  std::function<bool()> interrupts;
  AnalysisParameters parameters;
  bool is_new = true;            ///< neither stepped nor changed
  std::optional<Frame> begin{};  ///< as the tilt began, where that was seen

  std::optional<MeasuredFrame> measured{};  ///< of the state after the last step, once it was asked for

  explicit State(Session from)
      : session(std::move(from)), statics(run_statics(session.scenario(), session.world())) {}

  /// Steps once, and records it.
  void advance();
  MeasuredFrame& measure();
};

}  // namespace talus
