#pragma once
/// State of the interactive view: plain data that widgets change and drawing reads.

#include <array>
#include <cstdint>
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

/// Part of the bed that fills the window.
struct ViewCamera {
  double centre_x = 0.0, centre_y = 0.0;  ///< m, frame of the bed
  double zoom = 1.0;                      ///< 1: the entire bed is visible
};

/// State of the second view.
struct SecondViewState {
  bool shown = false;
  pictures::MapLayers layers{};   ///< empty: same as the first view
  std::optional<double> minus{};  ///< rad: show the frame minus that at this tilt
};

/// Display options of a plot.
struct PlotOptions {
  std::optional<std::array<double, 2>> zoomed;  ///< limits of x; empty: all
  std::optional<std::array<double, 2>> chosen;  ///< range of x whose statistics are shown
  std::optional<bool> log_y;                    ///< overrides the default of the plot
};

/// Selection in addition to the inspected grain, and how it is made.
struct SelectingState {
  Selection selection;          ///< two or more grains, or a contact; empty: neither
  bool follow = false;          ///< whether the picture stays centred on the inspected grain
  std::vector<Vec2> outline;    ///< outline being drawn, px of the window; empty: none
  bool outline_is_box = false;  ///< whether it is a box between its first and its last point
};

/// Grain held by the mouse.
struct GrainDrag {
  Index grain = -1;
  double x = 0.0, y = 0.0;  ///< m, position of the mouse last sent to the run
  std::int64_t step = 0;    ///< step of the run at that time
};

struct ViewState {
  pictures::MapSettings map;  ///< layers, colours, threshold, length, turned, ...
  ViewCamera camera;
  SecondViewState second_view;
  std::optional<double> minus;    ///< rad, for a view that shows a frame minus that at this tilt
  double scale = 0.0;             ///< scale of text and widgets; 0: that of the display
  std::optional<double> since;    ///< rad: motion and strain since that tilt; empty: per degree
  std::optional<Index> selected;  ///< the inspected grain, which commands act on
  SelectingState selecting;       ///< further grains, or a contact
  double neighbourhood = 10.0;    ///< D: diameter of the neighbourhood drawn about the inspected grain
  bool show_neighbourhoods = true;
  bool highlight_cluster = false;
  bool show_help = false;
  bool show_controls = true, show_inspector = true, show_plots = true;
  bool discard_asked = false;                       ///< whether the user was asked to discard an unsaved run
  std::string panel_asked;                          ///< panel to open with the next picture
  HeldBar held_bar;                                 ///< drag of the legend's bar
  std::map<std::string, PlotOptions> plot_options;  ///< key: name of the plot
  std::string quantity_filter;                      ///< filter on the names of quantities offered for plots
  std::string enlarged_plot;                        ///< name of the plot; empty: all are shown
  std::string plots_folder = "talus-plots";         ///< folder for exported plots
  float picture_share =
      0.0f;  ///< share of the height for the map; 0: as high as the bed, the rest for the plots
  Theme theme = Theme::light;
  std::string announcement;  ///< report on a run that has failed or ended, until dismissed
  std::string message;       ///< latest message: a file written, an error

  std::optional<GrainDrag> drag;

  // Contents of the action widgets.
  double push_speed = 1.0;    ///< sqrt(g D)
  double push_angle = 0.0;    ///< deg to the bed
  double drop_height = 5.0;   ///< D
  double run_to_tilt = 10.0;  ///< deg
  int drop_count = 5;
  int pace = 0;           ///< index in live_paces
  std::int64_t seed = 1;  ///< seed of the next reset; that of the run when it begins
  std::string folder;     ///< folder shown in the list of files; empty: the working directory at start
  std::string picture_path = "talus.png";
  std::string run_path = "talus.h5";  ///< path in which an unrecorded run is saved
};

}  // namespace talus::view
