#pragma once
/// View is the window of `talus view` without its widgets. A ViewModel is the run shown, a Replay or a
/// LiveRun, with its frame, its selection and its curves; a View is one of its two maps. Widgets change a
/// ViewState, update() takes it up, and drawing reads the model. Read next: view_state.h, frame_source.h,
/// frame_reader.h.

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/frame_view.h"
#include "view/frame_reader.h"
#include "view/frame_source.h"
#include "view/live_run.h"
#include "view/plots.h"
#include "view/scene.h"
#include "view/selection.h"
#include "view/timeline.h"
#include "view/view_state.h"

namespace talus::view {

/// Origin of a run, and where it is recorded.
struct Recording {
  std::string scenario;  ///< path; empty for a branch, whose scenario is in its file
  std::vector<std::string> settings;
  std::string output;  ///< empty: not recorded
  std::uint64_t seed = 0;
};

/// A map, and the data from which it was made.
struct MapCache {
  MapKey key;
  bool dark = false;  ///< drawn with on_dark_ground
  render::FrameView view;
};

class ViewModel;

/// One of the two views: a map of the run, valid until either is changed. The second view shows another map.
struct View {
  ViewModel& run;
  pictures::MapSettings chosen;  ///< settings of its map, not yet completed by the run
  std::optional<double> minus;   ///< rad: show the frame minus that at this tilt
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
  /// Returns the first bar of that map, with the values of the free grains; null if there is none.
  const render::Bar* bar() const;
  /// Returns the part of the bed that map(aspect) shows, m.
  pictures::MapExtent part(double aspect) const;
  /// Returns the aspect (width / height) of a picture that just holds the bed as it is shown.
  double bed_aspect() const;
  /// Returns the settings of the map, completed by the run.
  pictures::MapSettings settings() const;
  /// Returns the angle (rad) from which motions are measured, if the frame shown comes after it.
  std::optional<double> since() const;
  /// Returns the range that fits the values of a map of motion in the frame shown, that of `talus render`;
  /// nothing for other maps, or if nothing has moved.
  std::optional<pictures::ScaleRange> fitting_range() const;
  /// Returns the properties of state.selected in the frame shown; null if nothing is selected. Computed once.
  const Inspection* inspection() const;

 private:
  /// Returns the frame that is subtracted, or from which motions are measured; null if there is none.
  std::shared_ptr<const Frame> reference() const;
  const analysis::Clusters& clusters() const;
  const render::FrameView& whole_map(const pictures::MapExtent& shown, bool dark) const;
  render::FrameView picture(const pictures::MapExtent& shown, bool dark) const;
};

class ViewModel {
 public:
  /// Opens a run file (replay) or a scenario (live), depending on the content of the file. If `output` is
  /// empty, a live run is not recorded. Throws the errors of opening.
  static ViewModel open(const std::string& path, const std::vector<std::string>& settings,
                        const std::string& output, bool overwrite, const std::string& command_line);

  ViewState state;  ///< changed by the caller

  View first() { return {*this, state.map, std::nullopt, map_, false}; }
  /// Returns the second view, as state.second_view requests it.
  View second();

  bool is_live() const { return live_ != nullptr; }
  const std::string& path() const { return pictures_.path; }
  LiveRun* live() const { return live_.get(); }     ///< null in a replay
  Replay* replay() const { return replay_.get(); }  ///< null in a live run
  /// Restarts a live run from its scenario, with this seed and without the commands. If the current run is
  /// recorded, so is the new one, in a file next to it: "slope-2.h5" after "slope.h5". Throws as LiveRun
  /// does; the current run then continues to exist.
  void restart(std::uint64_t seed);
  /// Continues a replay from the frame shown, as a live run that is not recorded. Resetting a branch returns
  /// to that frame, whatever the seed. Does nothing in a live run. Throws as checkpoint_at_frame does; the
  /// replay then continues to exist.
  void branch();
  const std::optional<io::BranchOrigin>& origin() const { return origin_; }  ///< set if the run is a branch
  /// Returns a live run to the state before its last command, paused; a recorded run is continued in a file
  /// next to it. Throws as LiveRun::back does.
  void back();
  /// Starts to record a live run that is not recorded, from its beginning. Throws as LiveRun::record does.
  void record(const std::string& output);
  const Recording& recording() const { return recording_; }
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
  /// Returns whether a live run shows a recorded frame.
  bool shows_recorded_frame() const { return held_; }
  void follow();
  /// Returns the frame nearest to an angle in degrees, or "repose". Throws for a live run, and as frames_at.
  std::size_t frame_at_angle(const std::string& angle) const;
  void go_to(Landmark landmark);  ///< does nothing if the run has no such place
  std::optional<std::size_t> place_of(Landmark landmark) const;
  /// Starts or stops playback of a replay, from the beginning if it is at the end.
  void play(bool on);

