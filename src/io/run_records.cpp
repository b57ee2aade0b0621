#include "io/run_records.h"

#include <cmath>
#include <fmt/core.h>
#include <utility>

#include "base/hash.h"
#include "base/text.h"
#include "io/run_schema.h"
#include "scenario/scenario.h"

namespace talus::io {

namespace {

constexpr std::int8_t free_species = 0;
constexpr std::int8_t floor_species = 1;

constexpr const char* friction_of_grains = "/parameters/friction";
constexpr const char* edges = "/particles/grains/box/edges";
constexpr Range diameters = {1e-9, 1e9};

Range lengths_of_bed(double d) { return {0.1 * d, 1e6 * d}; }

/// Visits the static data. Their ratios to the diameter d, m, are limited, because they size grids.
template <typename Statics, typename Direction>
void for_each_field(Statics& statics, double d, Direction direction) {
  Fields fields{direction};
  fields.array("/particles/grains/radius", statics.radius, Range{smallest_radius * d, largest_radius * d});
  fields.array("/particles/grains/mass", statics.mass, not_negative);
  fields.scalar("/parameters/periodic", statics.periodic);
  fields.scalar("/parameters/mean_diameter", statics.mean_diameter, diameters);
  fields.scalar("/parameters/gravity", statics.gravity, not_negative);
}

void write_statics(Writer& writer, const RunStatics& statics) {
  const std::size_t count = statics.radius.size();
  std::vector<Index> ids(count);
  std::vector<std::int8_t> species(count, floor_species);
  for (std::size_t i = 0; i < count; ++i) ids[i] = static_cast<Index>(i);
  std::fill_n(species.begin(), statics.free_count, free_species);
  if (statics.free_count < 1) RecordCheck().refuse("/particles/grains/species", "has no free grain");
  FileWriter{writer}.put(edges, std::vector{statics.length, statics.depth},
                         lengths_of_bed(statics.mean_diameter));
  writer.write("/particles/grains/id", ids);
  writer.write("/particles/grains/species", species);
  for_each_field(statics, statics.mean_diameter, FileWriter{writer});
}

Index free_grains(Reader& reader) {
  const std::string path = "/particles/grains/species";
  const auto species = reader.read<std::int8_t>(path, Range{free_species, floor_species});
  const auto floor_begin = std::ranges::find(species, floor_species);
  if (std::any_of(floor_begin, species.end(), [](std::int8_t kind) { return kind != floor_species; }))
    reader.refuse(path, "has a free grain after a floor grain");
  if (floor_begin == species.begin()) reader.refuse(path, "has no free grain");
  return static_cast<Index>(floor_begin - species.begin());
}

RunStatics read_statics(Reader& reader) {
  RunStatics statics;
  statics.free_count = free_grains(reader);
  const double d = reader.read_scalar<double>("/parameters/mean_diameter", diameters);
  const std::vector<double> lengths = reader.read<double>(edges, lengths_of_bed(d));
  statics.length = lengths.at(0);
  statics.depth = lengths.at(1);
  for_each_field(statics, d, FileReader{reader});
  return statics;
}

/// Reads the coefficients of friction, most of which only the scenario of the run states.
void read_friction(Reader& reader, RunHeader& header) {
  const std::string path = "/parameters/scenario_resolved";
  try {
    const scenario::Scenario scenario = scenario::parse_scenario(header.scenario_resolved, path);
    header.friction = scenario::friction(scenario);
    header.deposition_friction = scenario::deposition_friction(scenario);
  } catch (const Error& error) {
    reader.refuse(path, std::string("is not a scenario: ") + error.what());
  }
  header.friction.grains = reader.read_scalar<double>(friction_of_grains, not_negative);
}

/// Whether `inverse` is the inverse of a mass, or 0 for a grain of the floor.
bool is_inverse(double inverse, double value, bool free) {
  return free ? std::abs(inverse * value - 1.0) < 1e-9 : inverse == 0.0;
}

/// Checks that the state from which a branch begins belongs to the bed of the run.
void check_branch(const RecordCheck& record, const World& start, const RunStatics& statics) {
  const Grains& grains = start.grains;
  const auto require = [&record](bool holds, const char* name) {
    if (!holds) record.refuse(std::string("/branch/").append(name), "is not that of the bed of the run");
  };
  require(grains.radius == statics.radius, "radius");
  require(grains.mass == statics.mass, "mass");
  require(grains.free_count == statics.free_count, "free_count");
  require(start.gravity == statics.gravity, "gravity");
  require(start.boundary.periodic == statics.periodic, "periodic");
  require(start.boundary.length == statics.length, "length");
  for (std::size_t i = 0; i < grains.mass.size(); ++i) {
    const bool free = static_cast<Index>(i) < statics.free_count;
    require(is_inverse(grains.inverse_mass[i], grains.mass[i], free), "inverse_mass");
    require(is_inverse(grains.inverse_inertia[i], grains.inertia[i], free), "inverse_inertia");
  }
  const double farthest = farthest_place(statics);
  record.check("/branch/x", grains.x, {-farthest, farthest});
  record.check("/branch/y", grains.y, {-farthest, farthest});
}

const std::string checkpoint_group = "/checkpoint/", branch_group = "/branch/";

constexpr double max_steps = std::int64_t{1} << 53;  // every integer up to this is exact as a double
constexpr Range angle_of_bed = {-1.6, 1.6};          // rad, at most upright

template <typename Checkpoint, typename Direction>
void for_each_field(const std::string& here, Checkpoint& checkpoint, Direction direction) {
  Fields fields{direction};
  auto& world = checkpoint.world;
  fields.scalar(here + "step", world.step, Range{0.0, max_steps});
  fields.scalar(here + "time", world.time, not_negative);
  fields.scalar(here + "tilt", world.tilt, angle_of_bed);
  fields.scalar(here + "gravity", world.gravity, not_negative);
  auto& grains = world.grains;
  fields.scalar(here + "free_count", grains.free_count);
  fields.array(here + "x", grains.x);
  fields.array(here + "y", grains.y);
  fields.array(here + "vx", grains.vx);
  fields.array(here + "vy", grains.vy);
  fields.array(here + "omega", grains.omega);
  fields.array(here + "radius", grains.radius, not_negative);
  fields.array(here + "inverse_mass", grains.inverse_mass, not_negative);
  fields.array(here + "inverse_inertia", grains.inverse_inertia, not_negative);
  fields.array(here + "mass", grains.mass, not_negative);
  fields.array(here + "inertia", grains.inertia, not_negative);
  fields.array(here + "angle", grains.angle);
  fields.array(here + "image", grains.image);
  auto& boundary = world.boundary;
  fields.scalar(here + "periodic", boundary.periodic);
  fields.scalar(here + "length", boundary.length, Range{1e-9, 1e15});
  fields.column(here + "plane_normal", boundary.planes, &Plane::normal, Range{-2.0, 2.0});
  fields.column(here + "plane_offset", boundary.planes, &Plane::offset);
  fields.column(here + "plane_wall", boundary.planes, &Plane::wall);
  auto& contacts = world.contacts;
  fields.pairs(here + "contact_pair", contacts.a, contacts.b);
  fields.array(here + "contact_shift", contacts.shift, shifts);
  fields.pairs(here + "contact_normal", contacts.nx, contacts.ny, Range{-2.0, 2.0});
  fields.array(here + "contact_gap", contacts.gap);
  fields.pairs(here + "contact_force", contacts.fn, contacts.ft);
  fields.array_if_any(here + "contact_moment", contacts.moment);
  fields.named(here + "integers", checkpoint.integers);
  fields.named(here + "reals", checkpoint.reals);
}

template <typename Checkpoint, typename Direction>
void for_each_result(Checkpoint& checkpoint, Direction direction) {
  Fields fields{direction};
  fields.named("/results", checkpoint.results);
  fields.named("/provenance/timing", checkpoint.timing);
}

template <typename Branch, typename Direction>
void for_each_origin(Branch& branch, Direction direction) {
  Fields fields{direction};
  fields.text(branch_group + "run", branch.run);
  fields.text(branch_group + "run_hash", branch.run_hash);
  fields.scalar(branch_group + "frame", branch.frame, not_negative);
}

void check_grains(const RecordCheck& record, const std::string& here, const Grains& grains) {
  if (grains.free_count < 0 || grains.free_count > grains.count())
    record.refuse(here + "free_count", "is not between 0 and the number of grains");
  const double farthest = grains.radius.empty() ? 0.0 : 1e8 * *std::ranges::max_element(grains.radius);
  record.check(here + "x", grains.x, {-farthest, farthest});
  record.check(here + "y", grains.y, {-farthest, farthest});
}

void check_contacts(const RecordCheck& record, const std::string& here, const World& world) {
  const auto bodies = static_cast<std::size_t>(world.grains.count()) + world.boundary.planes.size();
  const Contacts& c = world.contacts;
  if (!c.moment.empty() && c.moment.size() != c.a.size())
    record.refuse(here + "contact_moment",
                  fmt::format("holds {} moments of {} contacts", c.moment.size(), c.a.size()));
  for (std::size_t k = 0; k < c.a.size(); ++k)
    if (c.a[k] < 0 || c.a[k] >= world.grains.count() || c.b[k] <= c.a[k] ||
        static_cast<std::size_t>(c.b[k]) >= bodies)
      record.refuse(here + "contact_pair", "names a body that does not exist, or one twice");
  for (std::size_t k = 1; k < c.a.size(); ++k)
    if (std::pair(c.a[k], c.b[k]) < std::pair(c.a[k - 1], c.b[k - 1]))
      record.refuse(here + "contact_pair", "does not ascend");
}

void read_state(Reader& reader, const std::string& here, Checkpoint& checkpoint) {
  for_each_field(here, checkpoint, FileReader{reader});
  check_grains(reader, here, checkpoint.world.grains);
  check_contacts(reader, here, checkpoint.world);
  const std::string stored = reader.read_text(here + "state_hash"),
                    found = hash_text(state_hash(checkpoint.world));
  if (stored != found)
    reader.refuse(here + "state_hash", fmt::format("is {}, the state has {}", stored.substr(0, 16), found));
}

void write_state(Writer& writer, const std::string& here, const Checkpoint& checkpoint) {
  if (checks_what_is_written) {
    check_grains(RecordCheck(), here, checkpoint.world.grains);
    check_contacts(RecordCheck(), here, checkpoint.world);
  }
  writer.write_text(here + "state_hash", hash_text(state_hash(checkpoint.world)));
  for_each_field(here, checkpoint, FileWriter{writer});
}

void write_branch(Writer& writer, const BranchOrigin& branch) {
  for_each_origin(branch, FileWriter{writer});
  write_state(writer, branch_group, branch.start);
}

BranchOrigin read_branch(Reader& reader) {
  BranchOrigin branch;
  for_each_origin(branch, FileReader{reader});
  if (hash_text(parse_hash(branch.run_hash)) != branch.run_hash)
    reader.refuse(branch_group + "run_hash", "is no hash: expected 16 hexadecimal digits");
  read_state(reader, branch_group, branch.start);
  // Each frame of a run belongs to a later step than the preceding one.
  if (branch.frame > branch.start.world.step)
    reader.refuse(branch_group + "frame",
                  fmt::format("is {}, after {} steps", branch.frame, branch.start.world.step));
  return branch;
}

}  // namespace

Sizes with_branch(Sizes sizes, const RunHeader& header) {
  if (!header.branch) return sizes;
  const World& start = header.branch->start.world;
  sizes.insert_or_assign('G', start.grains.radius.size());
  sizes.insert_or_assign('B', start.contacts.a.size());
  sizes.insert_or_assign('P', start.boundary.planes.size());
  return sizes;
}

void write_header(Writer& writer, const RunHeader& header) {
  writer.write_scalar("/parameters/schema_version", run_schema_version);
  writer.write_text("/parameters/scenario_given", header.scenario_given);
  writer.write_text("/parameters/scenario_resolved", header.scenario_resolved);
  write_statics(writer, header.statics);
  writer.write_scalar(friction_of_grains, header.friction.grains);
  writer.write_scalar("/provenance/seed", header.seed);
  if (header.branch) {
    if (checks_what_is_written) check_branch(RecordCheck(), header.branch->start.world, header.statics);
    write_branch(writer, *header.branch);
  }
  for (const auto& [name, fact] : header.provenance) writer.write_text("/provenance/" + name, fact);
}

void check_version(Reader& reader) {
  const auto version = reader.read_scalar<std::int32_t>("/parameters/schema_version");
  if (version != run_schema_version)
    reader.refuse("/parameters/schema_version",
                  fmt::format("is {}, expected {}: another version of Talus made the run (/provenance "
                              "names it); open it with that one, or compute it again",
                              version, run_schema_version));
}

RunHeader read_header(Reader& reader, const std::function<bool(const std::string&)>& keeps) {
  check_version(reader);
  RunHeader header;
  header.scenario_given = reader.read_text("/parameters/scenario_given");
  header.scenario_resolved = reader.read_text("/parameters/scenario_resolved");
  header.statics = read_statics(reader);
  read_friction(reader, header);
  header.seed = reader.read_scalar<std::uint64_t>("/provenance/seed");
  if (reader.has("/branch") && (!keeps || keeps("/branch"))) {
    header.branch = read_branch(reader);
    check_branch(reader, header.branch->start.world, header.statics);
  }
  for (const std::string& name : reader.names("/provenance")) {
    const std::string path = "/provenance/" + name;
    if (name != "seed" && (!keeps || keeps(path)))
      header.provenance.emplace_back(name, reader.read_text(path));
  }
  if (header.branch) header.branch->history = find_value(header.provenance, history_fact).value_or("");
  return header;
}

void write_results(Writer& writer, const Checkpoint& checkpoint) {
  for_each_result(checkpoint, FileWriter{writer});
}

void write_checkpoint(Writer& writer, const Checkpoint& checkpoint) {
  write_state(writer, checkpoint_group, checkpoint);
  write_results(writer, checkpoint);
}

Checkpoint read_results(Reader& reader) {
  Checkpoint checkpoint;
  for_each_result(checkpoint, FileReader{reader});
  return checkpoint;
}

Checkpoint read_checkpoint(Reader& reader) {
  Checkpoint checkpoint = read_results(reader);
  read_state(reader, checkpoint_group, checkpoint);
  return checkpoint;
}

/// Returns the data sets of a stored analysis; none if it has another version, which is not interpreted.
static std::vector<std::string> analysis_data_sets(Reader& reader) {
  const std::string version = "/analysis/version", parameters = "/analysis/parameters";
  if (!reader.has("/analysis")) return {};
  if (is_as_written(reader, version) && reader.read_scalar<std::int32_t>(version) != analysis_version)
    return {};
  std::vector<std::string> paths;
  for (const DataSetField& field : analysis_schema())
    if (reader.has(field.path)) paths.push_back(field.path);
  for (const std::string& name : reader.names(parameters)) paths.push_back(parameters + "/" + name);
  for (const char* group : {"/readings/key", "/readings/value", "/readings/at_most"})
    if (reader.has(group))
      for (const std::string& name : reader.names(group)) paths.push_back(fmt::format("{}/{}", group, name));
  return paths;
}

static void keep_changed(Reader& reader, std::vector<std::string>& paths) {
  std::erase_if(paths, [&reader](const std::string& path) { return is_as_written(reader, path); });
}

bool is_as_written(Reader& reader, const std::string& path) try {
  return is_by_frame(field_of(path)) || reader.is_as_written(path);
} catch (const Error& error) {
  if (error.code() == ExitCode::out_of_memory) throw;
  return false;
}

std::vector<std::string> listed_data_sets(Reader& reader) { return lines_of(reader.read_text("/contents")); }

std::vector<std::string> changed_data_sets(Reader& reader) {
  std::vector<std::string> changed = listed_data_sets(reader);
  changed.emplace_back("/contents");
  for (const std::string& path : own_data_sets(reader)) changed.push_back(path);
  keep_changed(reader, changed);
  Reader reopened = reader.again();  // an analysis may have fewer frames
  std::vector<std::string> of_analysis = analysis_data_sets(reopened);
  keep_changed(reopened, of_analysis);
  changed.insert(changed.end(), of_analysis.begin(), of_analysis.end());
  return changed;
}

}  // namespace talus::io
