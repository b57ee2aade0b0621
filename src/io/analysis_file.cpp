#include "io/analysis_file.h"

#include <unistd.h>

#include <algorithm>
#include <fmt/core.h>

#include "core/errors.h"
#include "core/text_stream.h"
#include "io/durable_file.h"
#include "io/frames_of_tilt.h"
#include "io/packed_file.h"
#include "io/run_records.h"
#include "io/seal.h"

namespace talus {
namespace {

const std::string analysis_group = "/analysis";

/// "lc_cut = 40; joining = contacts": the parameters that a quantity depends on, with their values.
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

void write_analysis(hdf5::Writer& writer, const Analysis& analysis, std::span<const Quantity> table) {
  writer.write_scalar(analysis_group + "/version", analysis_version);
  writer.write_text(analysis_group + "/key", analysis.key);
  for (const auto& [name, value] : analysis.parameters)
    writer.write_text(fmt::format("{}/parameters/{}", analysis_group, name), value);
  for (const char* name : {"/version", "/key"})
    describe(writer, analysis_group + name, field_of(analysis_group + name).help, "none");
  for (const Quantity& quantity : table) {
    if (!is_present(quantity, analysis)) continue;
    const DataSetField field = data_set_of(quantity);
    std::visit([&](const auto& values) { writer.write(field, values); }, values_of(quantity, analysis));
    describe(writer, field.path, quantity.definition,
             parameters_text(quantity.parameters, analysis.parameters));
  }
}

Values read_values(hdf5::Reader& reader, const DataSetField& field) {
  if (field.type == ElementType::int32) return reader.read<Index>(field);
  if (field.type == ElementType::float32) return reader.read<float>(field, hdf5::any_number);
  return reader.read<double>(field, hdf5::any_number);
}

/// The tilts of the frames that an analysis has rows for.
std::vector<double> analysed_tilts(const std::string& path) {
  hdf5::Reader reader = hdf5::Reader::from_file(path);
  std::vector<double> tilts = reader.read<double>("/frames/tilt");
  std::optional<std::int64_t> last_tilt_step;
  if (const std::string last = std::string("/checkpoint/integers/") + last_tilt_step_name; reader.has(last))
    last_tilt_step = reader.read_scalar<std::int64_t>(last);
  tilts.resize(frames_of_tilt(tilts, reader.read<std::int64_t>("/frames/step"), last_tilt_step));
  return tilts;
}

/// The frames, thresholds and events of a stored analysis, with nothing in them yet.
void make_records(hdf5::Reader& reader, const std::vector<double>& tilts, Analysis& analysis) {
  if (reader.has(analysis_group + "/threshold"))
    analysis.thresholds.resize(reader.row_count(analysis_group + "/threshold"));
  if (const std::string first = data_set_of(quantity_of(&EventRecord::begin)).path; reader.has(first))
    analysis.events.resize(reader.row_count(first));
  for (const double tilt : tilts) {
    analysis.frames.push_back({.tilt = tilt});
    analysis.frames.back().thresholds.resize(analysis.thresholds.size());
  }
}

/// Others take the rows of all these frames without looking.
void check_frame_count(const hdf5::Reader& reader, std::size_t rows, std::size_t frames) {
  if (rows != frames)
    reader.refuse(analysis_group,
                  fmt::format("(a group) has rows for {} frames, the tilt has {}", rows, frames));
}

/// The packed file at `path` without an analysis.
std::vector<std::byte> bare_bytes(const std::string& path, const std::string& state_hash) {
  verify_seal(path);
  std::vector<std::byte> bytes = read_file(path);
  hdf5::Reader reader = hdf5::Reader::from_memory(bytes, path, {});
  const std::string stored_hash = reader.has("/checkpoint") ? reader.read_text("/checkpoint/state_hash")
                                                            : hash_text(talus::state_hash(World{}));
  if (stored_hash != state_hash)
    throw Error(ExitCode::cannot_create,
                path + ": was replaced by another run while it was being analysed; analyse it again");
  // HDF5 leaves holes where something is removed from a file, so a file that has an analysis is packed again.
  if (!reader.has(analysis_group)) return bytes;
  const RunFile run = RunFile::open(path);
  return packed_bytes(content_of(run));
}

}  // namespace

std::optional<Analysis> read_analysis(const std::string& path, std::span<const Quantity> table) {
  verify_seal(path);
  hdf5::Reader reader = hdf5::Reader::from_file(path);
  if (!reader.has(analysis_group) ||
      reader.read_scalar<std::int32_t>(analysis_group + "/version") != analysis_version)
    return std::nullopt;
  Analysis analysis;
  analysis.key = reader.read_text(analysis_group + "/key");
  for (const std::string& name : reader.names(analysis_group + "/parameters"))
    analysis.parameters.emplace_back(name,
                                     reader.read_text(fmt::format("{}/parameters/{}", analysis_group, name)));
  const std::vector<double> tilts = analysed_tilts(path);
  check_frame_count(reader, reader.row_count(analysis_group + "/packing/volume"), tilts.size());
  reader.row_count("/particles/grains/id");  // how many grains there are
  make_records(reader, tilts, analysis);
  for (const Quantity& quantity : table)
    if (is_present(quantity, analysis))
      set_values(quantity, read_values(reader, data_set_of(quantity)), analysis);
  return analysis;
}

void store_analysis(const std::string& path, const Analysis& analysis, const std::string& state_hash,
                    std::span<const Quantity> table) {
  hdf5::Writer writer(sizes_of(analysis), seal_size, bare_bytes(path, state_hash), path);
  write_analysis(writer, analysis, table);
  std::vector<std::byte> file = writer.image();
  seal(file);
  // What a kill left of packing tells the file by its seal, which changes now.
  if (const std::string target = output_target(path); run_presence(target) == RunPresence::packed)
    discard_folder(target);
  prepare_folder_of(path);
  write_durably(path, file);
}

}  // namespace talus
