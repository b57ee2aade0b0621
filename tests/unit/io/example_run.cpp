#include "unit/io/example_run.h"

#include <cmath>
#include <cstdlib>
#include <fmt/core.h>
#include <fstream>
#include <limits>

#include "core/random.h"
#include "core/trigonometry.h"

namespace talus::example {
namespace {

std::vector<double> numbers(Random& random, std::size_t count, double low, double high) {
  std::vector<double> values(count);
  for (double& value : values) value = random.uniform(low, high);
  return values;
}

FrameContacts frame_contacts(Random& random, std::size_t count) {
  FrameContacts c;
  for (std::size_t i = 0; i < count; ++i) {
    c.a.push_back(static_cast<Index>(i % 3));
    c.b.push_back(static_cast<Index>(3 + i));
    c.shift.push_back(static_cast<std::int8_t>(static_cast<int>(i % 3) - 1));
    c.status.push_back(static_cast<ContactStatus>(i % 3));
  }
  for (auto* field : {&c.nx, &c.ny, &c.px, &c.py, &c.fn, &c.ft}) *field = numbers(random, count, -1.0, 1.0);
  for (double& fn : c.fn) fn = 0.5 + std::abs(fn);
  return c;
}

Frame frame(Random& random, int number) {
  Frame f;
  f.step = 100 * number;
  f.time = 0.1 * number;
  f.tilt = radians(0.25 * number);
  for (auto* field : {&f.x, &f.y, &f.angle, &f.vx, &f.vy, &f.omega, &f.gamma})
    *field = numbers(random, grain_count, -2.0, 2.0);
  f.gamma[1] = std::numeric_limits<double>::quiet_NaN();
  f.image = {0, 1, -1, 2, 0, 0};
  for (Index i = 0; i < grain_count; ++i)
    f.internal_moment.push_back({random.uniform(), random.uniform(), random.uniform(), random.uniform()});
  f.contacts = frame_contacts(random, static_cast<std::size_t>(number % 4));
  return f;
}

}  // namespace

io::RunHeader header() {
  io::RunHeader header;
  header.statics.free_count = free_grain_count;
  header.statics.radius = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  header.statics.mass = {1.1, 1.2, 1.3, 1.4, 1.5, 1.6};
  header.statics.periodic = true;
  header.statics.length = 2.0 / 3.0;
  header.statics.depth = 0.4;
  header.statics.mean_diameter = 0.01;
  header.statics.gravity = 9.81;
  header.friction = header.deposition_friction = {0.5, 0.5};
  header.scenario_given = "seed = 3\n# \xCE\xB8 in a comment\n";
  header.scenario_resolved = "seed = 3\n";
  header.seed = 0xfedcba9876543210;
  header.provenance = {
      {"version", "0.1.0"}, {"git_hash", "abc"}, {"author", "A. \"Q\" \\ B\n"}, {"empty", ""}};
  return header;
}

io::Segment segment(int k) {
  Random random(static_cast<std::uint64_t>(k));
  io::Segment s;
  for (int i = 0; i < k % 3; ++i) s.frames.push_back(frame(random, 3 * k + i));
  s.observables.resize(2);
  s.steps.resize(5);
  for (ObservableRow& row : s.observables)
    for (double& value : row) value = random.uniform();
  for (StepRow& row : s.steps)
    for (double& value : row) value = random.uniform();
  for (int i = 0; i < k / 2; ++i)
    s.commands.push_back(
        {100 * k + i, static_cast<CommandKind>((k + i) % 4), i - 1, random.uniform(), -1.0 / 3.0});
  return s;
}

io::Checkpoint checkpoint(int k) {
  Random random(static_cast<std::uint64_t>(1000 + k));
  io::Checkpoint c;
  for (Index i = 0; i < grain_count; ++i)
    add_disk(c.world.grains, {random.uniform(), random.uniform()}, random.uniform(0.1, 0.2), 2500.0,
             i >= free_grain_count);
  Grains& g = c.world.grains;
  for (auto* field : {&g.vx, &g.vy, &g.omega, &g.angle}) *field = numbers(random, grain_count, -1.0, 1.0);
  g.image = {1, 0, -3, 0, 0, 0};
  c.world.boundary = {false, 1.0 / 3.0, {{{1.0, 0.0}, 0.25, true}, {{0.0, 1.0}, -0.5, false}}};
  Contacts& contacts = c.world.contacts;
  contacts.resize(static_cast<std::size_t>(k));
  for (auto* field : {&contacts.nx, &contacts.ny, &contacts.gap, &contacts.fn, &contacts.ft})
    *field = numbers(random, contacts.a.size(), -1.0, 1.0);
  for (std::size_t i = 0; i < contacts.a.size(); ++i) {
    contacts.b[i] = grain_count + 1;  // second plane
    contacts.shift[i] = -1;
  }
  c.world.tilt = random.uniform();
  c.world.time = random.uniform();
  c.world.step = 1000 + k;
  c.integers = {{"phase", 1}, {"a_large_one", std::int64_t{1} << 62}};
  c.reals = {{"onset", 1.0 / 3.0}, {"another", -0.0}};
  c.results = {{"theta_c", radians(21.0)}, {"residual_max", 1e-7}, {"unknown", std::nan("")}};
  c.timing = {{"solve", 1.5}, {"detect", 0.5}};
  return c;
}

io::RunStore store_with_commits(const std::string& path, int count) {
  io::RunStore store = io::RunStore::create(path, header(), false);
  for (int k = 0; k < count; ++k) store.commit(segment(k), checkpoint(k));
  return store;
}

std::string row_text(const io::DataSetField& field) {
  return fmt::format("| `{}` | {}{}{} | {} |\n", field.path, io::type_name(field.type),
                     field.shape.empty() ? "" : " " + field.shape, field.unit == "1" ? "" : ", " + field.unit,
                     field.help);
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

}  // namespace talus::example
