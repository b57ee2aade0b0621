#include <algorithm>
#include <cmath>
#include <fmt/core.h>

#include "base/errors.h"
#include "io/bounds.h"
#include "io/record_fields.h"
#include "io/run_records.h"
#include "scenario/scenario.h"

namespace talus::io {
namespace {

constexpr std::int8_t free_species = 0;
constexpr std::int8_t floor_species = 1;

constexpr const char* friction_of_grains = "/parameters/friction";
constexpr const char* edges = "/particles/grains/box/edges";
constexpr Range diameters = {1e-9, 1e9};

Range lengths_of_bed(double d) { return {0.1 * d, 1e6 * d}; }

/// Visits the static data. Lengths are limited relative to the diameter d, m, because grids are sized by
/// these ratios.
template <typename Statics, typename Direction>
void for_each_field(Statics& statics, double d, Direction direction) {
  Fields fields{direction};
  fields.array("/particles/grains/radius", statics.radius, Range{smallest_radius * d, largest_radius * d});
  fields.array("/particles/grains/mass", statics.mass, not_negative);
  fields.scalar("/parameters/periodic", statics.periodic);
  fields.scalar("/parameters/mean_diameter", statics.mean_diameter, diameters);
  fields.scalar("/parameters/gravity", statics.gravity, not_negative);
}

void write_statics(hdf5::Writer& writer, const RunStatics& statics) {
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

Index free_grains(hdf5::Reader& reader) {
  const std::string path = "/particles/grains/species";
  const auto species = reader.read<std::int8_t>(path, Range{free_species, floor_species});
  const auto floor_begin = std::ranges::find(species, floor_species);
  if (std::any_of(floor_begin, species.end(), [](std::int8_t kind) { return kind != floor_species; }))
    reader.refuse(path, "has a free grain after a floor grain");
  if (floor_begin == species.begin()) reader.refuse(path, "has no free grain");
  return static_cast<Index>(floor_begin - species.begin());
}

RunStatics read_statics(hdf5::Reader& reader) {
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
void read_friction(hdf5::Reader& reader, RunHeader& header) {
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

}  // namespace

Sizes with_branch(Sizes sizes, const RunHeader& header) {
  if (!header.branch) return sizes;
  const World& start = header.branch->start.world;
  sizes.insert_or_assign('G', start.grains.radius.size());
  sizes.insert_or_assign('B', start.contacts.a.size());
  sizes.insert_or_assign('P', start.boundary.planes.size());
  return sizes;
}

void write_header(hdf5::Writer& writer, const RunHeader& header) {
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

void check_version(hdf5::Reader& reader) {
  const auto version = reader.read_scalar<std::int32_t>("/parameters/schema_version");
  if (version != run_schema_version)
    reader.refuse("/parameters/schema_version",
                  fmt::format("is {}, expected {}: another version of Talus made the run (/provenance "
                              "names it); open it with that one, or compute it again",
                              version, run_schema_version));
}

RunHeader read_header(hdf5::Reader& reader, const std::function<bool(const std::string&)>& keeps) {
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

}  // namespace talus::io
