#pragma once
/// What single grains and a contact went through: read from all frames of a run, while the view is used.

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/snapshot.h"
#include "view/frame_source.h"
#include "view/plots.h"
#include "view/selection.h"

namespace talus::view {

/// A grain in a frame.
struct GrainPlace {
  double x = 0.0, y = 0.0;  ///< m; NaN where it has not arrived yet
  Index image = 0;          ///< how often it left through the right periodic edge
};

/// One frame.
struct HistoryInstant {
  std::int64_t step = 0;
  double time = 0.0;               ///< s
  double tilt = 0.0;               ///< rad
  std::vector<GrainPlace> places;  ///< of the grains asked for, in their order
  double fn = not_known,
         ft = not_known;  ///< N per metre of thickness; NaN without a contact, 0 where it is open
  ContactStatus status = ContactStatus::open;
  bool with_wall = false;  ///< where it carries force
};

HistoryInstant instant_of(const Frame& frame, const Selection& question);

/// Reads in a thread of its own. All members are for one other thread.
class HistorySeries {
 public:
  explicit HistorySeries(ReadFrame read);
  /// Finishes the frame under way.
  ~HistorySeries() = default;
  HistorySeries(const HistorySeries&) = delete;
  HistorySeries& operator=(const HistorySeries&) = delete;

  /// From the first of `frames` frames on, where the question is another one; else only those to come.
  void ask(const Selection& question, std::size_t frames);
  /// Takes in what has been read; true where there was something.
  bool take_in();

  const Selection& question() const { return question_; }
  /// Of the first frames, as far as they have been read. A frame that cannot be read ends them.
  const std::vector<HistoryInstant>& instants() const { return instants_; }

 private:
  struct Shared {
    std::mutex mutex;
    std::condition_variable_any changed;
    int turn = 0;  ///< counts the questions
    Selection question;
    std::size_t frames = 0;
    std::vector<HistoryInstant> ready;
  };

  void work(const std::stop_token& stop);

  ReadFrame read_;
  Selection question_;
  std::vector<HistoryInstant> instants_;
  Shared shared_;
  std::jthread thread_;  ///< the last: it is joined before the rest goes
};

/// "contact forces", over the weight `weight` (N/m), and "mobilisation", with 1, where it slides: along the
/// run. `friction` of each instant. An open contact has no mobilisation.
std::vector<Plot> contact_plots(std::span<const HistoryInstant> instants, std::span<const double> friction,
                                double weight, const PlotAbscissa& abscissa);

}  // namespace talus::view
