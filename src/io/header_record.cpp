#include <algorithm>

#include "core/errors.h"
#include "io/run_records.h"

namespace talus {
namespace {

constexpr std::int8_t free_species = 0;
constexpr std::int8_t floor_species = 1;

void write_statics(hdf5::Writer& writer, const RunStatics& statics) {
  const std::size_t count = statics.radius.size();
  std::vector<Index> ids(count);
  std::vector<std::int8_t> species(count, floor_species);
  for (std::size_t i = 0; i < count; ++i) ids[i] = static_cast<Index>(i);
  std::fill_n(species.begin(), statics.free_count, free_species);
  writer.write("/particles/grains/box/edges", std::vector<double>{statics.length, statics.depth});
  writer.write("/particles/grains/id", ids);
  writer.write("/particles/grains/species", species);
  writer.write("/particles/grains/radius", statics.radius);
  writer.write("/particles/grains/mass", statics.mass);
  writer.write_scalar<std::int8_t>("/parameters/periodic", statics.periodic ? 1 : 0);
  writer.write_scalar("/parameters/mean_diameter", statics.mean_diameter);
  writer.write_scalar("/parameters/gravity", statics.gravity);
  writer.write_scalar("/parameters/friction", statics.friction);
}

Index free_grains(hdf5::Reader& reader) {
  const std::string path = "/particles/grains/species";
  const auto species = reader.read<std::int8_t>(path);
  const auto floor_begin = std::ranges::find(species, floor_species);
  if (std::any_of(species.begin(), floor_begin, [](std::int8_t kind) { return kind != free_species; }))
    reader.refuse(path, "holds another value than 0 and 1");
  if (std::any_of(floor_begin, species.end(), [](std::int8_t kind) { return kind != floor_species; }))
    reader.refuse(path, "has a free grain after a floor grain");
  if (floor_begin == species.begin()) reader.refuse(path, "has no free grain");
  return static_cast<Index>(floor_begin - species.begin());
}

/// Lengths must be those of one bed: grids are made from their ratios.
RunStatics read_statics(hdf5::Reader& reader) {
  constexpr double infinity = hdf5::Reader::infinity;
  RunStatics statics;
  statics.free_count = free_grains(reader);
  statics.mean_diameter = reader.read_finite_scalar("/parameters/mean_diameter", 1e-9, 1e9);
  const double d = statics.mean_diameter;
  const auto edges = reader.read_finite("/particles/grains/box/edges", 0.1 * d, 1e6 * d);
  statics.length = edges[0];
  statics.depth = edges[1];
  statics.radius = reader.read_finite("/particles/grains/radius", 1e-3 * d, 1e3 * d);
  statics.mass = reader.read_finite("/particles/grains/mass", 0.0, infinity);
  statics.periodic = reader.read_scalar<std::int8_t>("/parameters/periodic") != 0;
  statics.gravity = reader.read_finite_scalar("/parameters/gravity", 0.0, infinity);
  statics.friction = reader.read_finite_scalar("/parameters/friction", 0.0, infinity);
  return statics;
}

}  // namespace

void write_header(hdf5::Writer& writer, const RunHeader& header) {
  writer.write_scalar("/parameters/schema_version", run_schema_version);
  writer.write_text("/parameters/scenario_given", header.scenario_given);
  writer.write_text("/parameters/scenario_resolved", header.scenario_resolved);
  write_statics(writer, header.statics);
  writer.write_scalar("/provenance/seed", header.seed);
  for (const auto& [name, fact] : header.provenance) writer.write_text("/provenance/" + name, fact);
}

RunHeader read_header(hdf5::Reader& reader) {
  const auto version = reader.read_scalar<std::int32_t>("/parameters/schema_version");
  if (version < oldest_run_schema_version || version > run_schema_version)
    reader.refuse("/parameters/schema_version",
                  "is " + std::to_string(version) + ", this Talus reads versions " +
                      std::to_string(oldest_run_schema_version) + " to " +
                      std::to_string(run_schema_version) + "; open it with " +
                      (version > run_schema_version ? "a newer Talus" : "the Talus that made it") +
                      " (its version is in /provenance)");
  RunHeader header;
  header.scenario_given = reader.read_text("/parameters/scenario_given");
  header.scenario_resolved = reader.read_text("/parameters/scenario_resolved");
  header.statics = read_statics(reader);
  header.seed = reader.read_scalar<std::uint64_t>("/provenance/seed");
  for (const std::string& name : reader.names("/provenance"))
    if (name != "seed") header.provenance.emplace_back(name, reader.read_text("/provenance/" + name));
  return header;
}

}  // namespace talus
