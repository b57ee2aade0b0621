#include "session/bed_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/core.h>
#include <numeric>

#include "base/errors.h"
#include "base/paths.h"
#include "contact/detection.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "session/bed_table.h"

namespace talus::session {
namespace {

constexpr std::size_t most_grains = 2'000'000;
constexpr std::uintmax_t largest_table = std::uintmax_t{1} << 30;  // bytes

/// Two lengths of a run that are the same, but for the single precision in which a file may store them.
constexpr double same_length = 1e-6;

/// Grains as they were read, and where each of them stands.
struct FileGrains {
  std::string path;
  std::size_t frame = 0;           ///< of a run
  std::vector<std::size_t> lines;  ///< of a table
  std::vector<Vec2> centres;       ///< m
  std::vector<double> radii;       ///< m

  bool is_table() const { return !lines.empty(); }

  std::string name_of(Index grain) const {
    return is_table() ? fmt::format("the grain in line {}", lines[static_cast<std::size_t>(grain)])
                      : fmt::format("grain {}", grain);
  }

  /// `message` goes on after "the grain": "overlaps ...".
  [[noreturn]] void refuse(Index grain, const std::string& message) const {
    if (is_table())
      throw LocatedError(ExitCode::bad_data, fmt::format("{}:{}:1: error: the grain {}", path,
                                                         lines[static_cast<std::size_t>(grain)], message));
    throw Error(ExitCode::bad_data, fmt::format("{}: frame {}: {} {}", path, frame, name_of(grain), message));
  }
};

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  throw Error(ExitCode::bad_data, fmt::format("{}: {}", path, message));
}

/// Where there is no such file: a run is replayed from its scenario, so the message says what it is needed
/// for.
[[noreturn]] void refuse_missing(const std::string& message) {
  throw Error(ExitCode::missing_input,
              message +
                  "; the scenario takes its bed from this file (deposition.file, relative to the working "
                  "directory), which is needed to begin a run or to replay it, not to resume it");
}

/// A length of a run against that of the scenario.
void compare(const std::string& path, const std::string& what, double found, const std::string& key,
             double expected) {
  if (std::fabs(found - expected) > same_length * expected)
    refuse(path,
           fmt::format("{} of the run is {:.6g} m, but {} makes it {:.6g} m; give the scenario the values of "
                       "the run (talus info)",
                       what, found, key, expected));
}

io::RunFile open_run(const std::string& path) {
  try {
    return io::RunFile::open(path);
  } catch (const Error& error) {
    if (error.code() == ExitCode::missing_input) refuse_missing(error.what());
    throw;
  }
}

FileGrains read_run(const std::string& path, std::size_t frame, scenario::LengthUnit unit,
                    const dynamics::BedPlan& plan) {
  if (unit != scenario::LengthUnit::mean_diameter)
    refuse(path, "a run has units of its own: expected no deposition.file_unit, or \"D\"");
  const io::RunFile run = open_run(path);
  const RunStatics& statics = run.header().statics;
  if (statics.periodic != plan.periodic)
    refuse(path, fmt::format("the run has {}: expected bed.boundary = {}",
                             statics.periodic ? "a periodic bed" : "side walls",
                             statics.periodic ? "\"periodic\"" : "\"walls\""));
  compare(path, "the mean diameter", statics.mean_diameter, "grains.mean_diameter", plan.mean_diameter);
  compare(path, plan.periodic ? "the period" : "the distance between the walls", statics.length, "bed.length",
          plan.length);
  const std::size_t frames = run.all_frame_tilts().size();
  if (frame >= frames)
    refuse(path,
           fmt::format("there is no frame {}: expected deposition.frame below {}, the number of its frames",
                       frame, frames));
  const Frame bed = run.positions(frame);
  if (bed.x.size() != statics.radius.size())
    refuse(path, fmt::format("not all grains have arrived in frame {}: choose a later one", frame));
  FileGrains grains{.path = path, .frame = frame, .lines = {}, .centres = {}, .radii = {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(statics.free_count); ++i) {
    // In single precision the period itself can be reached.
    const double x = plan.periodic && bed.x[i] >= plan.length ? bed.x[i] - plan.length : bed.x[i];
    grains.centres.push_back({x, bed.y[i]});
    grains.radii.push_back(statics.radius[i]);
  }
  return grains;
}

std::string table_text(const std::string& path) {
  std::error_code error;
  if (!is_there(path)) refuse_missing(path + ": there is no such file");
  if (!std::filesystem::is_regular_file(path, error)) refuse_missing(path + ": this is not a file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > largest_table)
    refuse(path, fmt::format("the table is too large: expected at most {} bytes", largest_table));
  const std::vector<std::byte> bytes = io::read_file(path);
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

FileGrains read_table(const std::string& path, std::size_t frame, scenario::LengthUnit unit,
                      const dynamics::BedPlan& plan) {
  const std::string text = table_text(path);
  if (frame > 0) refuse(path, "a table has no frames: expected deposition.frame = 0");
  FileGrains grains{.path = path, .frame = 0, .lines = {}, .centres = {}, .radii = {}};
  for (const TableGrain& grain : parse_bed_table(text, path, unit, plan.mean_diameter)) {
    grains.lines.push_back(grain.line);
    grains.centres.push_back({grain.x, grain.y});
    grains.radii.push_back(grain.radius);
  }
  return grains;
}

void check_sizes(const FileGrains& grains, const dynamics::BedPlan& plan) {
  const std::size_t count = grains.radii.size();
  if (count == 0) refuse(grains.path, "there is no grain: expected lines with x, y and radius");
  if (count > most_grains)
    refuse(grains.path, fmt::format("{} grains: expected at most {}", count, most_grains));
  const double mean = 2.0 * std::accumulate(grains.radii.begin(), grains.radii.end(), 0.0) /
                      (static_cast<double>(count) * plan.mean_diameter);
  if (!(std::fabs(mean - 1.0) <= mean_diameter_tolerance))
    refuse(grains.path,
           fmt::format(
               "the mean diameter of its grains is {:.6g} D: expected 1 D within {:.6g} %, with D = {:.6g} m "
               "(grains.mean_diameter){}",
               mean, 100.0 * mean_diameter_tolerance, plan.mean_diameter,
               grains.is_table() ? "; a table with lengths in mm has deposition.file_unit = \"mm\" or names "
                                   "its columns as in x [mm]"
                                 : ""));
}

void check_places(const FileGrains& grains, const dynamics::BedPlan& plan) {
  for (std::size_t i = 0; i < grains.centres.size(); ++i) {
    const double x = grains.centres[i].x / plan.mean_diameter, y = grains.centres[i].y / plan.mean_diameter;
    const double length = plan.length / plan.mean_diameter;
    const auto grain = static_cast<Index>(i);
    if (plan.periodic && !(grains.centres[i].x >= 0.0 && grains.centres[i].x < plan.length))
      grains.refuse(
          grain,
          fmt::format("is outside the period: x = {:.6g} D, expected a number in [0, {:.6g})", x, length));
    if (plan.rough_floor && !(y >= -0.5))
      grains.refuse(grain, fmt::format("is below the floor: y = {:.6g} D, expected a place above that of the "
                                       "floor grains, whose tops are at 0",
                                       y));
  }
}

/// What a grain overlaps with.
std::string body_name(const FileGrains& grains, const World& world, Index body) {
  if (body < world.grains.free_count) return grains.name_of(body);
  if (body < world.grains.count()) return "a grain of the floor";
  const Plane& plane = world.boundary.planes[static_cast<std::size_t>(body - world.grains.count())];
  if (!plane.wall) return "the floor";
  return plane.normal.x > 0.0 ? "the wall at x = 0" : "the wall at x = bed.length";
}

void check_overlaps(const FileGrains& grains, const dynamics::BedPlan& plan, const World& world) {
  contact::NeighbourList list;
  Contacts contacts;
  contact::detect_contacts(list, world.grains, world.boundary, 0.0, contacts);
  const auto deepest = std::ranges::min_element(contacts.gap);
  if (deepest == contacts.gap.end() || *deepest >= -largest_file_overlap * plan.mean_diameter) return;
  const auto c = static_cast<std::size_t>(deepest - contacts.gap.begin());
  const bool of_two = contacts.b[c] < world.grains.free_count;
  grains.refuse(
      of_two ? std::max(contacts.a[c], contacts.b[c]) : contacts.a[c],
      fmt::format("overlaps with {} by {:.6g} D: expected at most {:.6g} D",
                  body_name(grains, world, of_two ? std::min(contacts.a[c], contacts.b[c]) : contacts.b[c]),
                  -*deepest / plan.mean_diameter, largest_file_overlap));
}

}  // namespace

World bed_of_file(const std::string& path, std::size_t frame, const dynamics::BedPlan& plan,
                  scenario::LengthUnit unit) {
  const FileGrains grains =
      io::is_run(path) ? read_run(path, frame, unit, plan) : read_table(path, frame, unit, plan);
  check_sizes(grains, plan);
  check_places(grains, plan);
  World world = dynamics::empty_bed(plan);
  for (std::size_t i = 0; i < grains.centres.size(); ++i)
    add_disk(world.grains, grains.centres[i], grains.radii[i], plan.density, false);
  dynamics::add_floor(plan, world);
  check_overlaps(grains, plan, world);
  return world;
}

}  // namespace talus::session
