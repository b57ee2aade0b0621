#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

#include "gui/panels.h"
#include "pictures/scale.h"

namespace talus::gui {
namespace {

ImU32 curve_colour(const Palette& colours, std::size_t k) {
  return packed(colours.curves[k % colours.curves.size()]);
}

struct AxisRange {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void take(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return !(low <= high); }
  /// Adds a margin, so that the range is never empty.
  void widen() {
    const double room = high > low ? 0.05 * (high - low) : std::max(0.5 * std::abs(high), 0.5);
    low -= room;
    high += room;
  }
};

/// Transformation from values to pixels.
struct Axes {
  AxisRange x, y;
  ImVec2 low, high;  ///< upper left and lower right corner of the frame
  bool log_y = false, falling_x = false;

  double shown_y(double value) const { return log_y ? std::log10(value) : value; }
  float px(double value) const {
    const double share = falling_x ? x.high - value : value - x.low;
    return low.x + static_cast<float>(share / (x.high - x.low)) * (high.x - low.x);
  }
  float py(double value) const {
    return high.y - static_cast<float>((shown_y(value) - y.low) / (y.high - y.low)) * (high.y - low.y);
  }
};

void find_ranges(const view::Plot& plot, const view::PlotOptions& options, Axes& axes) {
  const auto take = [&](double x, double y) {
    if (!std::isfinite(y) || (axes.log_y && !(y > 0.0))) return;
    if (options.zoomed && (x < (*options.zoomed)[0] || x > (*options.zoomed)[1])) return;
    axes.x.take(x);
    axes.y.take(axes.shown_y(y));
  };
  for (const view::PlotSeries& series : plot.series)
    for (std::size_t k = 0; k < series.x.size(); ++k) take(series.x[k], series.y[k]);
}

/// Returns at least two ticks of the y axis, if its range is not as small as the rounding of its numbers,
/// which are decades if a logarithmic axis has two of them.
std::vector<pictures::RoundTick> ticks_of_y(const Axes& axes, float em) {
  const bool decades = axes.log_y && std::floor(axes.y.high) > std::ceil(axes.y.low);
  std::vector<pictures::RoundTick> ticks;
  const int fitting = std::max(2, static_cast<int>((axes.high.y - axes.low.y) / (2.0f * em)));
  for (int most = fitting; ticks.size() < 2 && most < fitting + 16; ++most) {
    ticks = pictures::round_ticks(axes.y.low, axes.y.high, most);
    if (decades) std::erase_if(ticks, [](const auto& tick) { return tick.value != std::round(tick.value); });
  }
  return ticks;
}

void draw_ticks(ImDrawList& list, const Axes& axes, float em, ImU32 ink) {
  const int max_x = std::max(2, static_cast<int>((axes.high.x - axes.low.x) / (4.0f * em)));
  for (const pictures::RoundTick& tick : pictures::round_ticks(axes.x.low, axes.x.high, max_x)) {
    const float x = axes.px(tick.value);
    list.AddLine({x, axes.high.y}, {x, axes.high.y - 0.3f * em}, ink);
    const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
    list.AddText({x - 0.5f * width, axes.high.y + 0.1f * em}, ink, tick.label.c_str());
  }
  for (const pictures::RoundTick& tick : ticks_of_y(axes, em)) {
    const float share = static_cast<float>((tick.value - axes.y.low) / (axes.y.high - axes.y.low));
    const float y = axes.high.y - share * (axes.high.y - axes.low.y);
    list.AddLine({axes.low.x, y}, {axes.low.x + 0.3f * em, y}, ink);
    const std::string label = axes.log_y ? fmt::format("{:.2g}", std::pow(10.0, tick.value)) : tick.label;
    const float width = ImGui::CalcTextSize(label.c_str()).x;
    list.AddText({axes.low.x - width - 0.2f * em, y - 0.5f * ImGui::GetFontSize()}, ink, label.c_str());
  }
}

constexpr float column_width = 2.0f;  // px: without a GPU each line takes time

/// Lowest and highest point of a curve in a narrow column, in order of x: its visible extent.
struct PixelColumn {
  ImVec2 low, high;
  bool low_first = true;
};

/// Draws a curve with any number of points, thinned to what is visible. It is drawn line by line, because a
/// polyline has no width at a sharp turn.
void draw_curve(ImDrawList& list, const Axes& axes, const view::PlotSeries& series, ImU32 colour,
                float width) {
  std::optional<ImVec2> pen;
  std::optional<PixelColumn> column;
  const auto draw_to = [&](const ImVec2& place) {
    if (pen) list.AddLine(*pen, place, colour, width);
    pen = place;
  };
  const auto end_column = [&] {
    if (!column) return;
    draw_to(column->low_first ? column->low : column->high);
    if (column->low.y != column->high.y) draw_to(column->low_first ? column->high : column->low);
    column.reset();
  };
  for (std::size_t k = 0; k < series.x.size(); ++k) {
    if (!std::isfinite(series.y[k]) || (axes.log_y && !(series.y[k] > 0.0))) {
      end_column();
      pen.reset();
      continue;
    }
    const ImVec2 now{axes.px(series.x[k]), axes.py(series.y[k])};
    if (column && std::floor(now.x / column_width) != std::floor(column->low.x / column_width)) end_column();
    if (!column) column = PixelColumn{now, now, true};
    if (now.y < column->low.y) {
      column->low = now;
      column->low_first = false;
    }
    if (now.y > column->high.y) {
      column->high = now;
      column->low_first = true;
    }
  }
  end_column();
}

double x_at(const Axes& axes, float px) {
  float share = std::clamp((px - axes.low.x) / (axes.high.x - axes.low.x), 0.0f, 1.0f);
  if (axes.falling_x) share = 1.0f - share;
  return axes.x.low + static_cast<double>(share) * (axes.x.high - axes.x.low);
}

void show_values(const view::Plot& plot, const Axes& axes) {
  const float px = ImGui::GetIO().MousePos.x;
  if (px < axes.low.x || px > axes.high.x) return;
  const double x = x_at(axes, px);
  ImGui::BeginTooltip();
  rich_text(fmt::format("{}: {:.4g}", plot.x_title, x));
  for (const view::PlotSeries& series : plot.series)
    rich_text(fmt::format("{}: {:.4g}", series.name, value_near(series, x)));
  ImGui::EndTooltip();
}

/// Draws the chosen range, and a line of statistics for each measured curve.
void draw_chosen(const Palette& colours, ImDrawList& list, const view::Plot& plot,
                 const view::PlotOptions& options, const Axes& axes, float em) {
  float y = axes.low.y + 0.1f * em;
  const float left = axes.low.x + 0.4f * em;
  const auto write = [&](const std::string& text, ImU32 colour) {
    list.AddRectFilled({left, y}, {left + rich_width(text), y + 1.1f * em}, packed(colours.note));
    add_rich_text(list, {left, y}, colour, text);
    y += 1.1f * em;
  };
  if (!plot.note.empty()) write(plot.note, packed(colours.soft));
  if (!options.chosen) return;
  const auto [low, high] = *options.chosen;
  const auto [left_end, right_end] = std::minmax({axes.px(low), axes.px(high)});
  list.AddRectFilled({left_end, axes.low.y}, {right_end, axes.high.y}, packed(colours.range));
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    if (plot.series[k].law) continue;
    const view::RangeStatistics statistics = view::statistics_of(plot.series[k], low, high);
    write(fmt::format("{:.4g} ± {:.2g}, slope {:.3g}, {} values", statistics.mean, statistics.deviation,
                      statistics.slope, statistics.count),
          curve_colour(colours, k));
  }
}

/// Zooms along x about the mouse, within the range of the data.
void zoom_plot(view::PlotOptions& options, const Axes& axes, const Axes& all, float steps) {
  const double x = x_at(axes, ImGui::GetIO().MousePos.x), factor = std::pow(0.8, static_cast<double>(steps));
  const double low = std::max(all.x.low, x + factor * (axes.x.low - x));
  const double high = std::min(all.x.high, x + factor * (axes.x.high - x));
  options.zoomed.reset();
  if (low > all.x.low || high < all.x.high) options.zoomed = {low, high};
}

/// Handles the mouse on the plot drawn last; returns the x that was clicked.
std::optional<double> use_plot(view::ViewState& state, const view::Plot& plot, const Axes& axes,
                               const Axes& all) {
  const ImGuiIO& io = ImGui::GetIO();
  view::PlotOptions& options = state.plot_options[plot.name];
  const bool dragged = io.MouseDragMaxDistanceSqr[0] > 16.0f;
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0f) zoom_plot(options, axes, all, io.MouseWheel);
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0))
    state.enlarged_plot = state.enlarged_plot == plot.name ? std::string() : plot.name;
  if (ImGui::IsItemActive() && dragged) {
    const double from = x_at(axes, io.MouseClickedPos[0].x), to = x_at(axes, io.MousePos.x);
    options.chosen = {std::min(from, to), std::max(from, to)};
  }
  if (!ImGui::IsItemDeactivated() || dragged || !ImGui::IsItemHovered()) return std::nullopt;
  options.chosen.reset();
  return x_at(axes, io.MousePos.x);
}

