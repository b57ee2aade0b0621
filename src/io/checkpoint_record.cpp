#include <algorithm>
#include <fmt/core.h>
#include <utility>

#include "base/hash.h"
#include "io/record_fields.h"
#include "io/run_records.h"

namespace talus::io {
namespace {

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

void read_state(hdf5::Reader& reader, const std::string& here, Checkpoint& checkpoint) {
  for_each_field(here, checkpoint, FileReader{reader});
  check_grains(reader, here, checkpoint.world.grains);
  check_contacts(reader, here, checkpoint.world);
  const std::string stored = reader.read_text(here + "state_hash"),
                    found = hash_text(state_hash(checkpoint.world));
  if (stored != found)
    reader.refuse(here + "state_hash", fmt::format("is {}, the state has {}", stored.substr(0, 16), found));
}

void write_state(hdf5::Writer& writer, const std::string& here, const Checkpoint& checkpoint) {
  if (checks_what_is_written) {
    check_grains(RecordCheck(), here, checkpoint.world.grains);
    check_contacts(RecordCheck(), here, checkpoint.world);
  }
  writer.write_text(here + "state_hash", hash_text(state_hash(checkpoint.world)));
  for_each_field(here, checkpoint, FileWriter{writer});
}

}  // namespace

void write_results(hdf5::Writer& writer, const Checkpoint& checkpoint) {
  for_each_result(checkpoint, FileWriter{writer});
}

void write_checkpoint(hdf5::Writer& writer, const Checkpoint& checkpoint) {
  write_state(writer, checkpoint_group, checkpoint);
  write_results(writer, checkpoint);
}

void write_branch(hdf5::Writer& writer, const BranchOrigin& branch) {
  for_each_origin(branch, FileWriter{writer});
  write_state(writer, branch_group, branch.start);
}

BranchOrigin read_branch(hdf5::Reader& reader) {
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

Checkpoint read_results(hdf5::Reader& reader) {
  Checkpoint checkpoint;
  for_each_result(checkpoint, FileReader{reader});
  return checkpoint;
}

Checkpoint read_checkpoint(hdf5::Reader& reader) {
  Checkpoint checkpoint = read_results(reader);
  read_state(reader, checkpoint_group, checkpoint);
  return checkpoint;
}

}  // namespace talus::io
