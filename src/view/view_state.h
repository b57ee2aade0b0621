#pragma once
/// What the interactive view shows, and how: plain data that widgets change and drawing reads.

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/types.h"
#include "pictures/maps.h"
#include "view/bar_range.h"
#include "view/plots.h"
#include "view/selection.h"
#include "view/theme.h"

namespace talus::view {

/// What part of the bed fills the window.
struct ViewCamera {
  double centre_x = 0.0, centre_y = 0.0;  ///< m, frame of the bed
  double zoom = 1.0;                      ///< 1: all of the bed is seen
};

/// What is shown beside the first view.
struct BesideState {
  bool shown = false;
  pictures::MapLayers layers{};     ///< empty: those of the first view
  std::optional<double> minus{};    ///< rad: the frame minus that at this tilt, instead of the frame
  std::string path{};               ///< of the run that is asked for next
  PlotAxis clock = PlotAxis::tilt;  ///< by which the frame of another run belongs to that of the first
};

/// How a plot is looked at.
struct PlotLook {
  std::optional<std::array<double, 2>> zoomed;  ///< from and to, of x; without: all
  std::optional<std::array<double, 2>> chosen;  ///< a range of x whose statistics are told
  std::optional<bool> log_y;                    ///< instead of what the plot has
};

/// What is selected beside a single grain, and how.
struct SelectingState {
  Selection selection;                           ///< two grains or more, or a contact; empty: neither
  SelectionMode mode = SelectionMode::anew;      ///< of a box, a lasso or a condition
  std::string condition;                         ///< that is written, or was
  std::string error;                             ///< why it selects nothing
  bool in_each_frame = false;                    ///< the condition selects anew in each frame
  std::string quantity = "gamma_neighbourhood";  ///< whose histogram is shown
  std::string table_path = "selected.csv";       ///< to be written
  bool trails = false;          ///< where the selected grains have been, up to the frame shown
  bool follow = false;          ///< the picture keeps the grain that is looked at in its middle
  std::vector<Vec2> outline;    ///< that is being drawn, px of the window; empty: none
  bool outline_is_box = false;  ///< between its first place and its last
};

/// A grain that the mouse holds.
struct GrainDrag {
  Index grain = -1;
  double x = 0.0, y = 0.0;  ///< m, where the mouse was when that was last told to the run
  std::int64_t step = 0;    ///< of the run then
};

struct ViewState {
  pictures::MapSettings map;  ///< layers, colours, threshold, length, turned, ...
  ViewCamera camera;
  BesideState beside;
  std::optional<double> minus;    ///< rad, of a view that shows a frame minus that at this tilt
  double scale = 0.0;             ///< of text and widgets; 0: that of the display
  std::optional<double> since;    ///< rad: motion and strain since that tilt; without: per degree
  std::optional<Index> selected;  ///< the grain that is looked at, and that commands act on
  SelectingState selecting;       ///< more grains than that one, or a contact
  double neighbourhood = 10.0;    ///< D: diameter of the neighbourhood drawn about the selected grain
  bool show_neighbourhoods = true;
  bool highlight_cluster = false;
  bool show_help = false;
  bool show_controls = true, show_inspector = true, show_plots = true;
  bool bookmark_asked = false;                 ///< a key has asked for the note of a bookmark
  bool discard_asked = false;                  ///< whether a run that is not saved may be given up
  std::string panel_asked;                     ///< to be opened with the next picture
  HeldBar held_bar;                            ///< of the legend
  std::map<std::string, PlotLook> plot_looks;  ///< by the names of plots
  std::string quantity_filter;                 ///< part of the names of quantities offered for plots
  std::string enlarged_plot;                   ///< its name; empty: all are shown
  std::string behind_path;                     ///< of a run or an ensemble to put behind the curves
  std::string plots_folder = "talus-plots";    ///< where plots are written
  float picture_share = 0.0f;  ///< of the height, for the map; 0: as high as the bed, the plots get the rest
  Theme theme = Theme::light;
  std::string bookmark_note;  ///< what is being written
  std::string announcement;   ///< of a run that has failed or ended, until it is clicked away
  std::string message;        ///< last thing worth telling: a file written, an error

  std::optional<GrainDrag> drag;

  // What the action widgets hold.
  double push_speed = 1.0;    ///< sqrt(g D)
  double push_angle = 0.0;    ///< deg to the bed
  double drop_height = 5.0;   ///< D
  double run_to_tilt = 10.0;  ///< deg
  int drop_count = 5;
  int pace = 0;        ///< of live_paces
  int seed = 1;        ///< of the next reset
  std::string folder;  ///< that the list of files shows; empty: where the program was started
  std::string picture_path = "talus.png";
  std::string run_path = "talus.h5";  ///< where a run is saved that was not recorded
};

}  // namespace talus::view
