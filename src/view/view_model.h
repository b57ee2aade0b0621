#pragma once
/// The interactive view without its widgets: a run file that is replayed or a run that is computed, the frame
/// shown, what is known of the grain selected, and the curves beside its maps. Two views show it.

#include <array>
#include <map>
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
#include "view/ghost.h"
#include "view/grain_quantities.h"
#include "view/history.h"
#include "view/inspection.h"
#include "view/live_run.h"
#include "view/plots.h"
#include "view/scene.h"
#include "view/timeline.h"
#include "view/view_state.h"

namespace talus::view {

/// Where a live run comes from, and where it is recorded.
struct Recording {
  std::string scenario;  ///< empty: of a branch, which is in its file
  std::vector<std::string> settings;
  std::string output;  ///< empty: nowhere
  std::uint64_t seed = 0;
};

/// The run that a branch has left, for the time line.
struct BranchLine {
  std::string run;
  std::size_t frame = 0;      ///< of it, at which the branch begins
  std::vector<double> tilts;  ///< rad, of its frames
};

/// A map, and what it was made from.
struct MapCache {
  MapSource source;
  bool dark = false;  ///< on_dark_ground
  render::FrameView view;
  std::optional<GrainValues> values;  ///< of its grains, once asked for
};

class ViewModel;

/// One of the two views: a map of a run, for as long as neither is changed. The second shows another map of
/// the same run, or a run that stands beside it.
struct View {
  ViewModel& run;
  const ViewState& state;  ///< with the map of this view
  MapCache& cache;
  bool second = false;

  /// The map of the frame shown, for a picture of that aspect (width / height), with the selection, the
  /// growing neighbourhoods and the highlighted cluster drawn into it; without furniture: that is drawn by
  /// widgets.
  render::FrameView map(double aspect) const;
  /// Title, caption and legends of the map asked for last; made again only where something has changed.
  const render::FrameView& annotated_map() const;
  /// The map on white whatever the theme, with its legends, its title and its caption, and without what is
  /// beside the bed; of the aspect that map was asked for last. A map that cannot be drawn has the reason as
  /// its title.
  render::FrameView furnished_map() const;
  /// The numbers that the map gives its free grains; made when they are first asked for of a frame.
  const GrainValues& values() const;
  /// The part of the bed that map(aspect) shows, m.
  pictures::MapExtent part(double aspect) const;
  /// Width over height of a picture in which the whole bed just has room, as it is shown: turned or not.
  double bed_aspect() const;
  /// The settings of the map, with what the run has to say.
  pictures::MapSettings settings() const;
  /// The angle (rad) since which motions are shown, where the frame shown comes after it.
  std::optional<double> since() const;
  /// The frame that motions are measured from; null where there is none.
  std::shared_ptr<const Frame> reference() const;

 private:
  const render::FrameView& whole_map(const pictures::MapExtent& shown) const;
  render::FrameView picture(const pictures::MapExtent& shown) const;
};

/// A place (m) of one bed in another: the same share of its length, as many D above the floor.
Vec2 place_in(const RunStatics& to, const RunStatics& from, double x, double y);

class ViewModel {
 public:
  /// A run file (replay) or a scenario (live), by what the file is. `output` of a live run may be empty:
  /// nothing is recorded. Throws Error as opening does.
  static ViewModel open(const std::string& path, const std::vector<std::string>& settings,
                        const std::string& output, bool overwrite, const std::string& command_line);

  ViewState state;  ///< changed by whoever shows it

  View first() { return {*this, state, map_, false}; }
  /// What state.beside asks for; the frame of another run is that which belongs to the frame shown.
  View second();

