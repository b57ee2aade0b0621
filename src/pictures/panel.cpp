#include "pictures/panel.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <optional>
#include <span>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "pictures/frame_choice.h"
#include "pictures/picture_files.h"

namespace talus::pictures {
namespace {

using Rows = std::vector<std::vector<render::FrameView>>;

/// Removes and returns the beginning, up to a comma, that all titles share.
std::string extract_common_beginning(const std::vector<std::string*>& titles) {
  const auto without_comma = [](const std::string& text) { return text.substr(0, text.rfind(", ")); };
  std::string common = *titles.front() + ", ";
  for (const std::string* title : titles) {
    common.erase(std::ranges::mismatch(common, *title + ", ").in1, common.end());
    const std::size_t comma = common.rfind(", ");
    common.erase(comma == std::string::npos ? 0 : comma + 2);
  }
  for (std::string* title : titles) *title = without_comma((*title + ", ").substr(common.size()));
  return without_comma(common);
}

/// Removes from the captions, and returns, all but the first part: the angle of repose.
std::string take_rest(Rows& maps) {
  std::string rest;
  for (std::vector<render::FrameView>& row : maps)
    for (render::FrameView& view : row) {
      const std::size_t end = std::min(view.caption.find(", "), view.caption.size());
      if (end < view.caption.size()) rest = view.caption.substr(end + 2);
      view.caption.erase(end);
    }
  return rest;
}

/// Returns a view with texts and without a bed.
render::FrameView heading(const render::FrameView& like, const std::string& title,
                          const std::string& caption) {
  render::FrameView view;
  view.letters = like.letters;
  view.max_letters = like.max_letters;
  view.transparent = like.transparent;
  view.title = title;
  view.caption = caption;
  return view;
}

/// Returns "(a)", "(b)", ..., "(z)", "(aa)", ...
std::string letter(std::size_t k) {
  constexpr std::size_t letters = 26;
  std::string text;
  for (std::size_t left = k + 1; left > 0; left = (left - 1) / letters)
    text.insert(text.begin(), static_cast<char>('a' + (left - 1) % letters));
  return "(" + text + ")";
}

bool have_same_legends(const render::FrameView& one, const render::FrameView& other) {
  const auto same_bar = [](const render::Bar& x, const render::Bar& y) {
    return x.title == y.title && x.low == y.low && x.high == y.high && x.colours == y.colours;
  };
  return std::ranges::equal(one.legends, other.legends,
                            [&](const render::Legend& x, const render::Legend& y) {
                              return x.swatches == y.swatches && std::ranges::equal(x.bars, y.bars, same_bar);
                            });
}

/// Reduces repeated furniture. A legend appears only below the last angle, unless that of another angle
/// differs, and once for maps with equal legends; the scale bar appears below the last map.
void share_furniture(Rows& maps) {
  if (maps.size() * maps.front().size() > 1) std::ranges::for_each(maps, share_row);
  for (std::vector<render::FrameView>& row : std::span(maps).first(maps.size() - 1)) {
    row.back().scale_label.clear();
    for (std::size_t map = 0; map < row.size(); ++map)
      if (have_same_legends(row[map], maps.back()[map])) row[map].legends.clear();
  }
  std::vector<render::FrameView>& last = maps.back();
  for (std::size_t map = last.size(); map-- > 1;)
    for (std::size_t before = 0; before < map; ++before)
      if (have_same_legends(last[map], last[before])) last[map].legends.clear();
}

Rows panel_maps(DrawnRun& run, const FrameChoice& choice) {
  Rows rows;
  for (const std::size_t frame : choice) {
    std::vector<render::FrameView>& row = rows.emplace_back();
    for (std::size_t map = 0; map < run.series.plan.maps.size(); ++map)
      row.push_back(picture(run, frame, map));
  }
  return rows;
}

/// Places this many angles next to each other, and fills up the last row with empty views.
Rows grouped(const Rows& maps, std::size_t side_by_side) {
  Rows rows;
  for (std::size_t k = 0; k < maps.size(); ++k) {
    if (k % side_by_side == 0) rows.emplace_back();
    rows.back().insert(rows.back().end(), maps[k].begin(), maps[k].end());
  }
  while (rows.back().size() < rows.front().size()) rows.back().push_back(heading(maps[0][0], "", ""));
  return rows;
}

/// Returns the first frame, the last before failure or of the run, and that halfway between them.
FrameChoice usual_frames(const DrawnRun& run) {
  const std::vector<double>& tilts = run.file.frame_tilts();
  const double theta_c = run.theta_c();
  const std::size_t last = std::isfinite(theta_c) ? frame_at_repose(tilts, theta_c) : tilts.size() - 1;
  FrameChoice choice = {0, *nearest_frame(tilts, 0.5 * (tilts.front() + tilts[last])), last};
  std::ranges::sort(choice);
  choice.erase(std::unique(choice.begin(), choice.end()), choice.end());
  return choice;
}

std::string panel_source(const PictureSeries& series, const FrameChoice& choice) {
  const std::string angles =
      joined(choice, ", ", [&](std::size_t k) { return tilt_text(series.seen_frames.instants[k].tilt); });
  const std::string maps = joined(series.plan.maps, " ", name_of);
  return picture_source(series.path, fmt::format("frames at {} deg, {}", angles, maps));
}

}  // namespace

void share_row(std::vector<render::FrameView>& maps) {
  for (render::FrameView& map : maps) {
    map.arrow_in_caption = true;
    if (&map != &maps.front() && map.caption == maps.front().caption) map.caption.clear();
    if (&map != &maps.back()) map.scale_label.clear();
  }
}

Rows panel_rows(Rows maps, const std::string& title, std::size_t side_by_side) {
  const std::size_t kinds = maps.front().size();
  if (!maps[0][0].furniture) return grouped(maps, side_by_side);
  const bool one_angle = maps.size() == 1;
  const std::string common = one_angle && title.empty() ? "" : take_rest(maps);
  std::vector<render::FrameView> headings;
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    std::vector<std::string*> titles;
    for (std::vector<render::FrameView>& row : maps) titles.push_back(&row[kind].title);
    headings.push_back(heading(maps[0][kind], one_angle ? "" : extract_common_beginning(titles), ""));
  }
  share_furniture(maps);
  for (std::size_t k = 0; maps.size() * kinds > 1 && k < maps.size() * kinds; ++k) {
    std::string& text = maps[k / kinds][k % kinds].title;
    text = letter(k) + (text.empty() ? "" : " ") + text;
  }
  Rows rows;
  if (!title.empty()) rows.push_back({heading(headings[0], title, common)});
  const auto same = [&](const render::FrameView& view) { return view.title == headings[0].title; };
  const bool one_heading = std::ranges::all_of(headings, same);
  headings.resize(one_heading ? 1 : kinds * side_by_side, headings[0]);
  for (std::size_t k = kinds; k < headings.size(); ++k) headings[k] = headings[k % kinds];
  if (title.empty()) headings.back().caption = common;
  rows.push_back(std::move(headings));
  std::erase_if(rows, [](const std::vector<render::FrameView>& row) {
    return std::ranges::all_of(
        row, [](const render::FrameView& view) { return view.title.empty() && view.caption.empty(); });
  });
  std::ranges::move(grouped(maps, side_by_side), std::back_inserter(rows));
  return rows;
}

