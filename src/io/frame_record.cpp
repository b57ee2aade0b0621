#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <span>

#include "base/hash.h"
#include "io/record_fields.h"
#include "io/run_file.h"
#include "io/run_records.h"

namespace talus::io {
namespace {

using hdf5::Rows;

const std::string grains = "/particles/grains/";
const std::string contacts = "/contacts/";
const std::string moments = contacts + "moment";  // present only if contacts resist rolling

template <typename SomeFrame, typename Direction>
void for_each_field_of_positions(SomeFrame& frame, Fields<Direction>& fields) {
  fields.scalar("/frames/step", frame.step);
  fields.scalar("/frames/time", frame.time);
  fields.scalar("/frames/tilt", frame.tilt);
  fields.pairs(grains + "position/value", frame.x, frame.y);
  std::vector<Index> across(frame.image.size(), 0);  // there is no period across the bed
  fields.pairs(grains + "image/value", frame.image, across);
  if constexpr (Direction::reads)
    if (std::ranges::count(across, 0) != std::ssize(across))
      fields.direction.reader.refuse(
          grains + "image/value",
          "holds a periodic image across the depth of the bed, which is not periodic");
}

/// Visits the data sets of a frame in the order of the schema, which the hash uses.
template <typename SomeFrame, typename Direction>
void for_each_field(SomeFrame& frame, Direction direction) {
  Fields fields{direction};
  for_each_field_of_positions(frame, fields);
  fields.array(grains + "angle/value", frame.angle);
  fields.pairs(grains + "velocity/value", frame.vx, frame.vy);
  fields.array(grains + "angular_velocity/value", frame.omega);
  fields.array(grains + "internal_moment/value", frame.internal_moment);
  fields.array(grains + "gamma/value", frame.gamma, hdf5::any_number);
  auto& c = frame.contacts;
  fields.pairs(contacts + "pair", c.a, c.b);
  fields.array(contacts + "shift", c.shift, shifts);
  fields.pairs(contacts + "normal", c.nx, c.ny);
  fields.pairs(contacts + "point", c.px, c.py);
  fields.pairs(contacts + "force", c.fn, c.ft);
  fields.array(contacts + "status", c.status, Range{0.0, 2.0});
  fields.array_if_any(moments, c.moment);
}

bool is_of_contacts(const std::string& path) { return path.starts_with(contacts); }

/// Passes the rows of each data set, as they are stored, to `take(field, bytes)`.
template <typename Take>
struct RowWriter {
  Take take;
  static constexpr bool reads = false;

  static bool has(const std::string&, bool is_there) { return is_there; }
  template <typename T>
  void put(const std::string& path, const std::vector<T>& values, Range range) {
    const DataSetField field = field_of(path);
    const auto check_and_take = [&](const auto& stored) {
      RecordCheck().check(path, stored, range);
      take(field, std::as_bytes(std::span(stored)));
    };
    if (field.type != ElementType::float32) return check_and_take(values);
    check_and_take(std::vector<float>(values.begin(), values.end()));
  }
};
template <typename Take>
RowWriter(Take) -> RowWriter<Take>;

struct RowReader {
  hdf5::Reader& reader;
  Rows frame, contact;  ///< rows of each data set that belong to the frame
  static constexpr bool reads = true;

