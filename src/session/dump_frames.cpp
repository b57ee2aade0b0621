#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text.h"
#include "session/bed_table.h"

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
  /// Returns the next line that is not a comment; empty at the end of the text.
  std::string_view next_row() { return take_row(rest, place.line); }
  std::string fault(std::string_view found, const std::string& expected) const {
    return place.message(1, fmt::format("\"{}\": expected {}", visible_word(found), expected));
  }
  /// Notes a fault of a frame in the line `found`, if it is its first.
  void note(DumpFrame& frame, std::string_view found, const std::string& expected) const {
    if (!frame.fault.empty()) return;
    frame.fault = fault(found, expected);
    frame.fault_line = place.line;
  }
};

bool is_comment(std::string_view line) {
  const auto begin = line.find_first_not_of(" \t");
  return begin != std::string_view::npos && line[begin] == '#';
}

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

/// Stores the start of the rows of a frame, and skips them, up to a line that begins the next frame.
void skip_rows(DumpText& text, DumpFrame& frame, bool (*begins_frame)(std::string_view rest)) {
  frame.rows = text.rest;
  while (frame.found < frame.count && !text.at_end() && !begins_frame(text.rest)) {
    text.next_row();
    ++frame.found;
  }
}

/// Returns the flag of the boundaries along x in "ITEM: BOX BOUNDS [xy xz yz] pp ff pp", if any.
std::string_view flag_along_x(std::string_view head) {
  constexpr std::array<std::string_view, 6> others = {"ITEM:", "BOX", "BOUNDS", "xy", "xz", "yz"};
  for (const TableCell& cell : cells_of(head, false))
    if (std::ranges::find(others, cell.text) == others.end()) return cell.text;
  return {};
}

void read_box(DumpText& text, std::string_view head, DumpFrame& frame) {
  if (const std::string_view flag = flag_along_x(head); !flag.empty())
    frame.is_periodic = flag.starts_with('p');
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string_view line = text.next_row();
    const std::vector<double> bounds = numbers_in(line);
    const bool is_skew = bounds.size() == 3 && bounds[2] != 0.0;
    if (bounds.size() < 2 || bounds.size() > 3 || is_skew || bounds[1] < bounds[0]) {
      if (text.at_end()) return;  // the file is cut off
      return text.note(frame, line, "the two bounds of a box at right angles, the lower one first");
    }
    frame.low.at(k) = bounds[0];
    frame.high.at(k) = bounds[1];
  }
  frame.has_box = true;
}

bool begins_item(std::string_view rest) { return rest.starts_with("ITEM:"); }

constexpr std::string_view frame_head = "ITEM: TIMESTEP";

/// Reads an item of the last frame whose head is `line`.
void read_item(DumpText& text, std::string_view line, DumpFrame& frame) {
  constexpr std::string_view head = "ITEM: ATOMS";
  if (line.starts_with("ITEM: NUMBER OF ATOMS")) {
    const std::string_view count = text.next_row();
    const auto atoms = count_in(count);
    frame.count = atoms.value_or(0);
    if (!atoms && !(count.empty() && text.at_end())) text.note(frame, count, "the number of atoms");
  } else if (line.starts_with("ITEM: BOX BOUNDS")) {
    read_box(text, line, frame);
  } else if (line.starts_with(head)) {
    frame.names = std::string(head.size(), ' ').append(line.substr(head.size()));  // keeps their columns
    frame.names_line = text.place.line;
    skip_rows(text, frame, begins_item);
  } else if (line.starts_with("ITEM: ")) {
    text.next_row();  // skips an unknown item
  } else {
    text.note(frame, line, "a line that starts with ITEM:, as in a dump of LAMMPS");
  }
}