/// Draws the title and, in their colours, the names of several curves; without room only these.
void draw_names(const Palette& colours, ImDrawList& list, const view::Plot& plot, const ImVec2& place,
                float right, float em) {
  float names = 0.0f;
  for (const view::PlotSeries& series : plot.series) names += rich_width(series.name) + 0.8f * em;
  const bool several = plot.series.size() > 1;
  const float title = rich_width(plot.title);
  if (!several || title + names < right - place.x)
    add_rich_text(list, place, packed(colours.ink), plot.title);
  if (!several) return;
  float x = std::max(place.x, right - names + 0.8f * em);
  for (std::size_t k = 0; k < plot.series.size(); ++k) {
    add_rich_text(list, {x, place.y}, curve_colour(colours, k), plot.series[k].name);
    x += rich_width(plot.series[k].name) + 0.8f * em;
  }
}

void draw_marks(const Palette& colours, ImDrawList& list, const Axes& axes, const view::PlotMarks& marks,
                float em) {
  if (marks.shown)
    list.AddLine({axes.px(*marks.shown), axes.low.y}, {axes.px(*marks.shown), axes.high.y},
                 packed(colours.accent));
  for (const double tick : marks.ticks)
    list.AddLine({axes.px(tick), axes.high.y}, {axes.px(tick), axes.high.y - 0.7f * em},
                 packed(colours.rearrangement));
  if (!marks.theta_c) return;
  const float x = axes.px(*marks.theta_c), dash = 0.3f * em;
  for (float y = axes.low.y; y < axes.high.y; y += 2.0f * dash)
    list.AddLine({x, y}, {x, std::min(y + dash, axes.high.y)}, packed(colours.grid));
}

}  // namespace