  bool is_live() const { return live_ != nullptr; }
  const std::string& path() const { return pictures_.path; }
  LiveRun* live() const { return live_.get(); }  ///< null where a run file is replayed
  std::uint64_t seed() const { return pictures_.run.seed; }
  /// A live run anew from its scenario, with this seed, and without the commands made before. Where the run
  /// before was recorded, this one is too, in a file beside it: "slope-2.h5" after "slope.h5". Throws as
  /// LiveRun; then the run before is still there.
  void restart(std::uint64_t seed);
  /// A replay goes on from the frame shown, as a live run that is not recorded. A branch is reset to that
  /// frame, whatever the seed. Nothing in a live run. Throws as checkpoint_at_frame; then the replay is still
  /// there.
  void branch();
  std::optional<BranchLine> branch_line() const;  ///< where the live run is a branch
  /// A live run goes back before its last command, paused; one that is recorded goes on in a file beside it.
  /// Throws as LiveRun::back.
  void back();
  /// Records a live run that was not, from its beginning. Throws as LiveRun::record.
  void record(const std::string& output);
  Recording recording() const;
  /// Whether what is shown may be given up: where a live run has not been saved, only when asked again.
  bool may_discard();
  /// Ends all that is read or written in the background, until the next update: before another run is opened,
  /// as HDF5 is for one thread at a time.
  void hold();

  // Frames: of a replay all of its file, of a live run those recorded so far.
  std::size_t frame_count() const { return frames_->count(); }
  std::size_t frame_index() const;  ///< of a live run that is followed, the count
  const std::vector<double>& frame_tilts() const { return frames_->instants().tilts; }
  /// Whether the tilt follows a programme, and so may fall and be held.
  bool has_program() const { return pictures_.has_program; }
  std::span<const TimelineEvent> events() const { return events_; }
  /// The bookmark of the frame shown; of a live run that is followed, of the frame recorded last. Null where
  /// there is none.
  const Bookmark* bookmark() const;
  /// Gives that frame a bookmark, or without a note takes it away, and writes the file beside the run. What
  /// stands in the way is put into state.message, and nothing is changed.
  void set_bookmark(const std::optional<std::string>& note);
  /// In a live run, which goes on, until it is followed again; nothing where it has no frame yet.
  void go_to(std::size_t frame);
  bool looks_back() const { return held_.has_value(); }  ///< whether a live run is not followed
  void follow();
  /// The frame nearest to an angle in degrees, or "repose": as frames_at, which says what is thrown. Throws
  /// Error(usage) for a live run.
  std::size_t frame_at_angle(const std::string& angle) const;
  void go_to(Landmark landmark);  ///< does nothing where the run has no such place
  bool has(Landmark landmark) const { return place_of(landmark).has_value(); }
  bool playing() const { return replay_ && replay_->playing(); }
  void play(bool on);  ///< from the start where it is at the end
  void set_speed(double degrees_per_second);
  double speed() const { return replay_ ? replay_->speed() : 0.0; }

  /// Call once a picture: takes the newest frame of a live run, moves a playing replay on by so many seconds,
  /// takes in what background work has finished, and brings the camera back to the bed. What went wrong, as a
  /// frame that cannot be read, is put into state.message. True where what is shown has changed.
  bool update(double seconds);

  /// Those of the frame shown: while a bed is poured, of the grains that have arrived.
  const RunStatics& statics() const { return pictures_.run.statics; }
  const Frame& frame() const { return *frame_; }
  BedFrame bed() const { return {frame(), statics()}; }
  double theta_c() const;  ///< rad; what maps are scaled by: of the run, or assumed (20 deg) while not known
  bool theta_c_known() const { return theta_c_.has_value(); }
  double mean_diameter() const { return statics().mean_diameter; }

  /// Moves the camera there, but not beyond the bed nor nearer than a few grains. False if the same part of
  /// the bed is shown as before.
  bool look(const ViewCamera& camera);
  /// Zooms by a factor about a place (m), which keeps its position in the picture; false as look.
  bool zoom(double factor, double x, double y);