render::Sheet panel_sheet(const Rows& maps, const std::string& title, int width, int highest,
                          const render::Font& font) {
  render::Sheet best = render::sheet_of_rows(panel_rows(maps, title, 1), width, font);
  for (std::size_t side_by_side = 2; side_by_side <= maps.size() && best.height > highest; ++side_by_side)
    try {
      render::Sheet sheet = render::sheet_of_rows(panel_rows(maps, title, side_by_side), width, font);
      if (sheet.height < best.height) best = std::move(sheet);
    } catch (const Error&) {  // the texts do not fit
      break;
    }
  if (best.height > render::largest_side)
    throw Error(ExitCode::usage,
                "the picture would be {} px high; at most {} px are possible: ask for a smaller width, or "
                "for fewer angles",
                best.height, render::largest_side);
  return best;
}

render::Sheet panel_sheet_of_size(const Rows& maps, const std::string& title, int width, int height,
                                  const render::Font& font) {
  std::optional<render::Sheet> best;
  int largest = 0;  // share of an angle in the width of the best sheet
  for (int side_by_side = 1; side_by_side <= static_cast<int>(maps.size()); ++side_by_side)
    for (int narrower = width; narrower >= render::smallest_width && narrower / side_by_side > largest;) {
      Rows smaller = maps;
      for (std::vector<render::FrameView>& row : smaller)
        for (render::FrameView& view : row) {  // letters keep their size
          view.letters *= static_cast<double>(narrower) / width;
          view.max_letters *= static_cast<double>(narrower) / width;
        }
      try {
        render::Sheet sheet = render::sheet_of_rows(
            panel_rows(std::move(smaller), title, static_cast<std::size_t>(side_by_side)), narrower, font);
        if (sheet.height > height) {
          narrower = std::min(narrower - std::max(1, width / 100),
                              static_cast<int>(static_cast<double>(narrower) * height / sheet.height));
          continue;
        }
        const int right = (width - narrower) / 2, down = (height - sheet.height) / 2;
        for (render::PlacedView& view : sheet.views) render::move_by(view.layout, right, down);
        sheet.width = width;
        sheet.height = height;
        largest = narrower / side_by_side;
        best = std::move(sheet);
      } catch (const Error&) {  // the texts do not fit
      }
      break;
    }
  if (best) return *best;
  throw Error(ExitCode::usage,
              "the maps do not fit into {} x {} px: ask for a larger size, or for fewer maps or angles",
              width, height);
}

