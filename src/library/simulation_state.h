#pragma once
/// State of a Simulation.

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

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

}  // namespace talus
