#pragma once
/// The interactive view without its widgets: a run file that is replayed or a run that is computed, the frame
/// shown, the properties of the selected grain, and the curves next to its maps. It provides two views.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/frame_view.h"
#include "view/frame_ahead.h"
#include "view/frame_series.h"
#include "view/frame_source.h"
#include "view/history.h"
#include "view/inspection.h"
#include "view/live_run.h"
#include "view/plots.h"
#include "view/scene.h"
#include "view/timeline.h"
#include "view/view_state.h"

namespace talus::view {

/// Origin of a live run, and where it is recorded.
struct Recording {
  std::string scenario;  ///< empty for a branch, whose scenario is in its file
  std::vector<std::string> settings;
  std::string output;  ///< empty: not recorded
  std::uint64_t seed = 0;
};

/// Parent run of a branch, for the time line.
struct BranchLine {
  std::string run;
  std::size_t frame = 0;      ///< frame of the parent at which the branch begins
  std::vector<double> tilts;  ///< rad, one per frame of the parent
};

/// A map, and the data from which it was made.
struct MapCache {
  MapSource source;
  bool dark = false;  ///< drawn with on_dark_ground
  render::FrameView view;
  std::optional<GrainValues> values;  ///< values of its grains, once requested
};

class ViewModel;

/// One of the two views: a map of the run, valid until either is changed. The second view shows another map.
struct View {
  ViewModel& run;
  const ViewState& state;  ///< state with the map of this view
  MapCache& cache;
  bool second = false;

  /// Returns the map of the frame shown for a picture of that aspect (width / height), with the selection,
  /// the growing neighbourhoods and the highlighted cluster drawn into it. Legends and titles are left to
  /// widgets.
  render::FrameView map(double aspect) const;
  /// Returns title, caption and legends of the map requested last; recomputed only if something has changed.
  const render::FrameView& annotated_map() const;
  /// Returns the map on white in any theme, with legends, title and caption, cropped to the bed, in the
  /// aspect that map() was last called with. A map that cannot be drawn has the reason as its title.
  render::FrameView furnished_map() const;
  /// Returns the values that the map assigns to the free grains, computed at the first request for a frame.
  const GrainValues& values() const;
  /// Returns the part of the bed that map(aspect) shows, m.
  pictures::MapExtent part(double aspect) const;
  /// Returns the aspect (width / height) of a picture that just holds the entire bed as it is shown, turned
  /// or not.
  double bed_aspect() const;
  /// Returns the settings of the map, completed by the run.
  pictures::MapSettings settings() const;
  /// Returns the angle (rad) from which motions are measured, if the frame shown comes after it.
  std::optional<double> since() const;
  /// Returns the frame from which motions are measured; null if there is none.
  std::shared_ptr<const Frame> reference() const;

 private:
  const render::FrameView& whole_map(const pictures::MapExtent& shown) const;
  render::FrameView picture(const pictures::MapExtent& shown) const;
};

class ViewModel {
 public:
  /// Opens a run file (replay) or a scenario (live), depending on the content of the file. If `output` is
  /// empty, a live run is not recorded. Throws the errors of opening.
  static ViewModel open(const std::string& path, const std::vector<std::string>& settings,
                        const std::string& output, bool overwrite, const std::string& command_line);

  ViewState state;  ///< changed by the caller

  View first() { return {*this, state, map_, false}; }
  /// Returns the second view, as state.second_view requests it.
  View second();

  bool is_live() const { return live_ != nullptr; }
  const std::string& path() const { return pictures_.path; }
  LiveRun* live() const { return live_.get(); }  ///< null in a replay
  std::uint64_t seed() const { return pictures_.run.seed; }
  /// Restarts a live run from its scenario, with this seed and without the commands. If the current run is
  /// recorded, so is the new one, in a file next to it: "slope-2.h5" after "slope.h5". Throws as LiveRun
  /// does; the current run then continues to exist.
  void restart(std::uint64_t seed);
  /// Continues a replay from the frame shown, as a live run that is not recorded. Resetting a branch returns
  /// to that frame, whatever the seed. Does nothing in a live run. Throws as checkpoint_at_frame does; the
  /// replay then continues to exist.
  void branch();
  std::optional<BranchLine> branch_line() const;  ///< set if the live run is a branch
  /// Returns a live run to the state before its last command, paused; a recorded run is continued in a file
  /// next to it. Throws as LiveRun::back does.
  void back();
  /// Starts to record a live run that is not recorded, from its beginning. Throws as LiveRun::record does.
  void record(const std::string& output);
  Recording recording() const;
  /// Returns whether the content may be discarded; an unsaved live run only at the second request.
  bool may_discard();
  /// Stops all background reading and writing until the next update(), because HDF5 is not thread-safe. Must
  /// be called before another run is opened.
  void hold();

