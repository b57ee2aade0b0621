#pragma once
/// State of the interactive view: plain data that widgets change and drawing reads.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.h"
#include "pictures/maps.h"
#include "view/plots.h"
#include "view/selection.h"

namespace talus::view {

/// Ends of a bar.
struct BarEnds {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;  ///< requires 0 < low
};

/// Returns the value at a share of the bar's length; the share may lie beyond the ends.
double value_at(const BarEnds& bar, double share);

/// Part of a bar that is being dragged, and the state of the bar when the drag began.
struct HeldBar {
  enum class Part { none, low, high, middle };
  Part part = Part::none;
  BarEnds before;
  double from = 0.0;  ///< position of the mouse at the beginning, px
};

/// Returns the ends after the dragged part has moved by a share of the bar's length. Pulling an end outwards
/// widens the range; pulling the middle moves both ends. The ends are rounded to what a pixel can resolve and
/// stay apart.
std::array<double, 2> pulled(const HeldBar& held, double share);

enum class Theme {
  light,
  dark,   ///< for dark rooms: the grays of maps are mirrored, so that black becomes bright
  print,  ///< journal style: white background, black text, nothing filled with gray
};

/// Names in the order of the themes, which is that in which they are offered.
inline constexpr std::array<std::string_view, 3> theme_names = {"light", "dark", "print"};
/// Returns the theme of one of these names.
Theme theme_of(std::string_view name);

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
  double scale = 0.0;             ///< scale of text and widgets; 0: that of the display
  std::optional<double> since;    ///< rad: motion and strain since that tilt; empty: per degree
  std::optional<Index> selected;  ///< the inspected grain, which commands act on
  SelectingState selecting;       ///< further grains, or a contact
  double neighbourhood = 10.0;    ///< D: diameter of the neighbourhood drawn about the inspected grain
  bool show_neighbourhoods = true;
  bool highlight_cluster = false;
  bool show_help = false;
  bool inspected = false;  ///< whether something has been selected since the window was opened
  bool show_controls = true, show_plots = true;
  bool discard_asked = false;                       ///< whether the user was asked to discard an unsaved run
  std::string panel_asked;                          ///< panel to open with the next picture
  HeldBar held_bar;                                 ///< drag of the legend's bar
  std::map<std::string, PlotOptions> plot_options;  ///< key: name of the plot
  std::string quantity_filter;                      ///< filter on the names of quantities offered for plots
  std::string enlarged_plot;                        ///< name of the plot; empty: all are shown
  std::string plots_folder = "talus-plots";         ///< folder for exported plots
  float picture_share = 0.0f;  ///< share of the height for the map; 0: as much as it needs
  Theme theme = Theme::light;
  std::string announcement;  ///< report on a run that has failed or ended, until dismissed
  std::string message;       ///< latest message: a file written, an error

  std::optional<GrainDrag> drag;

  // Contents of the action widgets.
  double push_speed = 1.0;    ///< sqrt(g D)
  double push_angle = 0.0;    ///< deg to the bed
  double drop_height = 5.0;   ///< D
  double run_to_tilt = 10.0;  ///< deg
  std::int64_t drop_count = 5;
  int pace = 0;           ///< index in live_paces
  std::int64_t seed = 1;  ///< seed of the next reset; that of the run when it begins
  std::string folder;     ///< folder shown in the list of files; empty: the working directory at start
  std::string picture_path = "talus.png";
  std::string run_path = "talus.h5";  ///< path in which an unrecorded run is saved
};

/// Returns the camera with its zoom limited to [1, zoom that shows 3 D], and its centre inside the bed. Zoom
/// 1 shows the entire bed.
ViewCamera clamped(const ViewCamera& camera, const pictures::MapExtent& bed, double mean_diameter);

/// Returns the aspect (width / height) of the smallest picture that holds a part of length 1 and depth
/// `depth`, turned by up to `turn_max` (rad, >= 0).
double picture_aspect(double depth, double turn_max);

/// Returns the part of the bed that fills a picture of that aspect (width / height). At zoom 1 it contains
/// the entire bed, with empty space around it; at other zooms it extends beyond the ends of the bed only as
/// far as it must. The part fits even if it is drawn turned by up to `turn_max` (rad, >= 0).
pictures::MapExtent shown_part(const ViewCamera& camera, const pictures::MapExtent& bed, double mean_diameter,
                               double aspect, double turn_max);

/// Returns the camera moved to the middle of the part that it shows, and back into the bed.
ViewCamera centred(const ViewCamera& camera, const pictures::MapExtent& part);

/// Returns the intersection of two parts.
pictures::MapExtent common_part(const pictures::MapExtent& one, const pictures::MapExtent& other);

}  // namespace talus::view
