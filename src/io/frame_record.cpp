#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <span>

#include "core/hash.h"
#include "io/record_fields.h"
#include "io/run_file.h"
#include "io/run_records.h"

namespace talus {
namespace {

const std::string grains = "/particles/grains/";
const std::string contacts = "/contacts/";
const std::string moments = contacts + "moment";  // only where contacts resist rolling

template <typename SomeFrame, typename Fields>
void for_each_field_of_positions(SomeFrame& frame, Fields fields) {
  fields.scalar("/frames/step", frame.step);
  fields.scalar("/frames/time", frame.time);
  fields.scalar("/frames/tilt", frame.tilt);
  fields.pairs(grains + "position/value", frame.x, frame.y);
}

/// The data sets of a frame in the order of the schema, which is that of its hash.
template <typename SomeFrame, typename Fields>
void for_each_field(SomeFrame& frame, Fields fields) {
  for_each_field_of_positions(frame, fields);
  fields.firsts(grains + "image/value", frame.image);  // across the bed there is no period
  fields.array(grains + "angle/value", frame.angle);
  fields.pairs(grains + "velocity/value", frame.vx, frame.vy);
  fields.array(grains + "angular_velocity/value", frame.omega);
  fields.tensors(grains + "internal_moment/value", frame.internal_moment);
  fields.array_or_nan(grains + "gamma/value", frame.gamma);
  auto& c = frame.contacts;
  fields.pairs(contacts + "pair", c.a, c.b);
  fields.array(contacts + "shift", c.shift);
  fields.pairs(contacts + "normal", c.nx, c.ny);
  fields.pairs(contacts + "point", c.px, c.py);
  fields.pairs(contacts + "force", c.fn, c.ft);
  fields.array(contacts + "status", c.status);
  fields.array_if_any(moments, c.moment);
}

bool is_of_contacts(const std::string& path) { return path.starts_with(contacts); }

/// Gives the rows of each data set to `take(path, bytes)` as they are stored, arrays of doubles in single
/// precision.
template <typename Take>
struct RowEncoder {
  Take take;

  template <typename T>
  void scalar(const std::string& path, const T& value) {
    take(path, std::as_bytes(std::span(&value, 1)));
  }
  template <typename T>
  void array(const std::string& path, const std::vector<T>& values) {
    take(path, std::as_bytes(std::span(values)));
  }
  void array(const std::string& path, const std::vector<double>& values) {
    array(path, std::vector<float>(values.begin(), values.end()));
  }
  void array_or_nan(const std::string& path, const std::vector<double>& values) { array(path, values); }
  void array_if_any(const std::string& path, const std::vector<double>& values) {
    if (!values.empty()) array(path, values);
  }
  template <typename T>
  void pairs(const std::string& path, const std::vector<T>& x, const std::vector<T>& y) {
    array(path, interleaved(x, y));
  }
  void firsts(const std::string& path, const std::vector<Index>& values) {
    pairs(path, values, std::vector<Index>(values.size(), 0));
  }
  void tensors(const std::string& path, const std::vector<Tensor2>& values) {
    std::vector<float> flat;
    flat.reserve(4 * values.size());
    for (const Tensor2& m : values)
      for (const double value : {m.xx, m.xy, m.yx, m.yy}) flat.push_back(static_cast<float>(value));
    array(path, flat);
  }
};
template <typename Take>
RowEncoder(Take) -> RowEncoder<Take>;

/// Rows along the first dimension.
struct Rows {
  std::uint64_t first = 0, count = 0;
};

struct RowDecoder {
  hdf5::Reader& reader;
  Rows frame, contact;  ///< which rows of each data set are of the frame

