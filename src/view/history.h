#pragma once
/// History of a contact, read from all frames of a run in the background of the view.

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

/// One frame of the history.
struct HistoryInstant {
  double time = 0.0;          ///< s
  double tilt = 0.0;          ///< rad
  double fn = 0.0, ft = 0.0;  ///< N per metre of thickness; 0 if the contact is open
  ContactStatus status = ContactStatus::open;
  double friction = not_known;  ///< mu of the contact, if it carries force
};

HistoryInstant instant_of(const Frame& frame, const ContactKey& contact);

/// Reads in its own thread. All members must be called from one other thread.
class HistorySeries {
 public:
  explicit HistorySeries(ReadFrame read);
  /// Finishes the frame in progress.
  ~HistorySeries() = default;
  HistorySeries(const HistorySeries&) = delete;
  HistorySeries& operator=(const HistorySeries&) = delete;

  /// Requests the history of a contact over `frames` frames: from the first frame if it is another contact,
  /// else only the frames not yet read.
  void set_contact(const ContactKey& contact, std::size_t frames);
  /// Collects what has been read; returns whether there was anything.
  bool collect_ready();

  /// Returns the instants read so far, of the first frames. A frame that cannot be read ends them.
  const std::vector<HistoryInstant>& instants() const { return instants_; }

 private:
  struct SharedState {
    std::mutex mutex;
    std::condition_variable_any changed;
    int turn = 0;  ///< number of contacts requested
    ContactKey contact;
    std::size_t frames = 0;
    std::vector<HistoryInstant> ready;
  };

  void work(const std::stop_token& stop);

  ReadFrame read_;
  ContactKey contact_;
  std::vector<HistoryInstant> instants_;
  SharedState shared_;
  std::jthread thread_;  ///< last member: it is joined before the others are destroyed
};

/// Returns two plots along the run: "contact forces", in units of the weight `weight` (N/m), and
/// "mobilisation", which is 1 while the contact slides. An open contact has no mobilisation.
std::vector<Plot> contact_plots(std::span<const HistoryInstant> instants, double weight,
                                const PlotAbscissa& abscissa);

}  // namespace talus::view
