#include <algorithm>
#include <cstdlib>
#include <fmt/core.h>
#include <utility>

#include "core/hash.h"
#include "io/record_fields.h"
#include "io/run_records.h"

namespace talus {
namespace {

const std::string checkpoint_group = "/checkpoint/", branch_group = "/branch/";

constexpr std::int64_t most_steps = std::int64_t{1} << 53;  // all numbers of steps up to this are doubles
constexpr Range angle_of_bed = {-1.6, 1.6};                 // rad, upright and no further

template <typename World, typename Fields>
void for_each_field(const std::string& here, World& world, Fields fields) {
  fields.scalar(here + "step", world.step);
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
  fields.array(here + "contact_shift", contacts.shift);
  fields.pairs(here + "contact_normal", contacts.nx, contacts.ny, Range{-2.0, 2.0});
  fields.array(here + "contact_gap", contacts.gap);
  fields.pairs(here + "contact_force", contacts.fn, contacts.ft);
  fields.array_if_any(here + "contact_moment", contacts.moment);
}

void check_grains(const hdf5::Reader& reader, const std::string& here, const Grains& grains) {
  if (grains.free_count < 0 || grains.free_count > grains.count())
    reader.refuse(here + "free_count", "is not between 0 and the number of grains");
  const double farthest = grains.radius.empty() ? 0.0 : 1e8 * *std::ranges::max_element(grains.radius);
  reader.check(here + "x", grains.x, -farthest, farthest);
  reader.check(here + "y", grains.y, -farthest, farthest);
}

void check_contacts(const hdf5::Reader& reader, const std::string& here, const World& world) {
  const auto bodies = static_cast<std::size_t>(world.grains.count()) + world.boundary.planes.size();
  const Contacts& c = world.contacts;
  if (!c.moment.empty() && c.moment.size() != c.a.size())
    reader.refuse(here + "contact_moment",
                  fmt::format("holds {} moments of {} contacts", c.moment.size(), c.a.size()));
  for (std::size_t k = 0; k < c.a.size(); ++k)
    if (c.a[k] < 0 || c.a[k] >= world.grains.count() || c.b[k] <= c.a[k] ||
        static_cast<std::size_t>(c.b[k]) >= bodies)
      reader.refuse(here + "contact_pair", "names a body that does not exist, or one twice");
  for (std::size_t k = 1; k < c.a.size(); ++k)
    if (std::pair(c.a[k], c.b[k]) < std::pair(c.a[k - 1], c.b[k - 1]))
      reader.refuse(here + "contact_pair", "does not ascend");
  if (std::ranges::any_of(c.shift, [](std::int8_t shift) { return std::abs(shift) > 1; }))
    reader.refuse(here + "contact_shift", "holds a value other than -1, 0 and 1");
}

World read_world(hdf5::Reader& reader, const std::string& here) {
  World world;
  for_each_field(here, world, FieldReader(reader));
  if (world.step < 0 || world.step > most_steps) reader.refuse(here + "step", "is no number of steps");
  check_grains(reader, here, world.grains);
  check_contacts(reader, here, world);
  const std::string stored = reader.read_text(here + "state_hash"), found = hash_text(state_hash(world));
  if (stored != found)
    reader.refuse(here + "state_hash", fmt::format("is {}, the state has {}", stored.substr(0, 16), found));
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

void write_results(hdf5::Writer& writer, const Checkpoint& checkpoint) {
  write_named(writer, "/results", checkpoint.results);
  write_named(writer, "/provenance/timing", checkpoint.timing);
}

namespace {

void write_state(hdf5::Writer& writer, const std::string& here, const Checkpoint& checkpoint) {
  writer.write_text(here + "state_hash", hash_text(state_hash(checkpoint.world)));
  for_each_field(here, checkpoint.world, FieldWriter(writer));
  write_named(writer, here + "integers", checkpoint.integers);
  write_named(writer, here + "reals", checkpoint.reals);
}

void read_state(hdf5::Reader& reader, const std::string& here, Checkpoint& checkpoint) {
  checkpoint.world = read_world(reader, here);
  checkpoint.integers = read_named<std::int64_t>(reader, here + "integers");
  checkpoint.reals = read_named<double>(reader, here + "reals");
}

}  // namespace

void write_checkpoint(hdf5::Writer& writer, const Checkpoint& checkpoint) {
  write_state(writer, checkpoint_group, checkpoint);
  write_results(writer, checkpoint);
}

void write_branch(hdf5::Writer& writer, const BranchOrigin& branch) {
  writer.write_text(branch_group + "run", branch.run);
  writer.write_text(branch_group + "run_hash", branch.run_hash);
  writer.write_scalar(branch_group + "frame", branch.frame);
  write_state(writer, branch_group, branch.start);
}

BranchOrigin read_branch(hdf5::Reader& reader) {
  BranchOrigin branch;
  branch.run = reader.read_text(branch_group + "run");
  branch.run_hash = reader.read_text(branch_group + "run_hash");
  if (hash_text(parse_hash(branch.run_hash)) != branch.run_hash)
    reader.refuse(branch_group + "run_hash", "is no hash: expected 16 hexadecimal digits");
  branch.frame = reader.read_scalar<std::int64_t>(branch_group + "frame");
  if (branch.frame < 0) reader.refuse(branch_group + "frame", "is negative");
  read_state(reader, branch_group, branch.start);
  // Each frame of a run is of a later step than the one before.
  if (branch.frame > branch.start.world.step)
    reader.refuse(branch_group + "frame",
                  fmt::format("is {}, after {} steps", branch.frame, branch.start.world.step));
  return branch;
}

Checkpoint read_results(hdf5::Reader& reader) {
  Checkpoint checkpoint;
  checkpoint.results = read_named<double>(reader, "/results");
  checkpoint.timing = read_named<double>(reader, "/provenance/timing");
  return checkpoint;
}

Checkpoint read_checkpoint(hdf5::Reader& reader) {
  Checkpoint checkpoint = read_results(reader);
  read_state(reader, checkpoint_group, checkpoint);
  return checkpoint;
}

}  // namespace talus