  template <typename T>
  std::vector<T> rows(const std::string& path) {
    const Rows own = is_of_contacts(path) ? contact : frame;
    if constexpr (std::is_same_v<T, double>)
      return reader.read_finite_rows(path, own.first, own.count);
    else
      return reader.read_rows<T>(path, own.first, own.count);
  }
  template <typename T>
  void scalar(const std::string& path, T& value) {
    value = rows<T>(path)[0];
  }
  template <typename T>
  void array(const std::string& path, std::vector<T>& values) {
    values = rows<T>(path);
  }
  void array(const std::string& path, std::vector<ContactStatus>& values) {
    for (const std::int8_t value : rows<std::int8_t>(path)) {
      if (value < 0 || value > 2) reader.refuse(path, "holds a value other than 0, 1 and 2");
      values.push_back(static_cast<ContactStatus>(value));
    }
  }
  void array_or_nan(const std::string& path, std::vector<double>& values) {
    values = reader.read_rows<double>(path, frame.first, frame.count);
  }
  void array_if_any(const std::string& path, std::vector<double>& values) {
    if (reader.has(path)) array(path, values);
  }
  template <typename T>
  void pairs(const std::string& path, std::vector<T>& x, std::vector<T>& y) {
    const std::vector<T> both = rows<T>(path);
    x = component(both, 2, 0);
    y = component(both, 2, 1);
  }
  void firsts(const std::string& path, std::vector<Index>& values) {
    const std::vector<Index> both = rows<Index>(path);
    for (const Index second : component(both, 2, 1))
      if (second != 0) reader.refuse(path, "holds an image across the bed, where there is no period");
    values = component(both, 2, 0);
  }
  void tensors(const std::string& path, std::vector<Tensor2>& values) {
    const std::vector<double> flat = rows<double>(path);
    for (std::size_t i = 0; i < flat.size(); i += 4)
      values.push_back({flat[i], flat[i + 1], flat[i + 2], flat[i + 3]});
  }
};

Rows contact_rows(hdf5::Reader& reader, std::size_t row) {
  const auto offset = reader.read_rows<std::int64_t>(contacts + "offset", row, 2);
  const auto rows = static_cast<std::int64_t>(reader.row_count(contacts + "pair"));
  if (offset[0] < 0 || offset[1] < offset[0] || offset[1] > rows)
    reader.refuse(contacts + "offset", fmt::format("does not ascend within the {} contacts", rows));
  return {static_cast<std::uint64_t>(offset[0]), static_cast<std::uint64_t>(offset[1] - offset[0])};
}

/// The time-dependent elements of H5MD: groups with value, step and time.
bool is_element(const std::string& path) { return path.starts_with(grains) && path.ends_with("/value"); }

void create_data_sets(hdf5::Writer& writer) {
  for (const DataSetField& field : run_schema())
    if (is_by_frame(field) && field.path != moments) writer.create(field.path);
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
  for_each_field(frame, RowEncoder{[&](const std::string&, std::span<const std::byte> bytes) {
                   hasher.add_array(bytes);
                 }});
  return hasher.value();
}

void write_frames(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at) {
  create_data_sets(writer);
  std::int64_t contact_count = 0;
  bool have_moments = false;
  writer.write_rows(contacts + "offset", 0, std::vector{contact_count});
  for (std::size_t k = 0; k < writer.sizes().at('T'); ++k) {
    const Frame frame = frame_at(k);
    // All frames with contacts have them, or none has.
    if (!have_moments && !frame.contacts.moment.empty()) writer.create(moments);
    have_moments = have_moments || !frame.contacts.moment.empty();
    const auto first_contact = static_cast<std::uint64_t>(contact_count);
    Hasher hasher;
    for_each_field(frame, RowEncoder{[&](const std::string& path, std::span<const std::byte> bytes) {
                     hasher.add_array(bytes);
                     writer.write_row_bytes(path, is_of_contacts(path) ? first_contact : k, bytes);
                   }});
    contact_count += frame.contacts.count();
    writer.write_rows(contacts + "offset", k + 1, std::vector{contact_count});
    writer.write_rows("/frames/hash", k, std::vector{hasher.value()});
  }
}

void write_instants(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at) {
  for (const char* path : {"/frames/step", "/frames/time", "/frames/tilt"}) writer.create(path);
  for (std::size_t k = 0; k < writer.sizes().at('T'); ++k) {
    const Frame frame = frame_at(k);
    writer.write_rows("/frames/step", k, std::vector{frame.step});
    writer.write_rows("/frames/time", k, std::vector{frame.time});
    writer.write_rows("/frames/tilt", k, std::vector{frame.tilt});
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
  for_each_field_of_positions(frame, RowDecoder{reader, {row, 1}, {}});
  return frame;
}

Frame read_frame(hdf5::Reader& reader, std::size_t row) {
  Frame frame;
  for_each_field(frame, RowDecoder{reader, {row, 1}, contact_rows(reader, row)});
  return frame;
}

double farthest_place(const RunStatics& statics) {
  return std::min(1e4 * (statics.length + statics.depth), 1e8 * statics.mean_diameter);
}

void check_frame(const hdf5::Reader& reader, const BedFrame& bed, std::size_t planes) {
  const double farthest = farthest_place(bed.statics);
  const auto check_places = [&](const std::vector<double>& along, const std::string& name) {
    if (std::ranges::any_of(along, [&](double r) { return std::abs(r) > farthest; }))
      reader.refuse(name, "holds a position farther away than a grain can be");
  };
  for (const auto* along : {&bed.frame.x, &bed.frame.y}) check_places(*along, grains + "position/value");
  for (const auto* along : {&bed.frame.contacts.px, &bed.frame.contacts.py})
    check_places(*along, contacts + "point");
  const auto bodies = static_cast<Index>(bed.frame.x.size() + planes);
  const FrameContacts& c = bed.frame.contacts;
  if (!c.moment.empty() && c.moment.size() != c.a.size())
    reader.refuse(moments, "holds another number of rows than " + contacts + "pair");
  for (std::size_t k = 0; k < c.a.size(); ++k) {
    if (c.a[k] < 0 || c.a[k] >= bed.frame.grain_count() || c.b[k] <= c.a[k] || c.b[k] >= bodies)
      reader.refuse(contacts + "pair",
                    fmt::format("joins the bodies {} and {}, expected a < b < {} with a grain a", c.a[k],
                                c.b[k], bodies));
    if (std::abs(c.shift[k]) > 1) reader.refuse(contacts + "shift", "holds a value other than -1, 0 and 1");
  }
}

}  // namespace talus
