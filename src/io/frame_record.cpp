#include "io/run_file.h"
#include "io/run_records.h"

namespace talus {
namespace {

const std::string grains = "/particles/grains/";
const std::string contacts = "/contacts/";

/// The time-dependent elements of H5MD: groups with value, step and time.
bool is_element(const std::string& path) { return path.starts_with(grains) && path.ends_with("/value"); }

void create_frame_data_sets(hdf5::Writer& writer) {
  for (const DataSetField& field : run_schema())
    if (field.path.starts_with("/frames/") || field.path.starts_with(contacts) || is_element(field.path))
      writer.create(field.path);
  for (const DataSetField& field : run_schema())
    if (is_element(field.path)) {
      const std::string element = field.path.substr(0, field.path.rfind('/'));
      writer.link("/frames/step", element + "/step");
      writer.link("/frames/time", element + "/time");
    }
}

std::vector<double> flat(const std::vector<Tensor2>& tensors) {
  std::vector<double> values;
  values.reserve(4 * tensors.size());
  for (const Tensor2& m : tensors) values.insert(values.end(), {m.xx, m.xy, m.yx, m.yy});
  return values;
}

std::vector<Tensor2> tensors(const std::vector<double>& values) {
  std::vector<Tensor2> result(values.size() / 4);
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2], values[4 * i + 3]};
  return result;
}

void write_grains(hdf5::Writer& writer, std::size_t row, const Frame& frame) {
  writer.write_rows("/frames/step", row, std::vector<std::int64_t>{frame.step});
  writer.write_rows("/frames/time", row, std::vector<double>{frame.time});
  writer.write_rows("/frames/tilt", row, std::vector<double>{frame.tilt});
  const std::vector<Index> no_image(frame.image.size(), 0);  // across the bed there is no period
  writer.write_rows(grains + "position/value", row, interleaved(frame.x, frame.y));
  writer.write_rows(grains + "image/value", row, interleaved(frame.image, no_image));
  writer.write_rows(grains + "angle/value", row, frame.angle);
  writer.write_rows(grains + "velocity/value", row, interleaved(frame.vx, frame.vy));
  writer.write_rows(grains + "angular_velocity/value", row, frame.omega);
  writer.write_rows(grains + "internal_moment/value", row, flat(frame.internal_moment));
  writer.write_rows(grains + "gamma/value", row, frame.gamma);
}

void write_contacts(hdf5::Writer& writer, std::uint64_t first, const FrameContacts& c) {
  std::vector<std::int8_t> status;
  for (ContactStatus s : c.status) status.push_back(static_cast<std::int8_t>(s));
  writer.write_rows(contacts + "pair", first, interleaved(c.a, c.b));
  writer.write_rows(contacts + "shift", first, c.shift);
  writer.write_rows(contacts + "normal", first, interleaved(c.nx, c.ny));
  writer.write_rows(contacts + "point", first, interleaved(c.px, c.py));
  writer.write_rows(contacts + "force", first, interleaved(c.fn, c.ft));
  writer.write_rows(contacts + "status", first, status);
}

void read_grains(hdf5::Reader& reader, std::size_t row, Frame& frame) {
  const auto image = reader.read_rows<Index>(grains + "image/value", row, 1);
  const auto velocity = reader.read_rows<double>(grains + "velocity/value", row, 1);
  frame.image = component(image, 2, 0);
  frame.angle = reader.read_rows<double>(grains + "angle/value", row, 1);
  frame.vx = component(velocity, 2, 0);
  frame.vy = component(velocity, 2, 1);
  frame.omega = reader.read_rows<double>(grains + "angular_velocity/value", row, 1);
  frame.internal_moment = tensors(reader.read_rows<double>(grains + "internal_moment/value", row, 1));
  frame.gamma = reader.read_rows<double>(grains + "gamma/value", row, 1);
}

/// What others use as an index without looking must be one.
void check_contacts(const hdf5::Reader& reader, const Frame& frame) {
  for (std::size_t c = 0; c < frame.contacts.a.size(); ++c)
    if (frame.contacts.a[c] < 0 || frame.contacts.a[c] >= frame.grain_count() || frame.contacts.b[c] < 0)
      reader.refuse(contacts + "pair", "names a body that does not exist");
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
  const auto offset = reader.read_rows<std::int64_t>(contacts + "offset", row, 2);
  if (offset[0] < 0 || offset[1] < offset[0]) reader.refuse(contacts + "offset", "does not ascend");
  const auto first = static_cast<std::uint64_t>(offset[0]);
  const auto count = static_cast<std::uint64_t>(offset[1] - offset[0]);
  const auto pair = reader.read_rows<Index>(contacts + "pair", first, count);
  const auto normal = reader.read_rows<double>(contacts + "normal", first, count);
  const auto point = reader.read_rows<double>(contacts + "point", first, count);
  const auto force = reader.read_rows<double>(contacts + "force", first, count);
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
  create_frame_data_sets(writer);
  std::vector<std::int64_t> offset = {0};
  for (std::size_t k = 0; k < writer.sizes().at('T'); ++k) {
    const Frame frame = frame_at(k);
    write_grains(writer, k, frame);
    write_contacts(writer, static_cast<std::uint64_t>(offset.back()), frame.contacts);
    offset.push_back(offset.back() + frame.contacts.count());
  }
  writer.write_rows(contacts + "offset", 0, offset);
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
  frame.time = reader.read_rows<double>("/frames/time", row, 1)[0];
  frame.tilt = reader.read_rows<double>("/frames/tilt", row, 1)[0];
  const auto position = reader.read_rows<double>(grains + "position/value", row, 1);
  frame.x = component(position, 2, 0);
  frame.y = component(position, 2, 1);
  return frame;
}

Frame read_frame(hdf5::Reader& reader, std::size_t row) {
  Frame frame = read_positions(reader, row);
  read_grains(reader, row, frame);
  read_contacts(reader, row, frame.contacts);
  check_contacts(reader, frame);
  return frame;
}

}  // namespace talus
