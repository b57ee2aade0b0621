#include "session/bed_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "base/errors.h"
#include "base/text.h"
#include "scenario/text.h"

namespace talus::session {
namespace {

/// Returns the text without its byte-order mark.
std::string_view unmarked(std::string_view text, const std::string& name) {
  constexpr std::string_view utf8 = "\xef\xbb\xbf", low_first = "\xff\xfe", high_first = "\xfe\xff";
  if (text.starts_with(low_first) || text.starts_with(high_first) ||
      text.find('\0') != std::string_view::npos)
    throw Error(ExitCode::bad_data,
                name + ": this is not a table in UTF-8: it is in UTF-16, or not text; save it as UTF-8 text");
  return text.starts_with(utf8) ? text.substr(utf8.size()) : text;
}

bool are_names(std::string_view line) {
  const auto is_number = [](const TableCell& cell) { return number_in(cell.text).has_value(); };
  return !is_number(cells_of(line, false).front()) && std::ranges::none_of(cells_of(line, true), is_number);
}

/// Returns the value of a column, in its unit.
double value_in(const TablePlace& place, const TableColumn& column, const TableCell& cell) {
  const std::optional<double> value = number_in(cell.text);
  if (value && std::isfinite(*value)) return *value;
  const bool decimal_comma = cell.text.find(',') != std::string_view::npos;
  place.refuse(cell.column, fmt::format("{} = \"{}\": expected a finite number{}, in {}", column.name,
                                        visible_word(cell.text), decimal_comma ? " with a decimal point" : "",
                                        unit_text(column.unit)));
}

void require_columns(const TablePlace& place, const TableColumns& columns,
                     const std::vector<TableCell>& cells) {
  if (cells.size() == columns.count) return;
  const std::string expected =
      columns.line == 0
          ? "three, x, y and radius, or a first line that names the columns"
          : fmt::format("{}, one for each column that line {} names", columns.count, columns.line);
  place.refuse(cells.front().column,
               fmt::format("the line has {} values: expected {}", cells.size(), expected));
}

/// Rules for reading the rows of a table.
struct TableRows {
  const LengthRule& lengths;
  TableColumns columns;
  const DumpFrame* box = nullptr;  ///< box of scaled columns; null if the table has none
};

double length_in(const TablePlace& place, const TableRows& rows, const TableColumn& column,
                 const std::vector<TableCell>& cells) {
  double value = value_in(place, column, cells[column.at]);
  if (column.scaled) {
    const std::size_t axis = column.name.front() - 'x';
    if (rows.box == nullptr || !rows.box->has_box)
      place.refuse(cells[column.at].column, fmt::format("{} needs the box (ITEM: BOX BOUNDS)", column.name));
    value = rows.box->low.at(axis) + value * (rows.box->high.at(axis) - rows.box->low.at(axis));
  }
  return rows.lengths.scale * in_metres(value, column.unit, rows.lengths.mean_diameter);
}

TableGrain grain_of(const TablePlace& place, const TableRows& rows, const std::vector<TableCell>& cells) {
  const TableColumns& columns = rows.columns;
  require_columns(place, columns, cells);
  TableGrain grain;
  grain.line = place.line;
  grain.x = length_in(place, rows, columns.x, cells);
  grain.y = length_in(place, rows, columns.height, cells);
  const double size = length_in(place, rows, columns.size, cells);
  if (size <= 0.0)
    place.refuse(cells[columns.size.at].column,
                 fmt::format("{} = {}: expected a finite number > 0, in {}", columns.size.name,
                             scenario::short_text(value_in(place, columns.size, cells[columns.size.at])),
                             unit_text(columns.size.unit)));
  grain.radius = columns.is_diameter ? 0.5 * size : size;
  if (columns.depth) grain.z = length_in(place, rows, *columns.depth, cells);
  if (columns.frame) grain.frame = value_in(place, *columns.frame, cells[columns.frame->at]);
  if (columns.id && rows.box != nullptr) grain.id = value_in(place, *columns.id, cells[columns.id->at]);
  return grain;
}

/// Returns the columns named by the last comment that names them; x, y and radius if none does.
TableColumns columns_of_comments(const std::vector<std::pair<TablePlace, std::string>>& comments,
                                 LengthUnit unit, std::size_t count) {
  for (auto comment = comments.rbegin(); comment != comments.rend(); ++comment)
    if (auto columns = columns_of_comment(comment->first, comment->second, unit, count)) return *columns;
  return {{0, "x", unit}, {1, "y", unit}, {2, "radius", unit}};
}

/// Returns "x y z r" for "format x_y_z_r", the format of YADE (export.text).
std::string column_names(std::string_view comment) {
  std::string names(comment);
  if (!names.starts_with("format ")) return names;
  std::ranges::replace(names, '_', ' ');
  return names.substr(std::string_view("format ").size());
}

std::string frame_text(int frame, std::size_t count, const std::string& label) {
  return fmt::format("frame {} of {}{}", frame < 0 ? count - 1 : static_cast<std::size_t>(frame), count,
                     label.empty() ? "" : fmt::format(" ({})", label));
}

/// Returns the index of a frame among `count`.
std::size_t chosen_frame(const std::string& name, int frame, std::size_t count) {
  if (frame < 0 && count > 0) return count - 1;
  if (static_cast<std::size_t>(frame) < count) return frame;
  throw Error(ExitCode::bad_data,
              "{}: there is no frame {}: expected deposition.frame below {}, "
              "the number of its frames, or -1 for the last",
              name, frame, count);
}

void add_remark(BedTable& table, const std::string& more) {
  table.remark += (table.remark.empty() ? "" : "; ") + more;
}

/// Selects the plane of the grains: y is the height if z is the same for all, and z if y is.
void choose_plane(BedTable& table, const TablePlace& file, const TableColumns& columns) {
  if (!columns.depth || table.grains.empty()) return;
  constexpr double same = 1e-6;  // radii
  const TableGrain& first = table.grains.front();
  const auto other = [&](double TableGrain::*coordinate) {
    return std::ranges::find_if(table.grains, [&](const TableGrain& grain) {
      return std::fabs(grain.*coordinate - first.*coordinate) > same * first.radius;
    });
  };
  const auto out_of_plane = other(&TableGrain::z);
  if (out_of_plane == table.grains.end()) return;
  if (other(&TableGrain::y) != table.grains.end())
    TablePlace{file.table, out_of_plane->line}.refuse(
        1,
        "this grain differs from others in both y and z: expected a bed of disks, with the same z (or the "
        "same y) for all; a section of a pile of spheres is not one");
  for (TableGrain& grain : table.grains) std::swap(grain.y, grain.z);
  add_remark(table, "x and z are the plane, because y is the same for all");
}

void finish(BedTable& table, const TablePlace& file, const TableRows& rows) {
  choose_plane(table, file, rows.columns);
  if (!rows.columns.ignored.empty()) add_remark(table, "ignored: " + joined(rows.columns.ignored, ", "));
}

/// A row that cannot be read.
struct BadRow {
  std::size_t grain = 0;  ///< index of a grain in its place, which only has its line and its frame
  std::string message;
};

/// Keeps only the rows of the requested frame in a table with a column `frame`: frames count in the order of
/// its values, whatever the order of the rows. Throws for a bad row of this frame.
void take_frame(BedTable& table, const std::vector<BadRow>& bad, const TableColumns& columns,
                const std::string& name, int frame) {
  if (!columns.frame && frame > 0)
    throw Error(ExitCode::bad_data, name + ": a table has no frames: expected deposition.frame = 0");
  if (!columns.frame || table.grains.empty()) return;
  std::vector<double> frames;
  for (const TableGrain& grain : table.grains) frames.push_back(grain.frame);
  std::ranges::sort(frames);
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  const double taken = frames[chosen_frame(name, frame, frames.size())];
  for (const BadRow& row : bad)
    if (table.grains[row.grain].frame == taken) throw LocatedError(ExitCode::bad_data, row.message);
  std::erase_if(table.grains, [&](const TableGrain& grain) { return grain.frame != taken; });
  if (frames.size() > 1) add_remark(table, frame_text(frame, frames.size(), ""));
}

/// Reads a row of a table with frames, in which a bad row concerns only its frame: that of the row before, if
/// its own cannot be read.
TableGrain grain_of_frame(const TablePlace& place, const TableRows& rows, const std::vector<TableCell>& cells,
                          BedTable& table, std::vector<BadRow>& bad) {
  try {
    return grain_of(place, rows, cells);
  } catch (const LocatedError& error) {
    const std::size_t at = rows.columns.frame->at;
    const std::optional<double> own = at < cells.size() ? number_in(cells[at].text) : std::nullopt;
    const bool is_first = table.grains.empty();
    if (is_first && !(own && std::isfinite(*own))) throw;
    bad.push_back({table.grains.size(), error.what()});
    TableGrain grain;
    grain.line = place.line;
    grain.frame = own && std::isfinite(*own) ? *own : table.grains.back().frame;
    return grain;
  }
}

struct UnitStyle {
  std::string_view name;
  std::optional<LengthUnit> unit;  ///< its unit of length, if it is one of these
  std::string_view length;
};
constexpr std::array unit_styles = {
    UnitStyle{"si", LengthUnit::metre, "m"},
    UnitStyle{"cgs", LengthUnit::centimetre, "cm"},
    UnitStyle{"micro", LengthUnit::micrometre, "um"},
    UnitStyle{"lj", LengthUnit::mean_diameter, "sigma, taken as D"},
    UnitStyle{"real", {}, "angstrom, file_scale = 1e-4 in um"},
    UnitStyle{"metal", {}, "angstrom, file_scale = 1e-4 in um"},
    UnitStyle{"electron", {}, "bohr, file_scale = 5.29177e-5 in um"},
    UnitStyle{"nano", {}, "nm, file_scale = 1e-3 in um"},
};

/// Returns the unit of lengths of a dump: that of the scenario, or of ITEM: UNITS if the scenario has the
/// default. Throws if the dump names units that have no equivalent here.
LengthUnit unit_of_dump(const std::string& name, const std::string& units, LengthUnit of_scenario) {
  if (of_scenario != LengthUnit::mean_diameter || units.empty()) return of_scenario;
  const auto style = std::ranges::find(unit_styles, units, &UnitStyle::name);
  if (style != unit_styles.end() && style->unit) return *style->unit;
  throw Error(ExitCode::bad_data,
              "{}: ITEM: UNITS names {}{}: expected si, cgs, micro or lj (D); set "
              "deposition.file_unit and deposition.file_scale for others",
              name, units, style != unit_styles.end() ? fmt::format(" (lengths in {})", style->length) : "");
}

/// Adds the grains in the rows of a frame.
void add_rows(BedTable& table, const DumpFrame& frame, const TableRows& rows, TablePlace& place) {
  std::string_view rest = frame.rows;
  const bool is_torn = !rest.ends_with('\n') && !rest.ends_with('\r');
  for (std::size_t k = 0; k < frame.found; ++k) {
    const std::vector<TableCell> cells = cells_of(take_row(rest, place.line), false);
    if (rest.empty() && frame.found < frame.count) break;
    if (cells.empty())
      place.refuse(1, fmt::format("the line is empty: expected grain {} of {}", k + 1, frame.count));
    if (rest.empty() && is_torn && cells.size() < rows.columns.count)
      place.refuse(1, "the line ends too early: the file is cut off; expected an earlier deposition.frame");
    table.grains.push_back(grain_of(place, rows, cells));
  }
  if (frame.found < frame.count)
    place.refuse(
        1, fmt::format("the frame ends after {} of its {} grains: {}; expected the rest, or {} "
                       "deposition.frame",
                       frame.found, frame.count, rest.empty() ? "the file is cut off" : "the rest is missing",
                       rest.empty() ? "an earlier" : "another"));
}

void refuse_repeated_ids(const BedTable& table, const std::string& name) {
  const auto twice = std::ranges::adjacent_find(table.grains, {}, &TableGrain::id);
  if (twice != table.grains.end())
    TablePlace{name, std::next(twice)->line}.refuse(
        1, fmt::format("grain {} is also in line {}: expected each id once", scenario::short_text(twice->id),
                       twice->line));
}

BedTable table_of_dump(const std::vector<DumpFrame>& frames, const std::string& name, LengthRule lengths,
                       int frame) {
  const DumpFrame& taken = frames[chosen_frame(name, frame, frames.size())];
  const auto throw_fault = [&] { throw LocatedError(ExitCode::bad_data, taken.fault); };
  if (!taken.fault.empty() && (taken.names_line == 0 || taken.fault_line <= taken.names_line)) throw_fault();
  if (taken.names_line == 0 || (taken.found < taken.count && taken.rows.empty()))
    throw Error(ExitCode::bad_data,
                "{}: {} is cut off: expected a line such as ITEM: ATOMS id x y radius, or the second "
                "line of extended XYZ; an earlier deposition.frame may be whole",
                name, frame_text(frame, frames.size(), taken.label));
  lengths.unit = unit_of_dump(name, taken.units, lengths.unit);
  TablePlace place{name, taken.names_line};
  TableRows rows{lengths, named_columns(place, taken.names, lengths.unit), &taken};
  BedTable table;
  add_rows(table, taken, rows, place);
  if (!taken.fault.empty()) throw_fault();
  std::ranges::stable_sort(table.grains, {}, &TableGrain::id);
  if (rows.columns.id) refuse_repeated_ids(table, name);
  if (frames.size() > 1) add_remark(table, frame_text(frame, frames.size(), taken.label));
  if (taken.units == "lj") add_remark(table, "its units lj taken as mean diameters D");
  finish(table, place, rows);
  if (!taken.has_box) return table;
  const auto metres = [&](double length) {
    return lengths.scale * in_metres(length, lengths.unit, lengths.mean_diameter);
  };
  table.box = {metres(taken.low[0]), metres(taken.high[0]), taken.is_periodic};
  return table;
}

}  // namespace

double in_metres(double length, LengthUnit unit, double mean_diameter) {
  constexpr double per_metre[] = {0.0, 1.0, 1e2, 1e3, 1e6};  // in the order of the units; D has none
  return unit == LengthUnit::mean_diameter ? length * mean_diameter
                                           : length / per_metre[static_cast<std::size_t>(unit)];
}

BedTable parse_bed_table(const std::string& text, const std::string& name, const LengthRule& lengths,
                         int frame) {
  std::string_view rest = unmarked(text, name);
  if (const std::vector<DumpFrame> frames = dump_frames(rest, name); !frames.empty())
    return table_of_dump(frames, name, lengths, frame);
  BedTable table;
  TablePlace place{name, 0};
  std::vector<std::pair<TablePlace, std::string>> comments;
  std::optional<TableRows> rows;
  std::vector<BadRow> bad;
  while (!rest.empty()) {
    ++place.line;
    const std::string_view line = take_line(rest);
    if (cells_of(line, false).empty()) {
      if (const std::string_view words = comment_of(line); !words.empty() && !rows)
        comments.emplace_back(place, column_names(words));
    } else if (!rows && are_names(line)) {
      rows.emplace(TableRows{lengths, named_columns(place, line, lengths.unit)});
    } else {
      if (!rows)
        rows.emplace(
            TableRows{lengths, columns_of_comments(comments, lengths.unit, cells_of(line, false).size())});
      const std::vector<TableCell> cells = cells_of(line, rows->columns.tabs);
      table.grains.push_back(rows->columns.frame ? grain_of_frame(place, *rows, cells, table, bad)
                                                 : grain_of(place, *rows, cells));
    }
  }
  if (!rows) return table;
  take_frame(table, bad, rows->columns, name, frame);
  finish(table, place, *rows);
  return table;
}

}  // namespace talus::session
