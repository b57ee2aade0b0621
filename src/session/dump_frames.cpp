#include "session/dump_frames.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/visible_text.h"
#include "session/table_columns.h"

namespace talus::session {
namespace {

constexpr double max_atoms = 1e9;

/// Text that is read line by line.
struct DumpText {
  TablePlace place;
  std::string_view rest;

  bool at_end() const { return rest.empty(); }
  std::string_view next() {
    ++place.line;
    return take_line(rest);
  }
  [[noreturn]] void refuse(std::string_view found, const std::string& expected) const {
    place.refuse(1, fmt::format("\"{}\": expected {}", visible_word(found), expected));
  }
};

std::vector<double> numbers_in(std::string_view line) {
  std::vector<double> numbers;
  for (const TableCell& cell : cells_of(line, false)) {
    const std::optional<double> number = number_in(cell.text);
    if (!number || !std::isfinite(*number)) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

std::optional<std::size_t> count_in(std::string_view line) {
  const std::vector<double> numbers = numbers_in(line);
  if (numbers.size() != 1 || numbers[0] < 0.0 || numbers[0] > max_atoms ||
      numbers[0] != std::floor(numbers[0]))
    return std::nullopt;
  return static_cast<std::size_t>(numbers[0]);
}

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t") == std::string_view::npos; }

/// Stores the start of the rows of a frame, and skips them.
void skip_rows(DumpText& text, DumpFrame& frame) {
  frame.rows = text.rest;
  while (frame.found < frame.count && !text.at_end() && !text.rest.starts_with("ITEM:")) {
    text.next();
    ++frame.found;
  }
}

void read_box(DumpText& text, std::string_view head, DumpFrame& frame) {
  const auto flags = cells_of(head, false);  // ITEM: BOX BOUNDS [xy xz yz] pp ff pp
  frame.periodic = flags.size() < 4 || std::ranges::find(flags, "pp", &TableCell::text) != flags.end();
  if (flags.size() == 6) frame.periodic = flags[3].text == "pp";
  frame.has_box = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string_view line = text.next();
    const std::vector<double> bounds = numbers_in(line);
    const bool is_skew = bounds.size() == 3 && bounds[2] != 0.0;
    if (bounds.size() < 2 || bounds.size() > 3 || is_skew || bounds[1] < bounds[0])
      text.refuse(line, "the two bounds of a box at right angles, the lower one first");
    frame.low.at(k) = bounds[0];
    frame.high.at(k) = bounds[1];
  }
}

std::optional<scenario::LengthUnit> unit_of_style(std::string_view style) {
  if (style == "si") return scenario::LengthUnit::metre;
  if (style == "cgs") return scenario::LengthUnit::centimetre;
  if (style == "micro") return scenario::LengthUnit::micrometre;
  return std::nullopt;
}

std::vector<DumpFrame> lammps_frames(DumpText text) {
  std::vector<DumpFrame> frames;
  std::optional<scenario::LengthUnit> unit;
  while (!text.at_end()) {
    const std::string_view line = text.next();
    if (is_blank(line)) continue;
    if (line.starts_with("ITEM: TIMESTEP")) {
      const std::string_view step = text.next();
      frames.emplace_back().label = "timestep " + visible_word(step);
      frames.back().unit = unit;
    } else if (line.starts_with("ITEM: UNITS")) {
      unit = unit_of_style(text.next());  // given once, before the first frame
    } else if (!line.starts_with("ITEM: ")) {
      text.refuse(line, "a line that starts with ITEM:, as in a dump of LAMMPS");
    } else if (!frames.empty() && line.starts_with("ITEM: NUMBER OF ATOMS")) {
      const std::string_view count = text.next();
      if (const auto atoms = count_in(count))
        frames.back().count = *atoms;
      else
        text.refuse(count, "the number of atoms");
    } else if (!frames.empty() && line.starts_with("ITEM: BOX BOUNDS")) {
      read_box(text, line, frames.back());
    } else if (!frames.empty() && line.starts_with("ITEM: ATOMS")) {
      constexpr std::string_view head = "ITEM: ATOMS";
      frames.back().names =
          std::string(head.size(), ' ').append(line.substr(head.size()));  // keeps the columns of the names
      frames.back().names_line = text.place.line;
      skip_rows(text, frames.back());
    } else {
      text.next();  // skips ITEM: TIME, which precedes the frame
    }
  }
  return frames;
}

/// Returns the value after `key=` in the second line of a frame of extended XYZ, without quotes.
std::string_view value_of_entry(std::string_view line, std::string_view key) {
  for (auto at = line.find(key); at != std::string_view::npos; at = line.find(key, at + 1)) {
    const std::string_view rest = line.substr(at + key.size());
    if (!rest.starts_with('=') || (at > 0 && line[at - 1] != ' ' && line[at - 1] != '\t')) continue;
    const bool quoted = rest.substr(1).starts_with('"');
    const std::string_view value = rest.substr(quoted ? 2 : 1);
    return value.substr(0, value.find_first_of(quoted ? "\"" : " \t"));
  }
  return {};
}

/// Returns "species x y z radius" for "species:S:1:pos:R:3:radius:R:1"; empty if the text is invalid.
std::string names_of_properties(std::string_view properties) {
  std::string names;
  while (!properties.empty()) {
    std::array<std::string_view, 3> parts;
    for (std::string_view& part : parts) {
      part = properties.substr(0, properties.find(':'));
      properties.remove_prefix(std::min(properties.size(), part.size() + 1));
    }
    const auto width = count_in(parts[2]);
    if (!width || *width < 1 || *width > 100) return {};
    for (std::size_t k = 0; k < *width; ++k)
      names += parts[0] == "pos" && *width == 3 ? fmt::format(" {}", "xyz"[k])
               : *width == 1                    ? fmt::format(" {}", parts[0])
                                                : fmt::format(" {}.{}", parts[0], k + 1);
  }
  return names.empty() ? names : names.substr(1);
}

std::vector<DumpFrame> xyz_frames(DumpText text) {
  std::vector<DumpFrame> frames;
  while (!text.at_end()) {
    const std::string_view count = text.next();
    if (is_blank(count)) continue;
    const auto atoms = count_in(count);
    if (!atoms) text.refuse(count, "the number of atoms of the next frame, as in extended XYZ");
    DumpFrame& frame = frames.emplace_back();
    frame.count = *atoms;
    const std::string_view line = text.next();
    frame.names = names_of_properties(value_of_entry(line, "Properties"));
    frame.names_line = text.place.line;
    if (frame.names.empty())
      text.refuse(line, "Properties=, such as Properties=species:S:1:pos:R:3:radius:R:1 of extended XYZ");
    if (const std::vector<double> box = numbers_in(value_of_entry(line, "Lattice")); box.size() == 9) {
      if (box[1] != 0.0 || box[3] != 0.0) text.refuse(line, "a box (Lattice) at right angles to x");
      const std::vector<double> origin = numbers_in(value_of_entry(line, "Origin"));
      const std::string_view pbc = value_of_entry(line, "pbc");
      frame.has_box = true;
      frame.periodic = pbc.empty() || pbc.starts_with('T') || pbc.starts_with('1');
      for (std::size_t k = 0; k < 3; ++k) {
        frame.low.at(k) = origin.size() == 3 ? origin[k] : 0.0;
        frame.high.at(k) = frame.low.at(k) + box[4 * k];
      }
    }
    skip_rows(text, frame);
  }
  return frames;
}

}  // namespace

std::vector<DumpFrame> dump_frames(std::string_view text, const std::string& name) {
  std::string_view rest = text;
  const std::string_view first = take_line(rest), second = take_line(rest);
  if (first.starts_with("ITEM:")) return lammps_frames({{name, 0}, text});
  const bool is_xyz = count_in(first) && (second.find("Properties=") != std::string_view::npos ||
                                          second.find("Lattice=") != std::string_view::npos);
  return is_xyz ? xyz_frames({{name, 0}, text}) : std::vector<DumpFrame>();
}

}  // namespace talus::session
