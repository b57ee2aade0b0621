#include "pictures/panel.h"

#include <algorithm>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "pictures/frame_choice.h"
#include "pictures/picture_files.h"

namespace talus::pictures {
namespace {

using Rows = std::vector<std::vector<render::FrameView>>;

/// Splits a text at commas, and joins parts again.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(", ", start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 2;
  }
  return parts;
}

std::string text_of(const std::vector<std::string>& parts) {
  return joined(parts, ", ", [](const std::string& part) { return part; });
}

/// Removes and returns the parts with which all texts begin.
std::string extract_common_beginning(const std::vector<std::string*>& texts) {
  std::vector<std::string> common = parts_of(*texts.front());
  for (const std::string* text : texts) {
    const std::vector<std::string> parts = parts_of(*text);
    common.erase(std::ranges::mismatch(common, parts).in1, common.end());
  }
  for (std::string* text : texts) {
    std::vector<std::string> parts = parts_of(*text);
    parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(common.size()));
    *text = text_of(parts);
  }
  return text_of(common);
}

/// Removes from the captions, and returns, everything after the first part: the angle of repose, which is the
/// same for the run.
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

/// Whether every entry of these legends also appears in the others.
bool are_in(const std::vector<render::Legend>& these, const std::vector<render::Legend>& others) {
  const auto is_in = [&others](const auto& one, auto render::Legend::*parts, const auto& same) {
    return std::ranges::any_of(others, [&](const render::Legend& legend) {
      return std::ranges::any_of(legend.*parts, [&](const auto& other) { return same(one, other); });
    });
  };
  const auto same_bar = [](const render::Bar& x, const render::Bar& y) {
    return x.title == y.title && x.low == y.low && x.high == y.high && x.colours == y.colours;
  };
  const auto same_swatch = [](const render::Swatch& x, const render::Swatch& y) {
    return x.label == y.label;  // a spanning cluster has the colour of one of them
  };
  return std::ranges::all_of(these, [&](const render::Legend& legend) {
    return std::ranges::all_of(
               legend.bars, [&](const auto& bar) { return is_in(bar, &render::Legend::bars, same_bar); }) &&
           std::ranges::all_of(legend.swatches, [&](const auto& swatch) {
             return is_in(swatch, &render::Legend::swatches, same_swatch);
           });
  });
}

/// Reduces repeated furniture. A legend appears only below the last angle, unless that of another angle
/// differs, and once for maps with equal legends; the scale bar appears below the last map; the angle appears
/// at the first map of each row.
void share_furniture(Rows& maps) {
  for (std::vector<render::FrameView>& row : maps) {
    const bool last = &row == &maps.back();
    for (std::size_t map = 0; map < row.size(); ++map) {
      if (!last || map + 1 < row.size()) row[map].scale_label.clear();
      if (map > 0 && row[map].caption == row[0].caption) row[map].caption.clear();
      if (!last && are_in(row[map].legends, maps.back()[map].legends)) row[map].legends.clear();
    }
  }
  std::vector<render::FrameView>& last = maps.back();
  for (std::size_t map = last.size(); map-- > 1;)
    for (std::size_t before = 0; before < map; ++before)
      if (are_in(last[map].legends, last[before].legends)) last[map].legends.clear();
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

std::string panel_source(const PictureSeries& series, const FrameChoice& choice) {
  const std::string angles =
      joined(choice, ", ", [&](std::size_t k) { return tilt_text(series.seen_frames.instants[k].tilt); });
  const std::string maps =
      joined(series.plan.maps, " ", [](const MapSettings& map) { return layers_name(map.layers); });
  return picture_source(series.path, fmt::format("frames at {} deg, {}", angles, maps));
}

}  // namespace

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
                fmt::format("the picture would be {} px high; at most {} px are possible: ask for a "
                            "smaller width, or for fewer angles",
                            best.height, render::largest_side));
  return best;
}

std::size_t draw_panel(DrawnRun& run, const PanelRequest& asked) {
  const FrameChoice choice = frames_at(run.file.frame_tilts(), asked.at, run.theta_c());
  fit_to_frames(run, choice);
  const render::Sheet sheet = panel_sheet(panel_maps(run, choice), asked.title, run.series.plan.width,
                                          render::largest_side, render::embedded_font());
  write_sheet(asked.output, sheet, run.series.plan, picture_texts(panel_source(run.series, choice)));
  return choice.size();
}

}  // namespace talus::pictures