  bool has(const std::string& path, bool) const { return reader.has(path); }
  template <typename T>
  std::vector<T> get(const std::string& path, Range range) {
    return reader.read<T>(path, range, is_of_contacts(path) ? contact : frame);
  }
};

Rows contact_rows(hdf5::Reader& reader, std::size_t row) {
  const auto offset = reader.read<std::int64_t>(contacts + "offset", {}, Rows{row, 2});
  const auto rows = static_cast<std::int64_t>(reader.row_count(contacts + "pair"));
  if (offset[0] < 0 || offset[1] < offset[0] || offset[1] > rows)
    reader.refuse(contacts + "offset", fmt::format("does not ascend within the {} contacts", rows));
  return {static_cast<std::uint64_t>(offset[0]), static_cast<std::uint64_t>(offset[1] - offset[0])};
}

/// Whether a path is a time-dependent element of H5MD: a group with value, step and time.
bool is_element(const std::string& path) { return path.starts_with(grains) && path.ends_with("/value"); }

void create_data_sets(hdf5::Writer& writer) {
  for (const DataSetField& field : run_schema())
    if (is_by_frame(field) && field.path != moments) writer.create(field);
  for (const DataSetField& field : run_schema())
    if (is_element(field.path)) {
      const std::string element = field.path.substr(0, field.path.rfind('/'));
      writer.link("/frames/step", element + "/step");
      writer.link("/frames/time", element + "/time");
    }
}

}  // namespace

std::uint64_t frame_hash(const Frame& frame) {
  Hasher hasher;
  for_each_field(frame, RowWriter{[&](const DataSetField&, std::span<const std::byte> bytes) {
                   hasher.add_array(bytes);
                 }});
  return hasher.value();
}

void write_frames(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at) {
  create_data_sets(writer);
  const auto write_one = [&writer](const std::string& path, std::uint64_t row, const auto& value) {
    writer.write_rows(field_of(path), row, std::as_bytes(std::span(&value, 1)));
  };
  std::int64_t contact_count = 0;
  bool have_moments = false;
  write_one(contacts + "offset", 0, contact_count);
  for (std::size_t k = 0; k < writer.sizes().at('T'); ++k) {
    const Frame frame = frame_at(k);
    // Either all frames with contacts have moments, or none has.
    if (!have_moments && !frame.contacts.moment.empty()) writer.create(field_of(moments));
    have_moments = have_moments || !frame.contacts.moment.empty();
    const auto first_contact = static_cast<std::uint64_t>(contact_count);
    Hasher hasher;
    for_each_field(frame, RowWriter{[&](const DataSetField& field, std::span<const std::byte> bytes) {
                     hasher.add_array(bytes);
                     writer.write_rows(field, is_of_contacts(field.path) ? first_contact : k, bytes);
                   }});
    contact_count += frame.contacts.count();
    write_one(contacts + "offset", k + 1, contact_count);
    write_one("/frames/hash", k, hasher.value());
  }
}

void write_instants(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at) {
  const DataSetField steps = field_of("/frames/step"), times = field_of("/frames/time"),
                     tilts = field_of("/frames/tilt");
  for (const DataSetField& field : {steps, times, tilts}) writer.create(field);
  for (std::size_t k = 0; k < writer.sizes().at('T'); ++k) {
    const Frame frame = frame_at(k);
    writer.write_rows(steps, k, std::as_bytes(std::span(&frame.step, 1)));
    writer.write_rows(times, k, std::as_bytes(std::span(&frame.time, 1)));
    writer.write_rows(tilts, k, std::as_bytes(std::span(&frame.tilt, 1)));
  }
}

Frame as_stored(Frame frame) {
  FrameContacts& c = frame.contacts;
  for (std::vector<double>* values : {&frame.x, &frame.y, &frame.angle, &frame.vx, &frame.vy, &frame.omega,
                                      &frame.gamma, &c.nx, &c.ny, &c.px, &c.py, &c.fn, &c.ft, &c.moment})
    for (double& value : *values) value = static_cast<float>(value);
  for (Tensor2& m : frame.internal_moment)
    m = {static_cast<float>(m.xx), static_cast<float>(m.xy), static_cast<float>(m.yx),
         static_cast<float>(m.yy)};
  return frame;
}

Frame read_positions(hdf5::Reader& reader, std::size_t row) {
  Frame frame;
  Fields fields{RowReader{reader, {row, 1}, {}}};
  for_each_field_of_positions(frame, fields);
  return frame;
}

Frame read_frame(hdf5::Reader& reader, std::size_t row) {
  Frame frame;
  for_each_field(frame, RowReader{reader, {row, 1}, contact_rows(reader, row)});
  return frame;
}

void check_frame(const RecordCheck& record, const Frame& frame, double farthest, std::size_t planes) {
  const auto check_places = [&](const std::vector<double>& along, const std::string& name) {
    if (std::ranges::any_of(along, [&](double r) { return std::abs(r) > farthest; }))
      record.refuse(name, "holds a position farther away than a grain can be");
  };
  for (const auto* along : {&frame.x, &frame.y}) check_places(*along, grains + "position/value");
  for (const auto* along : {&frame.contacts.px, &frame.contacts.py}) check_places(*along, contacts + "point");
  const auto bodies = static_cast<Index>(frame.x.size() + planes);
  const FrameContacts& c = frame.contacts;
  if (!c.moment.empty() && c.moment.size() != c.a.size())
    record.refuse(moments, "does not have as many rows as " + contacts + "pair");
  for (std::size_t k = 0; k < c.a.size(); ++k)
    if (c.a[k] < 0 || c.a[k] >= frame.grain_count() || c.b[k] <= c.a[k] || c.b[k] >= bodies)
      record.refuse(contacts + "pair",
                    fmt::format("joins the bodies {} and {}, expected a < b < {} with a grain a", c.a[k],
                                c.b[k], bodies));
}

}  // namespace talus::io