  // Frames: in a replay, all frames of the file; in a live run, those recorded so far.
  std::size_t frame_count() const { return frames_->count(); }
  std::size_t frame_index() const;  ///< for a live run that is followed, the count
  const std::vector<double>& frame_tilts() const { return frames_->instants().tilts; }
  /// Returns whether the tilt follows a programme, in which it may fall and be held.
  bool goes_by_time() const { return pictures_.goes_by_time; }
  std::span<const TimelineEvent> events() const { return events_; }
  /// Goes to a frame. A live run continues to compute while the frame is shown, until it is followed again.
  /// Does nothing if there is no frame yet.
  void go_to(std::size_t frame);
  bool shows_recorded_frame() const {
    return held_.has_value();
  }  ///< whether a live run shows a recorded frame
  void follow();
  /// Returns the frame nearest to an angle in degrees, or "repose"; throws as frames_at does, and
  /// Error(usage) for a live run.
  std::size_t frame_at_angle(const std::string& angle) const;
  void go_to(Landmark landmark);  ///< does nothing if the run has no such place
  bool has(Landmark landmark) const { return place_of(landmark).has_value(); }
  bool playing() const { return replay_ && replay_->playing(); }
  void play(bool on);  ///< starts again from the beginning if it is at the end
  void set_speed(double degrees_per_second);
  double speed() const { return replay_ ? replay_->speed() : 0.0; }

  /// Updates the view; call once per picture. Fetches the newest frame of a live run, advances a playing
  /// replay by `seconds`, collects the results of background work, and returns the camera to the bed. Errors,
  /// such as an unreadable frame, are reported in state.message. Returns whether the content has changed.
  bool update(double seconds);

  /// Returns the statics of the frame shown: while a bed is poured, of the grains that have arrived.
  const RunStatics& statics() const { return pictures_.run.statics; }
  const Frame& frame() const { return *frame_; }
  BedFrame bed() const { return {frame(), statics()}; }
  double theta_c()
      const;  ///< rad; scales the maps: that of the run, or an assumed one (20 deg) while it is unknown
  bool theta_c_known() const { return theta_c_.has_value(); }
  double mean_diameter() const { return statics().mean_diameter; }

  /// Moves the camera, limited to the bed and to a few grains. Returns false if the part of the bed shown
  /// does not change.
  bool set_camera(const ViewCamera& camera);
  /// Zooms by a factor about a point (m), which keeps its position in the picture. Returns as set_camera().
  bool zoom(double factor, double x, double y);

  // Selection: state.selected is the inspected grain, state.selecting the rest of the selection.
  /// Selects one grain, or none, and nothing else.
  void select(std::optional<Index> grain);
  /// Selects these grains, sorted by id; a single one as above. The inspected grain stays if it is among
  /// them.
  void select(std::vector<Index> grains);
  void select(const ContactKey& contact);
  /// Returns all selected grains that exist in the frame shown, sorted by id.
  std::vector<Index> selected_grains() const;
  /// Calls find_contact for the frame shown.
  std::optional<ContactKey> contact_at(double x, double y, double reach) const;

  /// Returns the properties of the selected contact in the frame shown; nothing if none is selected.
  std::optional<ContactInspection> contact_inspection() const;
  /// Returns its contact_plots, over the axis of all plots; frames are added as they are read.
  std::vector<Plot> contact_history() const;
  /// Returns the properties of state.selected in the frame shown; null if nothing is selected. Computed once
  /// for a frame and a selection.
  const Inspection* inspection() { return inspect_selected(first()); }
  /// Returns the plots in display order; values computed in the background are added later.
  std::span<const Plot> plots() const { return plots_; }
  /// Returns the quantities of the table that have a value in each frame of this run, with or without a
  /// threshold, and no added plot yet: all if the run has a stored analysis, else those of its rows and of
  /// overload.
  std::vector<const analysis::Quantity*> more_quantities() const;
  /// Adds a plot of one of these at the end of plots(), or removes it by name.
  void add_plot(const analysis::Quantity& quantity);
  void remove_plot(const std::string& name);
  /// Abscissa of all plots along the run; the angle left requires that theta_c is known. Changing the axis
  /// resets zoom and chosen range; an axis that the run does not have is ignored.
  PlotAxis plot_axis() const { return axis_; }
  bool has_plot_axis(PlotAxis axis) const { return axis != PlotAxis::angle_left || theta_c_known(); }
  void set_plot_axis(PlotAxis axis);
  /// Returns the places on that axis of the frame shown, theta_c and rearrangements.
  PlotMarks plot_marks() const;
  /// Goes to the frame nearest to a place on that axis (deg or s).
  void go_to_place(double x);

  /// Returns "talus render RUN --map ... --at 12.25 ...", which draws the picture shown. Empty for a live run
  /// that is not recorded.
  std::string render_command();

 private:
  friend struct View;

  ViewModel() = default;

