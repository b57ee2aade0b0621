#include "io/stored_frame.h"

#include <cstring>
#include <span>

#include "core/hash.h"
#include "io/run_records.h"

namespace talus {
namespace {

const std::string grains = "/particles/grains/";
const std::string contacts = "/contacts/";

/// The data sets of a frame, as the schema has them; offsets of contacts and hashes are those of the file.
std::vector<DataSetField> make_fields() {
  std::vector<DataSetField> fields;
  for (const DataSetField& field : run_schema())
    if (is_by_frame(field) && field.path != contacts + "offset" && field.path != "/frames/hash")
      fields.push_back(field);
  return fields;
}

const std::vector<DataSetField>& fields() {
  static const std::vector<DataSetField> of_a_frame = make_fields();
  return of_a_frame;
}

bool is_of_contacts(const DataSetField& field) { return field.shape.starts_with('M'); }

/// The time-dependent elements of H5MD: groups with value, step and time.
bool is_element(const std::string& path) { return path.starts_with(grains) && path.ends_with("/value"); }

void create_data_sets(hdf5::Writer& writer) {
  for (const DataSetField& field : run_schema())
    if (is_by_frame(field)) writer.create(field.path);
  for (const DataSetField& field : run_schema())
    if (is_element(field.path)) {
      const std::string element = field.path.substr(0, field.path.rfind('/'));
      writer.link("/frames/step", element + "/step");
      writer.link("/frames/time", element + "/time");
    }
}

template <typename T>
std::vector<std::byte> bytes_of(const std::vector<T>& values) {
  const auto bytes = std::as_bytes(std::span(values));
  return {bytes.begin(), bytes.end()};
}

/// In the single precision of the file.
std::vector<std::byte> rounded(const std::vector<double>& values) {
  return bytes_of(std::vector<float>(values.begin(), values.end()));
}

std::vector<double> flat(const std::vector<Tensor2>& tensors) {
  std::vector<double> values;
  values.reserve(4 * tensors.size());
  for (const Tensor2& m : tensors) values.insert(values.end(), {m.xx, m.xy, m.yx, m.yy});
  return values;
}

template <typename T>
T first_value(const StoredFrame& frame, const std::string& path) {
  T value{};
  for (std::size_t f = 0; f < fields().size(); ++f)
    if (fields()[f].path == path && frame.rows.at(f).size() >= sizeof value)
      std::memcpy(&value, frame.rows[f].data(), sizeof value);
  return value;
}

}  // namespace

StoredFrame as_stored_rows(const Frame& frame) {
  const FrameContacts& c = frame.contacts;
  const std::vector<Index> no_image(frame.image.size(), 0);  // across the bed there is no period
  std::vector<std::int8_t> status;
  for (ContactStatus s : c.status) status.push_back(static_cast<std::int8_t>(s));
  StoredFrame stored;
  stored.contacts = c.a.size();
  stored.rows = {bytes_of(std::vector{frame.step}),
                 bytes_of(std::vector{frame.time}),
                 bytes_of(std::vector{frame.tilt}),
                 rounded(interleaved(frame.x, frame.y)),
                 bytes_of(interleaved(frame.image, no_image)),
                 rounded(frame.angle),
                 rounded(interleaved(frame.vx, frame.vy)),
                 rounded(frame.omega),
                 rounded(flat(frame.internal_moment)),
                 rounded(frame.gamma),
                 bytes_of(interleaved(c.a, c.b)),
                 bytes_of(c.shift),
                 rounded(interleaved(c.nx, c.ny)),
                 rounded(interleaved(c.px, c.py)),
                 rounded(interleaved(c.fn, c.ft)),
                 bytes_of(status)};
  return stored;
}

std::uint64_t frame_hash(const StoredFrame& frame) {
  Hasher hasher;
  for (const std::vector<std::byte>& rows : frame.rows) hasher.add_array(rows);
  return hasher.value();
}

std::int64_t step_of(const StoredFrame& frame) { return first_value<std::int64_t>(frame, "/frames/step"); }
double tilt_of(const StoredFrame& frame) { return first_value<double>(frame, "/frames/tilt"); }

bool fits(const StoredFrame& frame, std::uint64_t grain_count) {
  if (frame.rows.size() != fields().size()) return false;
  for (std::size_t f = 0; f < fields().size(); ++f) {
    std::size_t size = size_of(fields()[f].type);
    for (const std::uint64_t extent :
         dimensions(fields()[f], {{'T', 1}, {'N', grain_count}, {'M', frame.contacts}}))
      size *= extent;
    if (frame.rows[f].size() != size) return false;
  }
  return true;
}

ContactRows contact_rows(hdf5::Reader& reader, std::size_t row) {
  const auto offset = reader.read_rows<std::int64_t>(contacts + "offset", row, 2);
  const auto rows = static_cast<std::int64_t>(reader.row_count(contacts + "pair"));
  if (offset[0] < 0 || offset[1] < offset[0] || offset[1] > rows)
    reader.refuse(contacts + "offset", "does not ascend within the " + std::to_string(rows) + " contacts");
  return {static_cast<std::uint64_t>(offset[0]), static_cast<std::uint64_t>(offset[1] - offset[0])};
}

StoredFrame read_stored_frame(hdf5::Reader& reader, std::size_t row) {
  const ContactRows own = contact_rows(reader, row);
  StoredFrame frame;
  frame.contacts = own.count;
  for (const DataSetField& field : fields())
    frame.rows.push_back(is_of_contacts(field) ? reader.read_row_bytes(field.path, own.first, own.count)
                                               : reader.read_row_bytes(field.path, row, 1));
  return frame;
}

void write_stored_frames(hdf5::Writer& writer, const std::function<StoredFrame(std::size_t)>& frame_at) {
  create_data_sets(writer);
  std::int64_t contact_count = 0;
  writer.write_rows(contacts + "offset", 0, std::vector{contact_count});
  for (std::size_t k = 0; k < writer.sizes().at('T'); ++k) {
    const StoredFrame frame = frame_at(k);
    const auto first = static_cast<std::uint64_t>(contact_count);
    for (std::size_t f = 0; f < fields().size(); ++f)
      writer.write_row_bytes(fields()[f].path, is_of_contacts(fields()[f]) ? first : k, frame.rows[f]);
    contact_count += static_cast<std::int64_t>(frame.contacts);
    writer.write_rows(contacts + "offset", k + 1, std::vector{contact_count});
    writer.write_rows("/frames/hash", k, std::vector{frame_hash(frame)});
  }
}

}  // namespace talus