std::vector<DumpFrame> lammps_frames(DumpText text) {
  std::vector<DumpFrame> frames;
  std::string units;
  bool next_announced = false;  // by an item that precedes its head
  const auto begin_frame = [&](std::string_view step) {
    frames.emplace_back().units = units;
    if (!step.empty()) frames.back().label = "timestep " + visible_word(step);
    next_announced = false;
  };
  const auto is_within_head = [&] { return !frames.empty() && frames.back().names_line == 0; };
  while (!text.at_end()) {
    const std::string_view line = text.next_row();
    // A file may be cut off within the head of a frame.
    const bool is_cut = text.at_end() && !line.empty() && frame_head.starts_with(line);
    if (is_blank(line)) continue;
    if (line.starts_with(frame_head) || is_cut) {
      begin_frame(text.next_row());
    } else if (line.starts_with("ITEM: UNITS")) {
      units = visible_word(text.next_row());  // given once, for all frames that follow
      if (is_within_head()) frames.back().units = units;
      next_announced = !is_within_head();
    } else if (line.starts_with("ITEM: TIME")) {
      text.next_row();
      next_announced = !is_within_head();
    } else if (line.starts_with("ITEM: NUMBER OF ATOMS") && !frames.empty() && frames.back().names_line > 0) {
      begin_frame("");
      text.note(frames.back(), line, "ITEM: TIMESTEP, the head of its frame");
      read_item(text, line, frames.back());
    } else if (!frames.empty()) {
      read_item(text, line, frames.back());
    } else if (line.starts_with("ITEM: ")) {
      text.next_row();
    } else {
      throw LocatedError(ExitCode::bad_data,
                         text.fault(line, "a line that starts with ITEM:, as in a dump of LAMMPS"));
    }
  }
  if (next_announced && !frames.empty()) begin_frame("");
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

bool is_description(std::string_view line) {
  return line.find("Properties=") != std::string_view::npos ||
         line.find("Lattice=") != std::string_view::npos;
}

/// Whether these lines begin with the two of a frame of extended XYZ.
bool begins_xyz_frame(std::string_view rest) {
  return count_in(take_line(rest)) && is_description(take_line(rest));
}

/// Reads the numbers of an entry, if there is one; returns what was expected if they are wrong.
std::string read_entry(std::string_view line, std::string_view key, std::size_t size,
                       std::vector<double>& numbers) {
  const std::string_view value = value_of_entry(line, key);
  numbers = numbers_in(value);
  if (value.data() == nullptr || numbers.size() == size) return "";
  return fmt::format("{} finite numbers in {}=\"...\"", size, key);
}

/// Reads the box in the second line of a frame; returns what was expected if it cannot be used.
std::string read_xyz_box(std::string_view line, DumpFrame& frame) {
  std::vector<double> box, origin;
  if (std::string expected = read_entry(line, "Lattice", 9, box); !expected.empty()) return expected;
  if (std::string expected = read_entry(line, "Origin", 3, origin); !expected.empty()) return expected;
  if (const std::string_view pbc = value_of_entry(line, "pbc"); pbc.data() != nullptr) {
    if (pbc.find_first_of("TtFf10") != 0) return "pbc=\"T F F\" or the like";
    frame.is_periodic = pbc.find_first_of("Tt1") == 0;
  }
  if (box.empty()) return "";
  if (box[1] != 0.0 || box[2] != 0.0 || box[3] != 0.0 || box[6] != 0.0 || box[0] <= 0.0)
    return "a box (Lattice) at right angles to x";
  frame.has_box = true;
  for (std::size_t k = 0; k < 3; ++k) {
    frame.low.at(k) = origin.empty() ? 0.0 : origin[k];
    frame.high.at(k) = frame.low.at(k) + box[4 * k];
  }
  return "";
}

std::vector<DumpFrame> xyz_frames(DumpText text) {
  constexpr const char* head = "the number of atoms of the next frame, as in extended XYZ";
  std::vector<DumpFrame> frames;
  while (!text.at_end()) {
    const std::string_view count = text.next_row();
    if (is_blank(count)) continue;
    std::string_view after = text.rest;
    const auto atoms = count_in(count);
    if (!atoms && !is_description(take_line(after)) && !frames.empty()) {  // a row too many
      text.note(frames.back(), count, head);
      continue;
    }
    DumpFrame& frame = frames.emplace_back();
    frame.count = atoms.value_or(0);
    if (!atoms) text.note(frame, count, head);
    if (text.at_end()) break;  // the file is cut off
    const std::string_view line = text.next();
    frame.names = names_of_properties(value_of_entry(line, "Properties"));
    if (!frame.names.empty()) frame.names_line = text.place.line;
    if (frame.names.empty() && !(text.at_end() && frames.size() > 1))
      text.note(frame, line,
                "Properties=, such as Properties=species:S:1:pos:R:3:radius:R:1 of extended XYZ");
    else if (const std::string expected = read_xyz_box(line, frame); !expected.empty())
      text.note(frame, line, expected);
    skip_rows(text, frame, begins_xyz_frame);
  }
  return frames;
}

}  // namespace

std::string_view take_row(std::string_view& rest, std::size_t& line) {
  std::string_view row;
  do {
    ++line;
    row = take_line(rest);
  } while (is_comment(row) && !rest.empty());
  return is_comment(row) ? std::string_view() : row;
}

std::vector<DumpFrame> dump_frames(std::string_view text, const std::string& name) {
  std::string_view rest = text;
  std::size_t line = 0;
  const std::string_view first = take_row(rest, line), second = take_line(rest);
  if (first.starts_with("ITEM:")) return lammps_frames({{name, 0}, text});
  const bool is_xyz = count_in(first) && is_description(second);
  return is_xyz ? xyz_frames({{name, 0}, text}) : std::vector<DumpFrame>();
}

}  // namespace talus::session