  /// Another run, a replay beside a replay. Throws as open, and Error(usage) where one of them is computed.
  /// Shows the second view, by the time where both have a programme.
  void open_beside(const std::string& path);
  /// The second view is of this run again.
  void close_beside();
  /// The other run; null: the second view is of this run.
  const ViewModel* run_beside() const { return other_.get(); }
  /// Whether frames of the other run are found by it: theta_c - theta needs that both have failed.
  bool has_clock(PlotAxis clock) const;

  // Selecting: state.selected is the grain that is looked at, state.selecting what is selected beside it.
  /// One grain, or none, and nothing else.
  void select(std::optional<Index> grain);
  /// These grains, by ascending ids; a single one as above. The one that is looked at stays if it is among
  /// them.
  void select(std::vector<Index> grains);
  void select(const ContactKey& contact);
  /// What is selected now, combined with grains that were found, as state.selecting.mode has it; a condition
  /// selects no longer in each frame.
  void select_found(const std::vector<Index>& found);
  /// The same for the grains of which state.selecting.condition holds in the frame shown; an empty one finds
  /// none. With in_each_frame they take the place of those before. What is wrong with it is put into
  /// state.selecting.error, and changes nothing.
  void select_by_condition();
  /// All that are selected and there in the frame shown, by ascending ids.
  std::vector<Index> selected_grains() const;
  /// find_contact, in the frame shown.
  std::optional<ContactKey> contact_at(double x, double y, double reach) const;
  /// Of all grains of the frame shown, by their ids, as the first map has them: measured since the same
  /// frame, over the same length. Made once for a frame and settings.
  const std::vector<double>& grain_values(const analysis::GrainNumber& number);

  /// Of the selected contact in the frame shown; none where none is selected.
  std::optional<ContactInspection> contact_inspection() const;
  /// contact_plots of it, over the axis of all plots; frames come in as they are read.
  std::vector<Plot> contact_history() const;
  /// Of how many grains trails are drawn at most; where more are selected, of every second, third, ... of
  /// them.
  static constexpr std::size_t most_trails = 500;

  /// Writes all quantities of the selected grains as grains_table to a file that is not there yet, and says
  /// so in state.message, or what stands in the way.
  void write_selected(const std::string& path);

  /// Of state.selected in the frame shown; none where nothing is selected. Made once for a frame and a
  /// selection.
  const Inspection* inspection() { return inspect_selected(first()); }
  /// Plots in the order in which they are shown; values that are worked out in the background come in later.
  std::span<const Plot> plots() const { return plots_; }
  /// Quantities of the table of which this run has a number in each frame, at a threshold or at none, and of
  /// which there is no added plot: all if it has a stored analysis, else those of its rows and of overload.
  std::vector<const analysis::Quantity*> more_quantities() const;
  /// Adds a plot of one of these, the last of plots(); takes it away, by its name.
  void add_plot(const analysis::Quantity& quantity);
  void remove_plot(const std::string& name);
  /// What all plots along the run are over; the angle left only where theta_c is known. Another axis takes
  /// back what was zoomed and chosen on the one before; one that the run does not have is ignored.
  PlotAxis plot_axis() const { return axis_; }
  bool has_plot_axis(PlotAxis axis) const { return axis != PlotAxis::angle_left || theta_c_known(); }
  void set_plot_axis(PlotAxis axis);
  /// Another run, or an ensemble, behind the curves along the run; none takes it away.
  void set_ghost(std::optional<Ghost> ghost);
  const Ghost* ghost() const { return ghost_ ? &*ghost_ : nullptr; }  ///< null where there is none
  /// On that axis: the frame shown, theta_c, rearrangements.
  PlotMarks plot_marks() const;
  /// The frame nearest to a place on that axis (deg or s).
  void go_to_place(double x);

  /// "talus render RUN --map ... --at 12.25 ...": draws what is shown. Empty for a live run that is not
  /// recorded.
  std::string render_command();

 private:
  friend struct View;

  ViewModel() = default;

