#pragma once
/// The interactive view without its widgets: a run file that is replayed or a run that is computed, the frame
/// shown, its map, what is known of the grain selected, and the curves beside the map.

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/frame_view.h"
#include "view/contact_inspection.h"
#include "view/ghost.h"
#include "view/grain_quantities.h"
#include "view/inspection.h"
#include "view/landmarks.h"
#include "view/live_run.h"
#include "view/plots.h"
#include "view/scene.h"
#include "view/timeline.h"
#include "view/view_state.h"

namespace talus {

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

class ViewModel {
 public:
  /// A run file (replay) or a scenario (live), by what the file is. `output` of a live run may be empty:
  /// nothing is recorded. Throws Error as opening does.
  static ViewModel open(const std::string& path, const std::vector<std::string>& settings,
                        const std::string& output, bool overwrite, const std::string& command_line);
  ViewModel(ViewModel&&) noexcept;
  ViewModel& operator=(ViewModel&&) noexcept;
  ~ViewModel();

  ViewState state;  ///< changed by whoever shows it

  bool is_live() const;
  const std::string& path() const;
  LiveRun* live();  ///< null where a run file is replayed
  /// A live run anew from its scenario, with this seed, and without the commands made before. Where the run
  /// before was recorded, this one is too, in a file beside it: "slope-2.h5" after "slope.h5". Throws as
  /// LiveRun; then the run before is still there.
  void restart(std::uint64_t seed);
  std::uint64_t seed() const;
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

  // Frames: of a replay those of RunFile::all_frame_tilts(), of a live run those recorded so far.
  std::size_t frame_count() const;
  std::size_t frame_index() const;  ///< of a live run that is followed, the count
  std::vector<double> frame_tilts() const;
  /// Whether the tilt follows a programme, and so may fall and be held.
  bool has_program() const;
  std::span<const TimelineEvent> events() const;
  /// The bookmark of the frame shown; of a live run that is followed, of the frame recorded last. Null where
  /// there is none.
  const Bookmark* bookmark() const;
  /// Gives that frame a bookmark, or takes it away, and writes the file beside the run. What stands in the
  /// way is put into state.message, and nothing is changed.
  void set_bookmark(const std::string& note);
  void remove_bookmark();
  /// In a live run, which goes on, until it is followed again; nothing where it has no frame yet.
  void go_to(std::size_t frame);
  bool looks_back() const;  ///< whether a live run is not followed
  void follow();
  /// The frame nearest to an angle in degrees, or "repose": as frames_at, which says what is thrown. Throws
  /// Error(usage) for a live run.
  void go_to_angle(const std::string& angle);
  /// The tilt of that frame, rad. Throws as go_to_angle.
  double tilt_of(const std::string& angle) const;
  void go_to(Landmark landmark);  ///< does nothing where the run has no such place
  bool has(Landmark landmark) const;
  bool playing() const;
  void play(bool on);  ///< from the start where it is at the end
  void set_speed(double degrees_per_second);
  double speed() const;

  /// Call once a picture: takes the newest frame of a live run, moves a playing replay on by so many seconds,
  /// takes in what background work has finished, and brings the camera back to the bed. What went wrong, as a
  /// frame that cannot be read, is put into state.message. True where what is shown has changed.
  bool update(double seconds);

  const RunStatics& statics() const;
  const Frame& frame() const;
  double theta_c() const;  ///< rad; what maps are scaled by: of the run, or assumed (20 deg) while not known
  bool theta_c_known() const;
  double mean_diameter() const;