  /// Updates the view; call once per picture. Fetches the newest frame of a live run, advances a playing
  /// replay by `seconds`, collects the results of background work, and returns the camera to the bed. Errors,
  /// such as an unreadable frame, are reported in state.message. Returns whether the content has changed.
  bool update(double seconds);

  /// Returns the statics of the frame shown: while a bed is poured, of the grains that have arrived.
  const RunStatics& statics() const { return pictures_.run.statics; }
  const Frame& frame() const { return *frame_; }
  BedFrame bed() const { return {frame(), statics()}; }
  /// rad; scales the maps: that of the run, or an assumed one (20 deg) while it is unknown
  double theta_c() const;
  bool theta_c_known() const { return theta_c_.has_value(); }
  double mean_diameter() const { return statics().mean_diameter; }
  /// Returns the steps of the run up to the frame shown.
  SolvedSteps solved_steps() const;

  /// Moves the camera, limited to the bed and to a few grains. Returns whether the part shown changes.
  bool set_camera(const ViewCamera& camera);
  /// Zooms by a factor about a point (m), which keeps its position in the picture. Returns as set_camera().
  bool zoom(double factor, double x, double y);

  // Selection: state.selected is the inspected grain, state.selecting the rest of the selection.
  /// Selects one grain, or none, and nothing else.
  void select(std::optional<Index> grain);
  /// Selects these grains, sorted by id; a single one as above. The inspected grain stays if among them.
  void select(std::vector<Index> grains);
  void select(const ContactKey& contact);
  /// Returns all selected grains that exist in the frame shown, sorted by id.
  std::vector<Index> selected_grains() const;
  /// Returns the properties of the selected contact in the frame shown; nothing if none is selected.
  std::optional<ContactInspection> contact_inspection() const;
  /// Returns its contact_plots, over the axis of all plots; frames are added as they are read.
  std::vector<Plot> contact_history() const;
  /// Returns the plots in display order; values computed in the background are added later.
  std::span<const Plot> plots() const { return plots_; }
  /// Returns whether a replay knows all values of its frames, so that a plot without any stays empty.
  bool all_values_known() const;
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

  /// Returns the stored_maps of a replay.
  const std::vector<OwnQuantity>& own_maps() const { return own_maps_; }

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
  void begin_reading();
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
  /// Returns the report on a live run that has just failed or ended; else empty.
  std::string take_end();
  bool is_falling() const;
  pictures::MapExtent live_extent() const;
  /// Requests the values of all frames if `rule` has changed, and the history of the selected contact, and
  /// collects what has been read; returns whether anything has changed.
  bool follow_reader(const pictures::OverloadRule& rule);

  // view_shown.cpp: events of the run, and its curves from its records and its frames.
  void find_events();
  void plot_rows();
  void plot_values();
  PlotAbscissa abscissa() const { return {axis_, theta_c_.value_or(not_known)}; }

  std::vector<double> tilts_of_tilt() const { return frames_->instants().of_tilt(frame_tilts()); }

  /// Pictures of the run, with the current map and part of the bed.
  pictures::PictureSeries pictures_;
  RunStatics all_statics_;
  std::shared_ptr<FrameSource> frames_;     ///< the replay or the live run
  std::shared_ptr<const Frame> stored_;     ///< the frame shown, as it was read or computed
  std::shared_ptr<const Frame> frame_;      ///< the same with the gamma of neighbourhoods of l_min_
  double l_min_ = analysis::default_l_min;  ///< D
  std::optional<double> theta_c_;           ///< rad
  pictures::MapExtent bed_;                 ///< over the frames known so far
  std::vector<ObservableRow> rows_;
  std::vector<StepRow> steps_;  ///< rows of a replay
  std::vector<Plot> plots_ = empty_plots();
  PlotAxis axis_ = PlotAxis::tilt;  ///< abscissa of the plots along the run
  std::string error_;               ///< error since the last update

  // Members of a replay.
  std::shared_ptr<Replay> replay_;
  std::size_t shown_before_ = 0;  ///< previous frame, which gives the direction of playback
  std::optional<analysis::Analysis> analysis_;
  std::vector<OwnQuantity> own_maps_;

  Recording recording_;

  // Members of a live run.
  scenario::Scenario scenario_;
  std::string scenario_text_, command_line_;
  std::string first_output_;                ///< first requested output; empty: not recorded
  std::optional<io::BranchOrigin> origin_;  ///< origin, if the run is a branch
  std::optional<double> parent_theta_c_;    ///< rad; assumed for the branch until it fails
  std::shared_ptr<LiveRun> live_;
  std::shared_ptr<const Frame> newest_;  ///< current state of the run
  bool held_ = false;                    ///< whether a recorded frame is shown instead
  bool ended_ = false;                   ///< whether the end has been reported

  std::vector<Command> commands_;
  std::vector<ObservableRow> command_rows_;  ///< rows_up_to the newest state, which give commands a tilt
  std::vector<TimelineEvent> events_;

  std::unique_ptr<FrameReader> reader_;  ///< null while no frame may be read

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
