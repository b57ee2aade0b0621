#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/core.h>
#include <numeric>

#include "base/errors.h"
#include "base/output_file.h"
#include "contact/detection.h"
#include "dynamics/bed.h"
#include "io/durable_file.h"
#include "io/run_file.h"
#include "io/run_store.h"
#include "session/bed_table.h"
#include "session/deposition.h"

namespace talus::session {
namespace {

constexpr std::size_t max_grains = 2'000'000;
constexpr std::uintmax_t largest_table = std::uintmax_t{1} << 30;  // bytes

/// Relative tolerance for equal lengths, which a file may store in single precision.
constexpr double same_length = 1e-6;

/// Grains read from a file, and their positions in it.
struct FileGrains {
  std::string path;
  std::size_t frame = 0;           ///< frame of a run
  std::vector<std::size_t> lines;  ///< line of each grain in a table
  std::vector<Vec2> centres;       ///< m
  std::vector<double> radii;       ///< m
  std::string remark{};
  std::string box{};  ///< end of a message about a place, on a box of a dump that was not shifted

  bool is_table() const { return !lines.empty(); }

  std::string name_of(Index grain) const {
    return is_table() ? fmt::format("the grain in line {}", lines[grain]) : fmt::format("grain {}", grain);
  }

  /// Throws; `message` continues after "the grain": "overlaps ...".
  [[noreturn]] void refuse(Index grain, const std::string& message) const {
    if (is_table())
      throw LocatedError(ExitCode::bad_data, "{}:{}:1: error: the grain {}", path, lines[grain], message);
    throw Error(ExitCode::bad_data, "{}: frame {}: {} {}", path, frame, name_of(grain), message);
  }
};

[[noreturn]] void refuse(const std::string& path, const std::string& message) {
  throw Error(ExitCode::bad_data, "{}: {}", path, message);
}

/// Throws for a missing file. A run is also replayed from its scenario, so the message states what the file
/// is needed for.
[[noreturn]] void refuse_missing(const std::string& message) {
  throw Error(ExitCode::missing_input,
              message +
                  "; the scenario takes its bed from this file (deposition.file, relative to the working "
                  "directory), which is needed to start or replay a run, but not to resume it");
}

/// Throws if a length of a run differs from that of the scenario.
void compare(const std::string& path, const std::string& what, double found, const std::string& key,
             double expected) {
  if (std::fabs(found - expected) > same_length * expected)
    refuse(path, fmt::format("{} of the run is {:.6g} m, but {} makes it {:.6g} m; use the values of the run "
                             "in the scenario (talus info)",
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

FileGrains read_run(const BedFile& file, const dynamics::BedPlan& plan) {
  const std::string& path = file.path;
  if (file.unit != LengthUnit::mean_diameter)
    refuse(path, "a run states its own units: expected no deposition.file_unit, or \"D\"");
  if (file.scale != 1.0) refuse(path, "a run states its own units: expected no deposition.file_scale, or 1");
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
  const std::size_t frame =
      file.frame >= 0 ? static_cast<std::size_t>(file.frame) : std::max<std::size_t>(frames, 1) - 1;
  if (frame >= frames)
    refuse(path,
           fmt::format("there is no frame {}: expected deposition.frame below {}, the number of its frames",
                       frame, frames));
  const Frame bed = run.positions(frame);
  if (bed.x.size() != statics.radius.size())
    refuse(path, fmt::format("not all grains have arrived in frame {}: choose a later one", frame));
  FileGrains grains{.path = path, .frame = frame, .lines = {}, .centres = {}, .radii = {}};
  for (std::size_t i = 0; i < static_cast<std::size_t>(statics.free_count); ++i) {
    // In single precision x may equal the period.
    const double x = plan.periodic && bed.x[i] >= plan.length ? bed.x[i] - plan.length : bed.x[i];
    grains.centres.push_back({x, bed.y[i]});
    grains.radii.push_back(statics.radius[i]);
  }
  return grains;
}

std::string table_text(const std::string& path) {
  if (!is_there(path)) refuse_missing(path + ": there is no such file");
  if (!is_file(path)) refuse_missing(path + ": this is not a file");
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > largest_table)
    refuse(path, fmt::format("the table is too large: expected at most {} bytes", largest_table));
  return io::read_text(path);
}

constexpr double same_box = 1e-4;  // relative tolerance for the length of a box

bool has_length(const TableBox& box, double length) {
  return std::fabs(box.high - box.low - length) <= same_box * length;
}

/// Throws if the box of a dump contradicts the boundary of the plan.
void check_box(const BedFile& file, const TableBox& box, const dynamics::BedPlan& plan) {
  if (box.is_periodic && plan.periodic != *box.is_periodic)
    refuse(file.path,
           fmt::format("its box is {} along x: expected bed.boundary = {}",
                       plan.periodic ? "not periodic" : "periodic",
                       plan.periodic ? "\"walls\", or a box with the flags pp (pbc=\"T ...\")"
                                     : "\"periodic\", or a box with the flags ff (pbc=\"F ...\")"));
  if (plan.periodic && !has_length(box, plan.length))
    refuse(file.path,
           fmt::format("its periodic box is {:.6g} D long: expected bed.length = {:.6g} D; check "
                       "deposition.file_unit and deposition.file_scale",
                       (box.high - box.low) / plan.mean_diameter, plan.length / plan.mean_diameter));
}

/// Describes the box of a dump that is not the room between the walls, for a message about a grain.
std::string box_text(const TableBox& box, const dynamics::BedPlan& plan) {
  return fmt::format(
      "; the box of the file is from {:.6g} to {:.6g} D along x: one of bed.length = {:.6g} D would be "
      "shifted to begin at 0",
      box.low / plan.mean_diameter, box.high / plan.mean_diameter, plan.length / plan.mean_diameter);
}

FileGrains read_table(const BedFile& file, const dynamics::BedPlan& plan) {
  BedTable table = parse_bed_table(table_text(file.path), file.path,
                                   {file.unit, plan.mean_diameter, file.scale}, file.frame);
  if (table.box) check_box(file, *table.box, plan);
  const std::size_t floor_grains = std::erase_if(table.grains, [&](const TableGrain& grain) {
    return std::fabs(grain.y + grain.radius) <= 1e-3 * plan.mean_diameter;
  });
  FileGrains grains{file.path, 0, {}, {}, {}, std::move(table.remark)};
  const bool is_room = table.box && has_length(*table.box, plan.length);
  const double begin = is_room ? table.box->low : 0.0;
  if (table.box && !is_room) grains.box = box_text(*table.box, plan);
  if (floor_grains > 0)
    grains.remark += fmt::format("{}{} grains with their tops at y = 0 left out as the floor",
                                 grains.remark.empty() ? "" : "; ", floor_grains);
  for (const TableGrain& grain : table.grains) {
    // Coordinates of a dump may be unwrapped, and x may equal the period in single precision.
    const double turns = is_room && plan.periodic ? std::floor((grain.x - begin) / plan.length) : 0.0;
    const double x = grain.x - begin - turns * plan.length;
    grains.lines.push_back(grain.line);
    grains.centres.push_back({turns != 0.0 && x >= plan.length ? 0.0 : x, grain.y});
    grains.radii.push_back(grain.radius);
  }
  return grains;
}

/// Returns the unit for which the mean diameter would be right, as the end of a message; or general advice.
std::string meant_unit(double mean, const dynamics::BedPlan& plan) {
  for (const auto& [unit, name] :
       {std::pair{LengthUnit::metre, "m"}, std::pair{LengthUnit::centimetre, "cm"},
        std::pair{LengthUnit::millimetre, "mm"}, std::pair{LengthUnit::micrometre, "um"}})
    if (std::fabs(in_metres(mean, unit, 1.0) / plan.mean_diameter - 1.0) <= mean_diameter_tolerance)
      return fmt::format("; it fits with deposition.file_unit = \"{}\"", name);
  return "; for a table in mm, set deposition.file_unit = \"mm\" or name its columns as in x [mm]";
}

void check_sizes(const FileGrains& grains, const dynamics::BedPlan& plan) {
  const std::size_t count = grains.radii.size();
  if (count == 0) refuse(grains.path, "no grains: expected lines with x, y and radius");
  if (count > max_grains)
    refuse(grains.path, fmt::format("{} grains: expected at most {}", count, max_grains));
  const double mean = 2.0 * std::accumulate(grains.radii.begin(), grains.radii.end(), 0.0) /
                      (static_cast<double>(count) * plan.mean_diameter);
  if (!(std::fabs(mean - 1.0) <= mean_diameter_tolerance))
    refuse(grains.path, fmt::format("the mean diameter of its grains is {:.6g} D: expected 1 D within {:.6g} "
                                    "%, with D = {:.6g} m (grains.mean_diameter){}",
                                    mean, 100.0 * mean_diameter_tolerance, plan.mean_diameter,
                                    grains.is_table() ? meant_unit(mean, plan) : ""));
}

/// Throws for the first grain that no run can store.
void check_bounds(const FileGrains& grains, double depth, const dynamics::BedPlan& plan) {
  const double d = plan.mean_diameter, farthest = io::farthest_place(plan.length, depth, d);
  for (std::size_t i = 0; i < grains.centres.size(); ++i) {
    const Index grain = i;
    if (const double radius = grains.radii[i];
        !(radius >= io::smallest_radius * d && radius <= io::largest_radius * d))
      grains.refuse(grain, fmt::format("has a radius of {:.6g} D: expected {:.6g} to {:.6g} D", radius / d,
                                       io::smallest_radius, io::largest_radius));
    const auto [x, y] = grains.centres[i];
    if (!(std::fabs(x) <= farthest && std::fabs(y) <= farthest))
      grains.refuse(grain, fmt::format("is at x = {:.6g} D, y = {:.6g} D: expected at most {:.6g} D from the "
                                       "origin, ten thousand times bed.length + bed.depth{}",
                                       x / d, y / d, farthest / d, grains.box));
  }
}

void check_places(const FileGrains& grains, const dynamics::BedPlan& plan) {
  for (std::size_t i = 0; i < grains.centres.size(); ++i) {
    const double x = grains.centres[i].x / plan.mean_diameter, y = grains.centres[i].y / plan.mean_diameter;
    const double length = plan.length / plan.mean_diameter;
    const Index grain = i;
    if (plan.periodic && !(grains.centres[i].x >= 0.0 && grains.centres[i].x < plan.length))
      grains.refuse(
          grain,
          fmt::format("is outside the period: x = {:.6g} D, expected a number in [0, {:.6g})", x, length));
    if (plan.rough_floor && !(y >= -0.5))
      grains.refuse(grain, fmt::format("is below the floor: y = {:.6g} D, expected a position above the "
                                       "floor grains, whose tops are at 0",
                                       y));
  }
}

/// Returns the name of the body that a grain overlaps with.
std::string body_name(const FileGrains& grains, const World& world, Index body) {
  if (body < world.grains.free_count) return grains.name_of(body);
  if (body < world.grains.count()) return "a grain of the floor";
  const Plane& plane = world.boundary.planes[body - world.grains.count()];
  if (!plane.wall) return "the floor";
  return plane.normal.x > 0.0 ? "the wall at x = 0" : "the wall at x = bed.length";
}

void check_overlaps(const FileGrains& grains, bool relax, const dynamics::BedPlan& plan, const World& world) {
  const double most = relax ? largest_soft_overlap : largest_file_overlap;
  contact::NeighbourList list;
  Contacts contacts;
  contact::detect_contacts(list, world.grains, world.boundary, 0.0, contacts);
  const auto deepest = std::ranges::min_element(contacts.gap);
  if (deepest == contacts.gap.end() || *deepest >= -most * plan.mean_diameter) return;
  const std::size_t c = deepest - contacts.gap.begin();
  const bool is_soft = !relax && *deepest >= -largest_soft_overlap * plan.mean_diameter;
  const bool of_two = contacts.b[c] < world.grains.free_count;
  grains.refuse(
      of_two ? std::max(contacts.a[c], contacts.b[c]) : contacts.a[c],
      fmt::format("overlaps with {} by {:.6g} D: expected at most {:.6g} D{}{}",
                  body_name(grains, world, of_two ? std::min(contacts.a[c], contacts.b[c]) : contacts.b[c]),
                  -*deepest / plan.mean_diameter, most,
                  is_soft ? "; deposition.relax = true pushes overlaps of up to 0.1 D apart" : "",
                  of_two ? "" : grains.box));
}

}  // namespace

World bed_of_file(const BedFile& file, const dynamics::BedPlan& plan, std::string* remark) {
  FileGrains grains = io::is_run(file.path) ? read_run(file, plan) : read_table(file, plan);
  check_sizes(grains, plan);
  check_bounds(grains, file.depth, plan);
  check_places(grains, plan);
  World world = dynamics::empty_bed(plan);
  for (std::size_t i = 0; i < grains.centres.size(); ++i)
    add_disk(world.grains, grains.centres[i], grains.radii[i], plan.density, false);
  dynamics::add_floor(plan, world);
  check_overlaps(grains, file.relax, plan, world);
  if (file.relax) {
    const dynamics::Displacement moved = dynamics::push_apart(world, relaxed_overlap * plan.mean_diameter);
    grains.remark +=
        fmt::format("{}overlaps pushed apart, which moved grains by {:.2g} D on average, {:.2g} D at most",
                    grains.remark.empty() ? "" : "; ", moved.mean / plan.mean_diameter,
                    moved.largest / plan.mean_diameter);
    check_overlaps(grains, false, plan, world);
  }
  if (remark != nullptr && !grains.remark.empty()) *remark = fmt::format("{}: {}", file.path, grains.remark);
  return world;
}

}  // namespace talus::session