  /// The map of the frame shown, for a picture of that aspect (width / height), with the selection, the
  /// growing neighbourhoods and the highlighted cluster drawn into it; without furniture: that is drawn by
  /// widgets.
  FrameView map(double aspect) const;
  /// The same, on white whatever the theme, with its legends, its title and its caption, and without what is
  /// beside the bed; of the aspect that map was asked for last. A map that cannot be drawn has the reason as
  /// its title.
  FrameView furnished_map() const;
  /// Title, caption and legends of the map asked for last.
  const FrameView& annotated_map() const;
  /// Width over height of a picture in which the whole bed just has room, as it is shown: turned or not.
  double bed_aspect() const;
  /// The part of the bed that map(aspect) shows, m: x_min, x_max, y_min, y_max.
  std::array<double, 4> shown_region(double aspect) const;
  /// Moves the camera there, but not beyond the bed nor nearer than a few grains. False if the same part of
  /// the bed is shown as before.
  bool look(const ViewCamera& camera);
  /// Zooms by a factor about a place (m), which keeps its position in the picture; false as look.
  bool zoom(double factor, double x, double y);
  /// The grain whose disc holds the place (m, frame of the bed), or is nearest to it within a D.
  std::optional<Index> grain_at(double x, double y) const;

  // The second view, state.beside: of the same frame, or of that of another run which belongs to it.
  /// Another run, a replay beside a replay. Throws as open, and Error(usage) where one of them is computed.
  /// Shows the second view, by the time where both have a programme.
  void open_beside(const std::string& path);
  /// The second view is of this run again.
  void close_beside();
  /// The other run; null: the second view is of this run.
  const ViewModel* run_beside() const;
  /// Whether frames of the other run are found by it: theta_c - theta needs that both have failed.
  bool has_clock(PlotAxis clock) const;
  /// As map, annotated_map, furnished_map and grain_at, of the second view.
  FrameView map_beside(double aspect) const;
  const FrameView& annotated_map_beside() const;
  FrameView furnished_map_beside() const;
  std::optional<Index> grain_beside_at(double x, double y) const;
  /// A place of the bed of the second view (m), as one of the first: the same share of its length, as many D
  /// above the floor.
  Vec2 place_in_first(double x, double y) const;
  /// The numbers that the map of a view gives its free grains; made when they are first asked for of a frame.
  const GrainValues& values() const;
  const GrainValues& values_beside() const;
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
  /// grains_within, in the frame shown.
  std::vector<Index> grains_within(std::span<const Vec2> outline) const;
  /// find_contact, in the frame shown.
  std::optional<ContactKey> contact_at(double x, double y, double reach) const;
  /// Of all grains of the frame shown, by their ids. Made once for a frame and an overload rule.
  const std::vector<double>& grain_values(const GrainNumber& number) const;

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
  const Inspection* inspection() const;
  /// Plots in the order in which they are shown; values that are worked out in the background come in later.
  std::span<const Plot> plots() const;
  /// Quantities of the table of which this run has a number in each frame, at a threshold or at none, and of
  /// which there is no added plot: all if it has a stored analysis, else those of its rows and of overload.
  std::vector<const Quantity*> more_quantities() const;
  /// Adds a plot of one of these, the last of plots(); takes it away, by its name.
  void add_plot(const Quantity& quantity);
  void remove_plot(const std::string& name);
  /// What all plots along the run are over; the angle left only where theta_c is known. Another axis takes
  /// back what was zoomed and chosen on the one before; one that the run does not have is ignored.
  PlotAxis plot_axis() const;
  bool has_plot_axis(PlotAxis axis) const;
  void set_plot_axis(PlotAxis axis);
  /// Another run, or an ensemble, behind the curves along the run; none takes it away.
  void set_ghost(std::optional<Ghost> ghost);
  const Ghost* ghost() const;  ///< null where there is none
  /// On that axis: the frame shown, theta_c, rearrangements.
  PlotMarks plot_marks() const;
  /// The frame nearest to a place on that axis (deg or s).
  void go_to_place(double x);

  /// "talus render RUN --map ... --at 12.25 ...": draws what is shown. Empty for a live run that is not
  /// recorded.
  std::string render_command() const;

 private:
  /// Moves the camera to the grain that is looked at, where that is asked for.
  void follow_grain();

  struct Data;
  explicit ViewModel(std::unique_ptr<Data> data);
  std::unique_ptr<Data> data_;
};

}  // namespace talus