  // view_run.cpp: the run, and its progress.
  void open_replay();
  /// Begins the run of scenario_ and shows it instead of the current one.
  void start_live(const std::string& output, bool overwrite);
  /// Collects everything that a live run has recorded since its beginning.
  void take_all_recorded();
  void begin_series();
  /// Stops all background reading.
  void end_series();
  /// Returns frame k of the available frames; null, with the reason in error_, if it cannot be read.
  std::shared_ptr<const Frame> frame_at(std::size_t k);
  /// Shows the current frame of a replay. If it cannot be read, the previous one stays, and playback stops.
  void show_replayed();
  /// Shows another frame; `mapped` if it is already known.
  void show(std::shared_ptr<const Frame> next, std::shared_ptr<const Frame> mapped = nullptr);
  /// Computes frame_ unless `mapped` is given.
  void make_frame(std::shared_ptr<const Frame> mapped = nullptr);
  /// Collects the results of a live run; returns whether its frame has changed.
  bool poll_live_run();
  /// Shows a recorded frame of a live run, or follows the run again.
  void hold_at(std::optional<std::size_t> frame);
  /// Returns the report on a live run that has just failed or ended; else empty.
  std::string take_end();
  bool is_falling() const;
  pictures::MapExtent live_extent() const;
  /// Restarts the series of frames if `rule` has changed, and collects its results; returns whether anything
  /// has changed.
  bool follow_frames(const pictures::OverloadRule& rule);

  // view_events.cpp: its events.
  void find_events();
  std::optional<std::size_t> place_of(Landmark landmark) const;

  // view_plots.cpp: recompute its curves, from its records and from its frames.
  void plot_rows();
  void plot_values();
  void note_thresholds(const pictures::OverloadRule& rule);
  PlotAbscissa abscissa() const { return {axis_, theta_c_.value_or(not_known)}; }

  // view_shown.cpp: results for the frame shown.
  const analysis::Clusters& shown_clusters(const pictures::MapSettings& settings);
  const Inspection* inspect_selected(const View& view);
  /// Returns the mapped frame at a tilt (rad); null if there is none.
  std::shared_ptr<const Frame> reference_at(double tilt);

  // view_selection.cpp
  /// Returns the marks of the selection in the frame shown, without the inspected grain.
  Overlay selection_marks() const;
  /// Reads the history of the selected contact; returns whether any of it has arrived.
  bool follow_history();
  /// Moves the camera to the inspected grain, if requested.
  void follow_grain();

  // The tilts and times of the frames of the tilt.
  std::vector<double> tilts_of_tilt() const;
  std::vector<double> times_of_tilt() const;

  /// Pictures of the run, with the current map and part of the bed.
  pictures::PictureSeries pictures_;
  RunStatics all_statics_;
  std::shared_ptr<FrameSource> frames_ = std::make_shared<RecordedFrames>();
  std::shared_ptr<const Frame> stored_;     ///< the frame shown, as it was read or computed
  std::shared_ptr<const Frame> frame_;      ///< the same with the gamma of neighbourhoods of l_min_
  double l_min_ = analysis::default_l_min;  ///< D
  std::optional<double> theta_c_;           ///< rad
  pictures::MapExtent bed_;                 ///< over the frames known so far
  std::vector<ObservableRow> rows_;
  std::vector<Plot> plots_ = empty_plots();
  PlotAxis axis_ = PlotAxis::tilt;  ///< abscissa of the plots along the run
  std::string error_;               ///< error since the last update

  ViewState second_state_;  ///< state of the second view, when last requested

  // Members of a replay.
  std::shared_ptr<RunFrames> run_file_;
  std::optional<Replay> replay_;
  std::unique_ptr<FrameAhead> ahead_;
  std::size_t shown_before_ = 0;  ///< previous frame, which gives the direction of playback
  std::optional<analysis::Analysis> analysis_;

  // Members of a live run.
  scenario::Scenario scenario_;
  std::vector<std::string> scenario_settings_;
  std::string scenario_text_, command_line_;
  std::string first_output_, output_;  ///< first requested output, and that of this run; empty: not recorded
  std::optional<io::BranchOrigin> origin_;  ///< origin, if the run is a branch
  std::vector<double> parent_tilts_;        ///< rad, one per frame of the parent run
  std::optional<double> parent_theta_c_;    ///< rad; assumed for the branch until it fails
  std::unique_ptr<LiveRun> live_;
  std::shared_ptr<RecordedFrames> recorded_;
  std::shared_ptr<const Frame> newest_;  ///< current state of the run
  std::optional<std::size_t> held_;      ///< recorded frame that is shown instead
  bool ended_ = false;                   ///< whether the end has been reported

  std::vector<Command> commands_;
  std::vector<ObservableRow> file_rows_;  ///< for a replay with commands: rows_up_to the end of the run
  std::vector<TimelineEvent> events_;

  std::unique_ptr<FrameSeries> series_;
  std::unique_ptr<HistorySeries> history_;  ///< null if nothing is requested

  // Results for the frame shown, with the data from which they were computed.
  struct {
    std::shared_ptr<const Frame> frame;
    pictures::OverloadRule rule;
    analysis::Clusters clusters;
  } clusters_;
  struct {
    std::shared_ptr<const Frame> frame;
    pictures::OverloadRule rule;
    double neighbourhood = 0.0;
    Inspection result;
  } inspection_;
  struct {
    std::shared_ptr<const Frame> stored, mapped;
    double l_min = 0.0;
  } reference_;  ///< frame that is subtracted from the frame shown
  MapCache map_, second_map_;
  double aspect_ = 0.0;  ///< aspect of the picture requested last; 0: none
};

}  // namespace talus::view