double value_near(const view::PlotSeries& series, double x) {
  if (series.x.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (!std::ranges::is_sorted(series.x)) {  // not monotonic: takes the first of the nearest points
    const auto distance = [x](double value) { return std::abs(value - x); };
    return series
        .y[static_cast<std::size_t>(std::ranges::min_element(series.x, {}, distance) - series.x.begin())];
  }
  const auto above = std::ranges::lower_bound(series.x, x);
  auto k = static_cast<std::size_t>(above - series.x.begin());
  if (k == series.x.size() || (k > 0 && x - series.x[k - 1] < series.x[k] - x)) --k;
  return series.y[k];
}

std::optional<double> draw_plot(Gui& gui, const view::Plot& plot, const ImVec2& size,
                                const view::PlotMarks& marks) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(std::string("plot ").append(plot.name).c_str(), size);
  note_place(gui, std::string("plot ").append(plot.name));
  if (!ImGui::IsItemVisible()) return std::nullopt;
  if (ImGui::IsItemHovered()) keep_wheel();  // prevents the plots from scrolling as well
  const view::PlotOptions options = gui.state.plot_options[plot.name];
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float em = gui.em;
  const Palette& colours = gui.colours;
  Axes axes;
  axes.log_y = options.log_y.value_or(plot.log_y);
  axes.falling_x = plot.falling_x;
  axes.low = {corner.x + 3.4f * em, corner.y + 1.5f * em};
  axes.high = {corner.x + size.x - 0.8f * em, corner.y + size.y - 2.5f * em};
  list.PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
  draw_names(colours, list, plot, {axes.low.x, corner.y + 0.2f * em}, axes.high.x, em);
  list.PopClipRect();
  list.AddRect(axes.low, axes.high, packed(colours.ink));
  const float title = rich_width(plot.x_title);
  add_rich_text(list, {0.5f * (axes.low.x + axes.high.x - title), axes.high.y + 1.1f * em},
                packed(colours.ink), plot.x_title);
  Axes all = axes;
  find_ranges(plot, {}, all);
  find_ranges(plot, options, axes);
  if (all.x.empty()) {
    list.AddText({axes.low.x + 0.5f * em, axes.low.y + 0.5f * em}, packed(colours.soft), "no data yet");
    return std::nullopt;
  }
  all.x.widen();
  if (axes.x.empty()) axes.y = all.y;  // zoomed between two values
  axes.x = all.x;
  if (options.zoomed) {
    axes.x.low = (*options.zoomed)[0];
    axes.x.high = (*options.zoomed)[1];
  }
  axes.y.widen();
  draw_ticks(list, axes, em, packed(gui.colours.ink));
  list.PushClipRect(axes.low, axes.high, true);
  draw_marks(colours, list, axes, marks, em);
  for (std::size_t k = plot.series.size(); k-- > 0;)
    draw_curve(list, axes, plot.series[k], curve_colour(colours, k),
               (plot.series[k].law ? 0.06f : 0.1f) * em);
  draw_chosen(colours, list, plot, options, axes, em);
  list.PopClipRect();
  if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) show_values(plot, axes);
  return use_plot(gui.state, plot, axes, all);
}

}  // namespace talus::gui