namespace {

/// Returns the size of a panel that is `larger` times as large as the plan has it: "--size 8.6cm".
std::string size_text(const MapPlan& plan, double larger) {
  const double printed = plan.maps.front().printed, step = printed > 0.0 ? 0.1 : 1.0;
  const auto side = [&](double length) { return step * std::ceil(larger * length / step - 1e-6); };
  const double width = printed > 0.0 ? printed : plan.width;
  const std::string height =
      plan.height > 0 ? fmt::format("x{:.6g}", side(width * plan.height / plan.width)) : std::string();
  return fmt::format("--size {:.6g}{}{}", side(width), height, printed > 0.0 ? "cm" : "");
}

/// Returns a panel that is `larger` times as large as the plan has it.
render::Sheet sheet_of_plan(Rows maps, const std::string& title, const MapPlan& plan, double larger) {
  const MapSettings& settings = plan.maps.front();
  for (std::vector<render::FrameView>& row : maps)
    for (render::FrameView& view : row)
      if (settings.printed > 0.0) print_letters(view, larger * settings.printed, settings.points);
  const double pixels = settings.printed > 0.0 ? 1.0 : larger;  // in print their number is fixed
  const int width = static_cast<int>(pixels * plan.width), height = static_cast<int>(pixels * plan.height);
  const render::Font font = render::embedded_font();
  return height == 0 ? panel_sheet(maps, title, width, render::largest_side, font)
                     : panel_sheet_of_size(maps, title, width, height, font);
}

/// Returns the panel of a plan. If it does not fit, the error names a size that is large enough.
render::Sheet fitting_sheet(const Rows& maps, const std::string& title, const MapPlan& plan) {
  const auto sheet_at = [&](double larger) -> std::optional<render::Sheet> {
    try {
      return sheet_of_plan(maps, title, plan, larger);
    } catch (const Error&) {
      return std::nullopt;
    }
  };
  if (std::optional<render::Sheet> sheet = sheet_at(1.0)) return *sheet;
  for (double larger = 1.05; larger < 8.0; larger *= 1.05)
    if (sheet_at(larger))
      throw Error(ExitCode::usage, "{}: {} and their texts do not fit next to each other; use {}",
                  size_text(plan, 1.0), counted(plan.maps.size(), "map"), size_text(plan, larger));
  return sheet_of_plan(maps, title, plan, 1.0);  // throws
}

}  // namespace

void check_panel(const std::string& path, const MapPlan& plan, const PanelRequest& asked) {
  const io::RunFile file = io::RunFile::open(path);
  if (file.frame_count() == 0 || plan.crop) return;  // what is seen is known when all frames are read
  PictureSeries series;
  series.plan = plan;
  series.run = file.header();
  series.extent = bed_extent(series.run.statics);
  settle_theta_c(series.plan, find_value(file.checkpoint().results, "theta_c").value_or(not_known));
  const Frame first = as_mapped(series, file.frame(0));
  extend(series.extent, {first, series.run.statics});
  std::vector<render::FrameView> row;
  for (std::size_t map = 0; map < plan.maps.size(); ++map)
    row.push_back(picture(series, 0, first, nullptr, map));
  fitting_sheet(Rows(asked.at.size() == 1 ? 1 : 2, row), asked.title, plan);
}

std::size_t draw_panel(DrawnRun& run, const PanelRequest& asked) {
  const MapPlan& plan = run.series.plan;
  const FrameChoice choice = asked.at.empty() ? usual_frames(run)
                                              : frames_at(run.file.frame_tilts(), asked.at, run.theta_c(),
                                                          run.file.all_frame_tilts().size());
  fit_to_frames(run, choice);
  const Rows maps = panel_maps(run, choice);
  write_sheet(asked.output, fitting_sheet(maps, asked.title, plan), plan,
              picture_texts(panel_source(run.series, choice)));
  return choice.size();
}

}  // namespace talus::pictures
