#pragma once
/// What the view model holds, for the files it is made of.

#include <map>
#include <mutex>
#include <string_view>

#include "view/frame_ahead.h"
#include "view/frame_series.h"
#include "view/ghost.h"
#include "view/history.h"
#include "view/replay.h"
#include "view/run_clock.h"
#include "view/scene.h"
#include "view/selection_scene.h"
#include "view/timeline.h"
#include "view/view_model.h"

namespace talus {

/// Frames that a live run has recorded; one thread adds, and another reads.
class RecordedFrames {
 public:
  void add(std::vector<std::shared_ptr<const Frame>> more) {
    const std::scoped_lock lock(mutex_);
    frames_.insert(frames_.end(), more.begin(), more.end());
  }
  std::shared_ptr<const Frame> read(std::size_t k) {
    const std::scoped_lock lock(mutex_);
    return frames_.at(k);
  }
  /// For the thread that adds.
  const std::vector<std::shared_ptr<const Frame>>& all() const { return frames_; }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<const Frame>> frames_;
};

/// A map, and what it was made from.
struct MapCache {
  MapSource source;
  bool dark = false;  ///< on_dark_ground
  FrameView view;
  std::optional<GrainValues> values;  ///< of its grains, once asked for
};

struct ViewModel::Data {
  /// Of the run, with the map that is shown, and as much of the bed. Its statics are those of the frame
  /// shown: while a bed is poured, of the grains that have arrived.
  PictureSeries pictures;
  RunStatics all_statics;
  std::shared_ptr<const Frame> stored;  ///< the frame that is shown, as it was read or computed
  std::shared_ptr<const Frame> frame;   ///< the same with the gamma of neighbourhoods of l_min
  double l_min = default_l_min;         ///< D
  std::optional<double> theta_c;        ///< rad
  MapExtent bed;                        ///< as far as its frames are known
  std::vector<ObservableRow> rows;
  std::vector<Plot> plots = empty_plots();
  PlotAxis axis = PlotAxis::tilt;  ///< of the plots along the run
  std::optional<Ghost> ghost;      ///< behind them
  std::string error;               ///< what has gone wrong since the last update

  // What is beside it.
  std::shared_ptr<ReadingTurn> turn = std::make_shared<ReadingTurn>();  ///< of all runs that are open
  std::unique_ptr<ViewModel> other;                                     ///< another run; null: none
  struct {
    MapLayers layers;
    double theta_c = 0.0, other_theta_c = 0.0;  ///< rad
    std::optional<ScaleRange> range;
  } linked;                             ///< the range of a map that both runs show
  std::optional<MapExtent> bed_beside;  ///< m of this run: how high the other one is, for one scale of both

  // Of a run that is replayed.
  std::shared_ptr<RunFrames> frames;
  std::optional<Replay> replay;
  std::unique_ptr<FrameAhead> ahead;
  std::size_t shown_before = 0;  ///< the frame shown before the last one: which way it goes
  std::optional<Analysis> analysis;

  // Of a run that is computed.
  Scenario scenario;
  std::vector<std::string> scenario_settings;
  std::string scenario_text, command_line;
  std::string first_output, output;      ///< asked for at first; of this run: empty, it is not recorded
  std::optional<BranchOrigin> branch;    ///< where it began, if it is a branch
  std::vector<double> parent_tilts;      ///< rad, of the frames of the run that it left
  std::optional<double> parent_theta_c;  ///< rad; assumed of the branch until it has failed
  std::unique_ptr<LiveRun> live;
  std::shared_ptr<RecordedFrames> recorded;
  std::shared_ptr<const Frame> newest;  ///< of the run as it is now
  std::optional<std::size_t> held;      ///< the recorded frame that is shown instead
  bool ended = false;                   ///< that has been told

  std::optional<std::size_t> dilation;  ///< the frame at which it begins
  std::vector<Command> commands;
  std::vector<ObservableRow> file_rows;  ///< of a replay with commands: rows_up_to its end
  std::vector<TimelineEvent> events;
  std::vector<Bookmark> bookmarks;
  std::string bookmarks_unread;  ///< why those beside the run could not be read, and must not be replaced

  std::unique_ptr<FrameSeries> series;
  std::unique_ptr<HistorySeries> history;  ///< null where nothing is asked for

  // What was made last of the frame shown, and what else from.
  struct {
    std::shared_ptr<const Frame> frame;
    OverloadRule rule;
    Clusters clusters;
  } clusters;
  struct {
    std::shared_ptr<const Frame> frame;
    OverloadRule rule;
    double neighbourhood = 0.0;
    Inspection of;
  } inspection;
  MapCache map, map_beside;
  struct {
    std::shared_ptr<const Frame> stored, mapped;
    double l_min = 0.0;
  } reference;  ///< what a frame is shown minus
  struct {
    std::shared_ptr<const Frame> frame;
    OverloadRule rule;
    std::optional<FrameThreshold> judged;  ///< l_c and clusters at the threshold of the rule
    std::map<std::string_view, std::vector<double>> of;
  } grain_values;
  std::shared_ptr<const Frame> first_frame;      ///< of the run; null where it has not been asked for
  std::shared_ptr<const Frame> condition_frame;  ///< in which the condition has selected last
  double aspect = 0.0;                           ///< of the picture asked for last; 0: none was