  // view_run.cpp: the run, and how it goes on.
  void open_replay();
  /// Begins the run of scenario_, and shows it instead of what was shown.
  void start_live(const std::string& output, bool overwrite);
  /// Takes over what a live run has recorded, from its beginning.
  void take_all_recorded();
  void begin_series();
  /// Ends all that is read in the background.
  void end_series();
  /// Frame k of those that can be gone to; null, with the reason in error_, where it cannot be read.
  std::shared_ptr<const Frame> frame_at(std::size_t k);
  /// Shows the frame that a replay is at; where it cannot be read, the one before stays and playing ends.
  void show_replayed();
  /// Another frame is shown; `mapped` where it is known already.
  void show(std::shared_ptr<const Frame> next, std::shared_ptr<const Frame> mapped = nullptr);
  /// Makes frame_ anew, where `mapped` does not have it.
  void make_frame(std::shared_ptr<const Frame> mapped = nullptr);
  /// Takes over what a live run has made; true where its frame is another.
  bool take_live();
  /// Shows a recorded frame of a live run, or again what it computes.
  void hold_at(std::optional<std::size_t> frame);
  /// What there is to say of a live run that has just failed or ended; empty else.
  std::string take_end();
  bool is_falling() const;
  pictures::MapExtent live_extent() const;
  /// Begins the series of frames anew where `rule` is another, and takes in what it has made; true where
  /// something has changed.
  bool follow_frames(const pictures::OverloadRule& rule);

  // view_events.cpp: what happened in it.
  void find_events();
  std::optional<std::size_t> place_of(Landmark landmark) const;
  void open_bookmarks();
  /// The file beside the run; empty where the run is in no file.
  std::string bookmarks_file() const;
  /// The frame that a bookmark would be of; none where there is no frame.
  std::optional<std::size_t> marked_frame() const;

  // view_plots.cpp: its curves anew, of what it records, and of its frames.
  void plot_rows();
  void plot_values();
  void note_thresholds(const pictures::OverloadRule& rule);
  PlotAbscissa abscissa() const { return {axis_, theta_c_.value_or(not_known)}; }

  // view_shown.cpp: what is made of the frame shown.
  const analysis::Clusters& shown_clusters(const pictures::MapSettings& settings);
  const Inspection* inspect_selected(const View& view);
  /// The bed, as high as the higher one of two runs.
  pictures::MapExtent viewed_bed() const;
  /// The frame at a tilt (rad), as maps see it; null where there is none.
  std::shared_ptr<const Frame> reference_at(double tilt);

  // view_selection.cpp
  /// What conditions and tables of grains go by; `measured`: with the earlier frame.
  analysis::GrainSource grain_source(bool measured);
  /// What is selected in the frame shown, beside the grain that is looked at.
  Overlay selection_marks() const;
  /// mu between grains at a step, as commands have set it.
  double friction_at(std::int64_t step) const;
  /// Reads what trails and the selected contact need; true where something has come in.
  bool follow_history();
  /// Moves the camera to the grain that is looked at, where that is asked for.
  void follow_grain();

  // view_beside.cpp: what links two views.
  /// When all frames are, theta_c, and the frames of the tilt among them.
  RunInstants instants() const;
  std::vector<double> tilts_of_tilt() const;
  std::vector<double> times_of_tilt() const;
  ViewState beside_state() const;
  /// Whether both views show the same map, of two runs.
  bool same_map() const;
  /// Brings the other run to the frame and the place shown; true where what it shows has changed.
  bool follow_beside(double seconds);
  void link_ranges();

  /// Of the run, with the map that is shown, and as much of the bed.
  pictures::PictureSeries pictures_;
  RunStatics all_statics_;
  std::shared_ptr<FrameSource> frames_ = std::make_shared<RecordedFrames>();
  std::shared_ptr<const Frame> stored_;     ///< the frame that is shown, as it was read or computed
  std::shared_ptr<const Frame> frame_;      ///< the same with the gamma of neighbourhoods of l_min_
  double l_min_ = analysis::default_l_min;  ///< D
  std::optional<double> theta_c_;           ///< rad
  pictures::MapExtent bed_;                 ///< as far as its frames are known
  std::vector<ObservableRow> rows_;
  std::vector<Plot> plots_ = empty_plots();
  PlotAxis axis_ = PlotAxis::tilt;  ///< of the plots along the run
  std::optional<Ghost> ghost_;      ///< behind them
  std::string error_;               ///< what has gone wrong since the last update

