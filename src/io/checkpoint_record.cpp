#include <algorithm>
#include <array>

#include "core/hash.h"
#include "io/run_records.h"

namespace talus {
namespace {

const std::string here = "/checkpoint/";

constexpr double any = -hdf5::Reader::infinity;

struct GrainField {
  const char* name;
  std::vector<double> Grains::*values;
  double low;  ///< least value that can be
};
constexpr std::array<GrainField, 11> grain_fields = {{{"x", &Grains::x, any},
                                                      {"y", &Grains::y, any},
                                                      {"vx", &Grains::vx, any},
                                                      {"vy", &Grains::vy, any},
                                                      {"omega", &Grains::omega, any},
                                                      {"radius", &Grains::radius, 0.0},
                                                      {"inverse_mass", &Grains::inverse_mass, 0.0},
                                                      {"inverse_inertia", &Grains::inverse_inertia, 0.0},
                                                      {"mass", &Grains::mass, 0.0},
                                                      {"inertia", &Grains::inertia, 0.0},
                                                      {"angle", &Grains::angle, any}}};

void write_boundary(hdf5::Writer& writer, const Boundary& boundary) {
  std::vector<double> normal, offset;
  std::vector<std::int8_t> wall;
  for (const Plane& plane : boundary.planes) {
    normal.insert(normal.end(), {plane.normal.x, plane.normal.y});
    offset.push_back(plane.offset);
    wall.push_back(plane.wall ? 1 : 0);
  }
  writer.write_scalar<std::int8_t>(here + "periodic", boundary.periodic ? 1 : 0);
  writer.write_scalar(here + "length", boundary.length);
  writer.write(here + "plane_normal", normal);
  writer.write(here + "plane_offset", offset);
  writer.write(here + "plane_wall", wall);
}

Boundary read_boundary(hdf5::Reader& reader) {
  Boundary boundary;
  boundary.periodic = reader.read_scalar<std::int8_t>(here + "periodic") != 0;
  boundary.length = reader.read_finite_scalar(here + "length", 1e-9, 1e15);
  const auto normal = reader.read_finite(here + "plane_normal", -2.0, 2.0);
  const auto offset = reader.read_finite(here + "plane_offset");
  const auto wall = reader.read<std::int8_t>(here + "plane_wall");
  for (std::size_t k = 0; k < offset.size(); ++k)
    boundary.planes.push_back({{normal[2 * k], normal[2 * k + 1]}, offset[k], wall[k] != 0});
  return boundary;
}

void write_memory(hdf5::Writer& writer, const Contacts& c) {
  writer.write(here + "contact_pair", interleaved(c.a, c.b));
  writer.write(here + "contact_shift", c.shift);
  writer.write(here + "contact_normal", interleaved(c.nx, c.ny));
  writer.write(here + "contact_gap", c.gap);
  writer.write(here + "contact_force", interleaved(c.fn, c.ft));
}

Contacts read_memory(hdf5::Reader& reader) {
  Contacts c;
  const auto pair = reader.read<Index>(here + "contact_pair");
  const auto normal = reader.read_finite(here + "contact_normal", -2.0, 2.0);
  const auto force = reader.read_finite(here + "contact_force");
  c.a = component(pair, 2, 0);
  c.b = component(pair, 2, 1);
  c.shift = reader.read<std::int8_t>(here + "contact_shift");
  c.nx = component(normal, 2, 0);
  c.ny = component(normal, 2, 1);
  c.gap = reader.read_finite(here + "contact_gap");
  c.fn = component(force, 2, 0);
  c.ft = component(force, 2, 1);
  return c;
}

void write_world(hdf5::Writer& writer, const World& world) {
  writer.write_text(here + "state_hash", hash_text(state_hash(world)));
  writer.write_scalar(here + "step", world.step);
  writer.write_scalar(here + "time", world.time);
  writer.write_scalar(here + "tilt", world.tilt);
  writer.write_scalar(here + "gravity", world.gravity);
  writer.write_scalar(here + "free_count", world.grains.free_count);
  for (const GrainField& field : grain_fields) writer.write(here + field.name, world.grains.*field.values);
  writer.write(here + "image", world.grains.image);
  write_boundary(writer, world.boundary);
  write_memory(writer, world.contacts);
}

Grains read_grains(hdf5::Reader& reader) {
  Grains grains;
  for (const GrainField& field : grain_fields)
    grains.*field.values = reader.read_finite(here + field.name, field.low);
  grains.image = reader.read<Index>(here + "image");
  grains.free_count = reader.read_scalar<Index>(here + "free_count");
  if (grains.free_count < 0 || grains.free_count > grains.count())
    reader.refuse(here + "free_count", "is not between 0 and the number of grains");
  const double farthest = grains.radius.empty() ? 0.0 : 1e8 * *std::ranges::max_element(grains.radius);
  for (const char* name : {"x", "y"}) reader.read_finite(here + name, -farthest, farthest);
  return grains;
}

void check_contacts(const hdf5::Reader& reader, const World& world) {
  const auto bodies = static_cast<std::size_t>(world.grains.count()) + world.boundary.planes.size();
  const Contacts& c = world.contacts;
  for (std::size_t k = 0; k < c.a.size(); ++k)
    if (c.a[k] < 0 || c.a[k] >= world.grains.count() || c.b[k] <= c.a[k] ||
        static_cast<std::size_t>(c.b[k]) >= bodies)
      reader.refuse(here + "contact_pair", "names a body that does not exist, or one twice");
}

World read_world(hdf5::Reader& reader) {
  World world;
  world.step = reader.read_scalar<std::int64_t>(here + "step");
  if (world.step < 0) reader.refuse(here + "step", "is negative");
  world.time = reader.read_finite_scalar(here + "time");
  world.tilt = reader.read_finite_scalar(here + "tilt");
  world.gravity = reader.read_finite_scalar(here + "gravity", 0.0, hdf5::Reader::infinity);
  world.grains = read_grains(reader);
  world.boundary = read_boundary(reader);
  world.contacts = read_memory(reader);
  check_contacts(reader, world);
  const std::string stored = reader.read_text(here + "state_hash"), found = hash_text(state_hash(world));
  if (stored != found)
    reader.refuse(here + "state_hash", "is " + stored.substr(0, 16) + ", the state has " + found);
  return world;
}

std::string member(const std::string& group, const std::string& name) {
  std::string path = group;
  path += '/';
  path += name;
  return path;
}

template <typename Named>
void write_named(hdf5::Writer& writer, const std::string& group, const Named& values) {
  writer.create_group(group);
  for (const auto& [name, value] : values) writer.write_scalar(member(group, name), value);
}

template <typename T>
std::vector<std::pair<std::string, T>> read_named(hdf5::Reader& reader, const std::string& group) {
  std::vector<std::pair<std::string, T>> values;
  for (const std::string& name : reader.names(group))
    values.emplace_back(name, reader.read_scalar<T>(member(group, name)));
  return values;
}

}  // namespace

void write_checkpoint(hdf5::Writer& writer, const Checkpoint& checkpoint) {
  write_world(writer, checkpoint.world);
  write_named(writer, "/checkpoint/integers", checkpoint.integers);
  write_named(writer, "/checkpoint/reals", checkpoint.reals);
  write_named(writer, "/results", checkpoint.results);
  write_named(writer, "/provenance/timing", checkpoint.timing);
}

Checkpoint read_results(hdf5::Reader& reader) {
  Checkpoint checkpoint;
  checkpoint.results = read_named<double>(reader, "/results");
  checkpoint.timing = read_named<double>(reader, "/provenance/timing");
  return checkpoint;
}

Checkpoint read_checkpoint(hdf5::Reader& reader) {
  Checkpoint checkpoint = read_results(reader);
  checkpoint.world = read_world(reader);
  checkpoint.integers = read_named<std::int64_t>(reader, "/checkpoint/integers");
  checkpoint.reals = read_named<double>(reader, "/checkpoint/reals");
  return checkpoint;
}

}  // namespace talus
