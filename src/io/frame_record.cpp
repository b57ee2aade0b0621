#include <algorithm>
#include <cmath>

#include "io/run_file.h"
#include "io/run_records.h"
#include "io/stored_frame.h"

namespace talus {
namespace {

const std::string grains = "/particles/grains/";
const std::string contacts = "/contacts/";

std::vector<Tensor2> tensors(const std::vector<double>& values) {
  std::vector<Tensor2> result(values.size() / 4);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
  return result;
}

void read_grains(hdf5::Reader& reader, std::size_t row, Frame& frame) {
  const auto image = reader.read_rows<Index>(grains + "image/value", row, 1);
  const auto velocity = reader.read_finite_rows(grains + "velocity/value", row, 1);
  frame.image = component(image, 2, 0);
  frame.angle = reader.read_finite_rows(grains + "angle/value", row, 1);
  frame.vx = component(velocity, 2, 0);
  frame.vy = component(velocity, 2, 1);
  frame.omega = reader.read_finite_rows(grains + "angular_velocity/value", row, 1);
  frame.internal_moment = tensors(reader.read_finite_rows(grains + "internal_moment/value", row, 1));
  frame.gamma = reader.read_rows<double>(grains + "gamma/value", row, 1);
}

std::vector<ContactStatus> read_status(hdf5::Reader& reader, std::uint64_t first, std::uint64_t count) {
  std::vector<ContactStatus> status;
  for (std::int8_t value : reader.read_rows<std::int8_t>(contacts + "status", first, count)) {
    if (value < 0 || value > 2) reader.refuse(contacts + "status", "holds another value than 0, 1, 2");
    status.push_back(static_cast<ContactStatus>(value));
  }
  return status;
}

void read_contacts(hdf5::Reader& reader, std::size_t row, FrameContacts& c) {
  const auto [first, count] = contact_rows(reader, row);
  const auto pair = reader.read_rows<Index>(contacts + "pair", first, count);
  const auto normal = reader.read_finite_rows(contacts + "normal", first, count);
  const auto point = reader.read_finite_rows(contacts + "point", first, count);
  const auto force = reader.read_finite_rows(contacts + "force", first, count);
  c.a = component(pair, 2, 0);
  c.b = component(pair, 2, 1);
  c.shift = reader.read_rows<std::int8_t>(contacts + "shift", first, count);
  c.nx = component(normal, 2, 0);
  c.ny = component(normal, 2, 1);
  c.px = component(point, 2, 0);
  c.py = component(point, 2, 1);
  c.fn = component(force, 2, 0);
  c.ft = component(force, 2, 1);
  c.status = read_status(reader, first, count);
}

}  // namespace

void write_frames(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at) {
  write_stored_frames(writer, [&frame_at](std::size_t k) { return as_stored_rows(frame_at(k)); });
}

Frame as_stored(Frame frame) {
  FrameContacts& c = frame.contacts;
  for (std::vector<double>* values : {&frame.x, &frame.y, &frame.angle, &frame.vx, &frame.vy, &frame.omega,
                                      &frame.gamma, &c.nx, &c.ny, &c.px, &c.py, &c.fn, &c.ft})
    for (double& value : *values) value = static_cast<float>(value);
  for (Tensor2& m : frame.internal_moment)
    m = {static_cast<float>(m.xx), static_cast<float>(m.xy), static_cast<float>(m.yx),
         static_cast<float>(m.yy)};
  return frame;
}

Frame read_positions(hdf5::Reader& reader, std::size_t row) {
  Frame frame;
  frame.step = reader.read_rows<std::int64_t>("/frames/step", row, 1)[0];
  frame.time = reader.read_finite_rows("/frames/time", row, 1)[0];
  frame.tilt = reader.read_finite_rows("/frames/tilt", row, 1)[0];
  const auto position = reader.read_finite_rows(grains + "position/value", row, 1);
  frame.x = component(position, 2, 0);
  frame.y = component(position, 2, 1);
  return frame;
}

Frame read_frame(hdf5::Reader& reader, std::size_t row) {
  Frame frame = read_positions(reader, row);
  read_grains(reader, row, frame);
  read_contacts(reader, row, frame.contacts);
  return frame;
}

void check_frame(const hdf5::Reader& reader, const Frame& frame, const RunStatics& statics,
                 std::size_t planes) {
  // As cells of the size of a grain, it must still be a number of cells.
  const double farthest = std::min(1e4 * (statics.length + statics.depth), 1e8 * statics.mean_diameter);
  const auto check_places = [&](const std::vector<double>& along, const std::string& name) {
    if (std::ranges::any_of(along, [&](double r) { return std::abs(r) > farthest; }))
      reader.refuse(name, "has a place farther away than a grain can come");
  };
  for (const auto* along : {&frame.x, &frame.y}) check_places(*along, grains + "position/value");
  for (const auto* along : {&frame.contacts.px, &frame.contacts.py}) check_places(*along, contacts + "point");
  const auto bodies = static_cast<Index>(frame.x.size() + planes);
  const FrameContacts& c = frame.contacts;
  for (std::size_t k = 0; k < c.a.size(); ++k) {
    if (c.a[k] < 0 || c.a[k] >= frame.grain_count() || c.b[k] <= c.a[k] || c.b[k] >= bodies)
      reader.refuse(contacts + "pair", "joins the bodies " + std::to_string(c.a[k]) + " and " +
                                           std::to_string(c.b[k]) + ", expected a < b < " +
                                           std::to_string(bodies) + " with a grain a");
    if (std::abs(c.shift[k]) > 1) reader.refuse(contacts + "shift", "holds another value than -1, 0, 1");
  }
}

}  // namespace talus
