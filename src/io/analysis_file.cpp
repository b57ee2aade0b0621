#include "io/analysis_file.h"

#include <unistd.h>

#include <algorithm>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/text_stream.h"
#include "io/durable_file.h"
#include "io/packed_file.h"
#include "io/run_records.h"
#include "io/seal.h"

namespace talus::io {
namespace {

const std::string analysis_group = "/analysis";

/// Returns the parameters that a quantity depends on, with their values: "lc_cut = 40; joining = contacts".
std::string parameters_text(const std::string& names_of_quantity, const Facts& parameters) {
  std::string text;
  std::istringstream names = text_stream(names_of_quantity);
  for (std::string name; names >> name;)
    for (const auto& [key, value] : parameters)
      if (key == name) text += fmt::format("{}{} = {}", text.empty() ? "" : "; ", name, value);
  return text.empty() ? "none" : text;
}

void describe(hdf5::Writer& writer, const std::string& path, const std::string& definition,
              const std::string& parameters) {
  writer.set_attribute(path, "definition", definition);
  writer.set_attribute(path, "parameters", parameters);
}

void write_analysis(hdf5::Writer& writer, const analysis::Analysis& analysis,
                    std::span<const analysis::Quantity> table) {
  writer.write_scalar(analysis_group + "/version", analysis_version);
  writer.write_text(analysis_group + "/key", analysis.key);
  for (const auto& [name, value] : analysis.parameters)
    writer.write_text(fmt::format("{}/parameters/{}", analysis_group, name), value);
  for (const char* name : {"/version", "/key"})
    describe(writer, analysis_group + name, field_of(analysis_group + name).help, "none");
  for (const analysis::Quantity& quantity : table) {
    if (!is_present(quantity, analysis)) continue;
    const DataSetField field = data_set_of(quantity);
    std::visit([&](const auto& values) { writer.write(field, values); },
               analysis::values_of(quantity, analysis));
    describe(writer, field.path, quantity.definition,
             parameters_text(quantity.parameters, analysis.parameters));
  }
}

analysis::Values read_values(hdf5::Reader& reader, const DataSetField& field) {
  if (field.type == ElementType::int32) return reader.read<Index>(field);
  if (field.type == ElementType::float32) return reader.read<float>(field, hdf5::any_number);
  return reader.read<double>(field, hdf5::any_number);
}

/// Creates the empty frames, thresholds and events of a stored analysis.
void make_records(hdf5::Reader& reader, const std::vector<double>& tilts, analysis::Analysis& analysis) {
  if (reader.has(analysis_group + "/threshold"))
    analysis.thresholds.resize(reader.row_count(analysis_group + "/threshold"));
  if (const std::string first = data_set_of(analysis::quantity_of(&analysis::EventRecord::begin)).path;
      reader.has(first))
    analysis.events.resize(reader.row_count(first));
  for (const double tilt : tilts) {
    analysis.frames.push_back({.tilt = tilt});
    analysis.frames.back().thresholds.resize(analysis.thresholds.size());
  }
}

/// Checks the number of rows; other code reads the rows of all these frames without a check.
void check_frame_count(const hdf5::Reader& reader, std::size_t rows, std::size_t frames) {
  if (rows != frames)
    reader.refuse(analysis_group,
                  fmt::format("(a group) has rows for {} frames, the tilt has {}", rows, frames));
}

/// Returns the packed file at `path` without an analysis.
std::vector<std::byte> bare_bytes(const std::string& path, const std::string& state_hash, bool keep_frames) {
  verify_seal(path);
  std::vector<std::byte> bytes = read_file(path);
  hdf5::Reader reader = hdf5::Reader::from_memory(bytes, path, {});
  const std::string stored_hash = reader.has("/checkpoint") ? reader.read_text("/checkpoint/state_hash")
                                                            : hash_text(talus::state_hash(World{}));
  if (stored_hash != state_hash)
    throw Error(ExitCode::cannot_create,
                path + ": was replaced by another run while it was being analysed; analyse it again");
  // HDF5 leaves holes after a removal, so the file is packed again.
  if (!reader.has(analysis_group) && keep_frames) return bytes;
  const RunFile run = RunFile::open(path);
  return packed_bytes(content_of(run, keep_frames));
}

}  // namespace

std::optional<analysis::Analysis> read_analysis(const RunFile& run,
                                                std::span<const analysis::Quantity> table) {
  if (!run.complete()) return std::nullopt;
  hdf5::Reader reader = run.packed_reader();
  if (!reader.has(analysis_group) ||
      reader.read_scalar<std::int32_t>(analysis_group + "/version") != analysis_version)
    return std::nullopt;
  analysis::Analysis analysis;
  analysis.key = reader.read_text(analysis_group + "/key");
  for (const std::string& name : reader.names(analysis_group + "/parameters"))
    analysis.parameters.emplace_back(name,
                                     reader.read_text(fmt::format("{}/parameters/{}", analysis_group, name)));
  const std::vector<double>& tilts = run.frame_tilts();
  check_frame_count(reader, reader.row_count(analysis_group + "/packing/volume"), tilts.size());
  reader.row_count("/particles/grains/id");  // establishes the number of grains
  make_records(reader, tilts, analysis);
  for (const analysis::Quantity& quantity : table)
    if (is_present(quantity, analysis))
      analysis::set_values(quantity, read_values(reader, data_set_of(quantity)), analysis);
  return analysis;
}

std::vector<StoredReading> read_readings(const RunFile& run) {
  if (!run.complete()) return {};
  hdf5::Reader reader = run.packed_reader();
  std::vector<StoredReading> readings;
  if (!reader.has("/readings")) return readings;
  for (const std::string& name : reader.names("/readings/key")) {
    const std::string value = "/readings/value/" + name;
    readings.push_back({name, reader.read_text("/readings/key/" + name), reader.row_count(value),
                        reader.read<double>(value, hdf5::any_number),
                        reader.read<std::int8_t>("/readings/at_most/" + name)});
  }
  return readings;
}

std::vector<std::byte> with_analysis(const std::vector<std::byte>& packed, const std::string& name,
                                     const analysis::Analysis& analysis,
                                     const std::vector<StoredReading>& readings,
                                     std::span<const analysis::Quantity> table) {
  Sizes sizes = sizes_of(analysis);
  if (!readings.empty()) {
    sizes['F'] = readings.front().thresholds;
    sizes['W'] = readings.front().values.size() / readings.front().thresholds;
  }
  hdf5::Writer writer(std::move(sizes), seal_size, packed, name);
  write_analysis(writer, analysis, table);
  for (const StoredReading& reading : readings) {
    writer.write_text("/readings/key/" + reading.name, reading.key);
    writer.write("/readings/value/" + reading.name, reading.values);
    writer.write("/readings/at_most/" + reading.name, reading.at_most);
  }
  std::vector<std::byte> file = writer.image();
  seal(file);
  return file;
}

namespace {

void replace_packed(const std::string& path, const std::vector<std::byte>& file) {
  // After a kill during packing, the leftover folder identifies its file by the seal, which changes here.
  if (const std::string target = output_target(path); run_presence(target) == RunPresence::packed)
    discard_folder(target);
  prepare_folder_of(path);
  write_durably(path, file);
}

}  // namespace

void store_analysis(const std::string& path, const analysis::Analysis& analysis,
                    const std::string& state_hash, std::span<const analysis::Quantity> table,
                    bool keep_frames) {
  const std::vector<StoredReading> readings = read_readings(RunFile::open(path));
  replace_packed(path,
                 with_analysis(bare_bytes(path, state_hash, keep_frames), path, analysis, readings, table));
}

void store_readings(const std::string& path, const std::vector<StoredReading>& readings,
                    const std::string& state_hash) {
  const std::optional<analysis::Analysis> analysis = read_analysis(path);
  if (!analysis) throw Error(ExitCode::bad_data, path + " has no analysis of this version of Talus");
  replace_packed(path, with_analysis(bare_bytes(path, state_hash, true), path, *analysis, readings));
}

}  // namespace talus::io