  // What is beside it.
  std::shared_ptr<ReadingTurn> turn_ = std::make_shared<ReadingTurn>();  ///< of all runs that are open
  std::unique_ptr<ViewModel> other_;                                     ///< another run; null: none
  struct {
    pictures::MapLayers layers;
    double theta_c = 0.0, other_theta_c = 0.0;  ///< rad
    std::optional<pictures::ScaleRange> range;
  } linked_;  ///< the range of a map that both runs show
  std::optional<pictures::MapExtent>
      bed_beside_;          ///< m of this run: how high the other one is, for one scale of both
  ViewState second_state_;  ///< of a second view of this run, when it was asked for last

  // Of a run that is replayed.
  std::shared_ptr<RunFrames> run_file_;
  std::optional<Replay> replay_;
  std::unique_ptr<FrameAhead> ahead_;
  std::size_t shown_before_ = 0;  ///< the frame shown before the last one: which way it goes
  std::optional<analysis::Analysis> analysis_;

  // Of a run that is computed.
  scenario::Scenario scenario_;
  std::vector<std::string> scenario_settings_;
  std::string scenario_text_, command_line_;
  std::string first_output_, output_;       ///< asked for at first; of this run: empty, it is not recorded
  std::optional<io::BranchOrigin> origin_;  ///< where it began, if it is a branch
  std::vector<double> parent_tilts_;        ///< rad, of the frames of the run that it left
  std::optional<double> parent_theta_c_;    ///< rad; assumed of the branch until it has failed
  std::unique_ptr<LiveRun> live_;
  std::shared_ptr<RecordedFrames> recorded_;
  std::shared_ptr<const Frame> newest_;  ///< of the run as it is now
  std::optional<std::size_t> held_;      ///< the recorded frame that is shown instead
  bool ended_ = false;                   ///< that has been told

  std::vector<Command> commands_;
  std::vector<ObservableRow> file_rows_;  ///< of a replay with commands: rows_up_to its end
  std::vector<TimelineEvent> events_;
  std::vector<Bookmark> bookmarks_;
  std::string bookmarks_unread_;  ///< why those beside the run could not be read, and must not be replaced

  std::unique_ptr<FrameSeries> series_;
  std::unique_ptr<HistorySeries> history_;  ///< null where nothing is asked for

  // What was made last of the frame shown, and what else from.
  struct {
    std::shared_ptr<const Frame> frame;
    pictures::OverloadRule rule;
    analysis::Clusters clusters;
  } clusters_;
  struct {
    std::shared_ptr<const Frame> frame;
    pictures::OverloadRule rule;
    double neighbourhood = 0.0;
    Inspection of;
  } inspection_;
  struct {
    std::shared_ptr<const Frame> stored, mapped;
    double l_min = 0.0;
  } reference_;  ///< what a frame is shown minus
  struct GrainValuesCache {
    std::shared_ptr<const Frame> frame;
    pictures::OverloadRule rule;
    std::optional<double> since;
    double length = 0.0;
    std::optional<analysis::FrameThreshold> judged;  ///< l_c and clusters at the threshold of the rule
    std::shared_ptr<const Frame> earlier;
    std::map<std::string_view, std::vector<double>> of;
  } grain_values_;
  MapCache map_, second_map_;
  std::shared_ptr<const Frame> first_frame_;      ///< of the run; null where it has not been asked for
  std::shared_ptr<const Frame> condition_frame_;  ///< in which the condition has selected last
  double aspect_ = 0.0;                           ///< of the picture asked for last; 0: none was
};

}  // namespace talus::view