  // view_data.cpp: what is shown, and how it goes on.
  void open_replay();
  /// Begins the run of `scenario`, and shows it instead of what was shown.
  void start_live(const std::string& output, bool overwrite);
  void begin_series();
  /// Ends all that is read in the background.
  void end_series();
  // view_branch.cpp
  void start_branch(std::size_t k);
  /// Takes over what a live run has recorded, from its beginning.
  void take_all_recorded();
  /// Frame k of a replay; null, with the reason in `error`, where it cannot be read.
  std::shared_ptr<const Frame> read(std::size_t k);
  /// Shows the frame that a replay is at; where it cannot be read, the one before stays and playing ends.
  void show_replayed();
  /// Another frame is shown; `mapped` where it is known already.
  void show(std::shared_ptr<const Frame> next, std::shared_ptr<const Frame> mapped = nullptr);
  /// Neighbourhoods begin at another diameter (D): makes `frame` anew; true where it is another.
  bool read_with(double next_l_min);
  void make_frame(std::shared_ptr<const Frame> mapped = nullptr);
  /// Takes over what a live run has made; true where its frame is another.
  bool take_live();
  /// Shows a recorded frame of a live run, or again what it computes.
  void hold_at(std::optional<std::size_t> frame);
  /// What there is to say of a live run that has just failed or ended; empty else.
  std::string take_end();
  void open_bookmarks();
  /// The file beside the run; empty where the run is in no file.
  std::string bookmarks_file() const;
  /// The frame that a bookmark would be of; none where there is no frame.
  std::optional<std::size_t> marked_frame() const;
  /// Takes over other bookmarks once they are written. Returns why they are not, or nothing.
  std::string keep_bookmarks(std::vector<Bookmark> next);
  /// The events anew.
  void find_events();
  /// Begins the series of frames anew where `rule` is another, and takes in what it has made; true where
  /// something has changed.
  bool follow_frames(const OverloadRule& rule);
  std::optional<std::size_t> place_of(Landmark landmark) const;
  std::size_t frame_count() const;

  /// The curves along the run anew: of what it records, and of its frames.
  void plot_rows();
  void plot_values();
  void note_thresholds(const OverloadRule& rule);

  // view_shown.cpp: what is made of it.
  const RunStatics& statics() const { return pictures.run.statics; }
  /// The tilts of the frames of the tilt.
  std::vector<double> frame_tilts() const;
  /// s, of the same frames.
  std::vector<double> frame_times() const;
  /// s, of all frames that can be gone to.
  std::vector<double> all_frame_times() const;
  double shown_theta_c() const;
  PlotAbscissa abscissa() const { return {axis, theta_c.value_or(not_known)}; }
  /// The settings of the map, with what the run has to say.
  MapSettings map_settings(const ViewState& asked) const;
  const Clusters& shown_clusters(const MapSettings& settings);
  const Inspection* inspect_selected(const ViewState& asked);
  /// view_selection.cpp: what conditions and tables of grains go by.
  /// Its values are those of `judged`, at the threshold of the map.
  GrainSource grain_source(const MapSettings& settings);
  SelectionMarks selection_marks(const ViewState& asked) const;
  const std::vector<double>& values_of_grains(const GrainNumber& number, const ViewState& asked);
  /// mu between grains at a step, as commands have set it.
  double friction_at(std::int64_t step) const;
  /// Reads what trails and the selected contact need; true where something has come in.
  bool follow_history(const ViewState& asked);
  std::vector<std::vector<Vec2>> shown_trails(const ViewState& asked) const;
  MapExtent part(const ViewState& asked, double aspect) const;
  /// Which of the frames of the run the one shown is, or would be if it were one of them.
  std::size_t shown_index() const;
  /// The bed, as high as the higher one of two runs.
  MapExtent viewed_bed() const;
  bool is_falling() const;
  /// That of a run that is computed, before the frame shown is looked at.
  MapExtent live_extent() const;
  /// Width over height of a picture in which the bed just has room.
  double bed_aspect(const ViewState& asked) const;
  /// The angle since which motions are shown, where the frame shown comes after it.
  std::optional<double> since_of(const ViewState& asked) const;
  /// Made again in its cache only where it has changed.
  const FrameView& whole_map(const ViewState& asked, const MapExtent& part, MapCache& cache);
  FrameView picture(const ViewState& asked, const MapExtent& part, MapCache& cache);
  /// With its furniture.
  FrameView furnished(const ViewState& asked, MapCache& cache);
  /// Which frame of a replay is at an angle, as ViewModel::go_to_angle has it, with what it throws.
  std::size_t frame_at_angle(const std::string& angle) const;
  /// Frame k of those that can be gone to; null where it cannot be read.
  std::shared_ptr<const Frame> frame_at(std::size_t k);
  /// The frame at a tilt (rad), as maps see it; null where there is none.
  std::shared_ptr<const Frame> reference_at(double tilt);

  // view_beside.cpp: the second view.
  RunInstants instants() const;
  /// What it shows: of this run, or of the other.
  ViewState beside_state(const ViewState& asked) const;
  /// Whether both show the same map, of two runs.
  bool same_map(const ViewState& asked) const;
  /// Brings the other run to the frame and the place shown; true where what it shows has changed.
  bool follow_beside(const ViewState& asked, double seconds);
  void link_ranges(const ViewState& asked);
  std::string render_command(const ViewState& asked) const;
};

}  // namespace talus
