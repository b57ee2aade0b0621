#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <span>

#include "base/hash.h"
#include "io/run_file.h"
#include "io/run_records.h"

namespace talus::io {

namespace {

using hdf5::Rows;

const std::string grain_group = "/particles/grains/";
const std::string contact_group = "/contacts/";
const std::string moments = contact_group + "moment";  // present only if contacts resist rolling

template <typename SomeFrame, typename Direction>
void for_each_field_of_positions(SomeFrame& frame, Fields<Direction>& fields) {
  fields.scalar("/frames/step", frame.step);
  fields.scalar("/frames/time", frame.time);
  fields.scalar("/frames/tilt", frame.tilt);
  fields.pairs(grain_group + "position/value", frame.x, frame.y);
  std::vector<Index> across(frame.image.size(), 0);  // there is no period across the bed
  fields.pairs(grain_group + "image/value", frame.image, across);
  if constexpr (Direction::reads)
    if (std::ranges::count(across, 0) != std::ssize(across))
      fields.direction.reader.refuse(
          grain_group + "image/value",
          "holds a periodic image across the depth of the bed, which is not periodic");
}

/// Visits the data sets of a frame in the order of the schema, which the hash uses.
template <typename SomeFrame, typename Direction>
void for_each_field(SomeFrame& frame, Direction direction) {
  Fields fields{direction};
  for_each_field_of_positions(frame, fields);
  fields.array(grain_group + "angle/value", frame.angle);
  fields.pairs(grain_group + "velocity/value", frame.vx, frame.vy);
  fields.array(grain_group + "angular_velocity/value", frame.omega);
  fields.array(grain_group + "internal_moment/value", frame.internal_moment);
  fields.array(grain_group + "gamma/value", frame.gamma, hdf5::any_number);
  auto& c = frame.contacts;
  fields.pairs(contact_group + "pair", c.a, c.b);
  fields.array(contact_group + "shift", c.shift, shifts);
  fields.pairs(contact_group + "normal", c.nx, c.ny);
  fields.pairs(contact_group + "point", c.px, c.py);
  fields.pairs(contact_group + "force", c.fn, c.ft);
  fields.array(contact_group + "status", c.status, Range{0.0, 2.0});
  fields.array_if_any(moments, c.moment);
}

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

template <typename T>
void write_one(Writer& writer, const std::string& path, std::uint64_t row, const T& value) {
  writer.write_rows(path, row, std::as_bytes(std::span(&value, 1)));
}

void create_data_sets(Writer& writer) {
  for (const DataSetField& field : run_schema())
    if (is_by_frame(field) && field.path != moments) writer.create(field);
  // A time-dependent element of H5MD is a group with value, step and time.
  for (const DataSetField& field : run_schema())
    if (field.path.starts_with(grain_group) && field.path.ends_with("/value")) {
      const std::string element = field.path.substr(0, field.path.rfind('/'));
      writer.link("/frames/step", element + "/step");
      writer.link("/frames/time", element + "/time");
    }
}

}  // namespace

Rows contact_rows(Reader& reader, std::size_t row) {
  const auto offset = reader.read<std::int64_t>(contact_group + "offset", {}, Rows{row, 2});
  const auto rows = static_cast<std::int64_t>(reader.row_count(contact_group + "pair"));
  if (offset[0] < 0 || offset[1] < offset[0] || offset[1] > rows)
    reader.refuse(contact_group + "offset", fmt::format("does not ascend within the {} contacts", rows));
  return {static_cast<std::uint64_t>(offset[0]), static_cast<std::uint64_t>(offset[1] - offset[0])};
}

std::uint64_t frame_hash(const Frame& frame) {
  Hasher hasher;
  for_each_field(frame, RowWriter{[&](const DataSetField&, std::span<const std::byte> bytes) {
                   hasher.add_array(bytes);
                 }});
  return hasher.value();
}

void write_frames(Writer& writer, const std::function<Frame(std::size_t)>& frame_at) {
  create_data_sets(writer);
  std::int64_t contact_count = 0;
  bool have_moments = false;
  write_one(writer, contact_group + "offset", 0, contact_count);
  for (std::size_t k = 0; k < writer.sizes().at('T'); ++k) {
    const Frame frame = frame_at(k);
    // Either all frames with contacts have moments, or none has.
    if (!have_moments && !frame.contacts.moment.empty()) writer.create(field_of(moments));
    have_moments = have_moments || !frame.contacts.moment.empty();
    const auto first_contact = static_cast<std::uint64_t>(contact_count);
    Hasher hasher;
    for_each_field(frame, RowWriter{[&](const DataSetField& field, std::span<const std::byte> bytes) {
                     hasher.add_array(bytes);
                     writer.write_rows(field.path, field.path.starts_with(contact_group) ? first_contact : k,
                                       bytes);
                   }});
    contact_count += frame.contacts.count();
    write_one(writer, contact_group + "offset", k + 1, contact_count);
    write_one(writer, "/frames/hash", k, hasher.value());
  }
}

void write_instants(Writer& writer, const std::function<Frame(std::size_t)>& frame_at) {
  for (const char* path : {"/frames/step", "/frames/time", "/frames/tilt"}) writer.create(field_of(path));
  for (std::size_t k = 0; k < writer.sizes().at('T'); ++k) {
    const Frame frame = frame_at(k);
    write_one(writer, "/frames/step", k, frame.step);
    write_one(writer, "/frames/time", k, frame.time);
    write_one(writer, "/frames/tilt", k, frame.tilt);
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

Frame read_positions(Reader& reader, std::size_t row) {
  Frame frame;
  Fields fields{FileReader{reader, Rows{row, 1}}};
  for_each_field_of_positions(frame, fields);
  return frame;
}

Frame read_frame(Reader& reader, std::size_t row) {
  Frame frame;
  for_each_field(frame, FileReader{reader, Rows{row, 1}, contact_rows(reader, row)});
  return frame;
}

void check_frame(const RecordCheck& record, const Frame& frame, double farthest, std::size_t planes) {
  const auto check_places = [&](const std::vector<double>& along, const std::string& name) {
    if (std::ranges::any_of(along, [&](double r) { return std::abs(r) > farthest; }))
      record.refuse(name, "holds a position farther away than a grain can be");
  };
  for (const auto* along : {&frame.x, &frame.y}) check_places(*along, grain_group + "position/value");
  for (const auto* along : {&frame.contacts.px, &frame.contacts.py})
    check_places(*along, contact_group + "point");
  const Index bodies = frame.x.size() + planes;
  const FrameContacts& c = frame.contacts;
  if (!c.moment.empty() && c.moment.size() != c.a.size())
    record.refuse(moments, "does not have as many rows as " + contact_group + "pair");
  for (std::size_t k = 0; k < c.a.size(); ++k)
    if (c.a[k] < 0 || c.a[k] >= frame.grain_count() || c.b[k] <= c.a[k] || c.b[k] >= bodies)
      record.refuse(contact_group + "pair",
                    fmt::format("joins the bodies {} and {}, expected a < b < {} with a grain a", c.a[k],
                                c.b[k], bodies));
}

template <typename Columns, typename Rows, typename Direction>
static void for_each_column(const std::string& group, const Columns& columns, Rows& rows,
                            Direction direction) {
  Fields fields{direction};
  for (std::size_t f = 0; f < columns.size(); ++f) {
    const std::string name(columns[f].name);
    const bool counts = name == "step" || name == "time" || name == "tilt" || name == "phase";
    const auto value = [f](auto& row) -> auto& { return row[f]; };
    fields.column(group + name, rows, value, counts ? Range{} : hdf5::any_number);
  }
}

template <typename Commands, typename Direction>
static void for_each_command_column(Commands& commands, Direction direction) {
  Fields fields{direction};
  fields.column("/commands/step", commands, &Command::step, not_negative);
  fields.column("/commands/kind", commands, &Command::kind, Range{0.0, command_kind_count - 1.0});
  fields.column("/commands/grain", commands, &Command::grain);
  fields.column("/commands/x", commands, &Command::x);
  fields.column("/commands/y", commands, &Command::y);
}

Sizes sizes_of(const Segment& segment) {
  return {{'R', segment.observables.size()},
          {'S', segment.steps.size()},
          {'K', segment.commands.size()},
          {'Q', segment.trials.size()}};
}

void write_series(Writer& writer, const Segment& segment) {
  const FileWriter file{writer};
  for_each_column("/observables/", observable_fields, segment.observables, file);
  for_each_column("/steps/", step_fields, segment.steps, file);
  if (!segment.commands.empty()) for_each_command_column(segment.commands, file);
  if (!segment.trials.empty()) for_each_column("/trials/", trial_fields, segment.trials, file);
}

std::vector<TrialRow> read_trials(Reader& reader) {
  std::vector<TrialRow> rows;
  if (reader.has("/trials")) for_each_column("/trials/", trial_fields, rows, FileReader{reader});
  return rows;
}

std::vector<ObservableRow> read_observables(Reader& reader) {
  std::vector<ObservableRow> rows;
  for_each_column("/observables/", observable_fields, rows, FileReader{reader});
  return rows;
}

std::vector<StepRow> read_steps(Reader& reader) {
  std::vector<StepRow> rows;
  for_each_column("/steps/", step_fields, rows, FileReader{reader});
  return rows;
}

std::vector<Command> read_commands(Reader& reader) {
  std::vector<Command> commands;
  if (!reader.has("/commands")) return commands;
  for_each_command_column(commands, FileReader{reader});
  if (!std::ranges::is_sorted(commands, {}, &Command::step))
    reader.refuse("/commands/step", "does not ascend");
  return commands;
}

}  // namespace talus::io
