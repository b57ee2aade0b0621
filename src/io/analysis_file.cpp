#include "io/analysis_file.h"

#include <unistd.h>

#include <algorithm>

#include "core/errors.h"
#include "core/text_stream.h"
#include "io/durable_file.h"
#include "io/packed_file.h"
#include "io/run_records.h"

namespace talus {
namespace {

const std::string group = "/analysis";

/// "lc_cut = 40; joining = contacts": the parameters that a data set depends on, with their values.
std::string parameters_text(const AnalysisField& field, const Facts& parameters) {
  std::string text;
  std::istringstream names = text_stream(field.parameters);
  for (std::string name; names >> name;)
    for (const auto& [key, value] : parameters)
      if (key == name) text += (text.empty() ? "" : "; ") + name + " = " + value;
  return text.empty() ? "none" : text;
}

void write_array(hdf5::Writer& writer, const std::string& path, const AnalysisValues& values) {
  std::visit([&](const auto& array) { writer.write(path, array); }, values);
}

void write_analysis(hdf5::Writer& writer, const Analysis& analysis) {
  writer.write_scalar(group + "/version", analysis_version);
  writer.write_text(group + "/key", analysis.key);
  for (const auto& [name, value] : analysis.parameters)
    writer.write_text(group + "/parameters/" + name, value);
  for (const AnalysisField& field : analysis_schema()) {
    const std::string& path = field.data_set.path;
    if (is_array(field)) {
      if (!is_present(field, analysis.sizes)) continue;
      write_array(writer, path, find_data_set(analysis, analysis_name(field)));
    }
    if (path.ends_with("/*")) continue;
    writer.set_attribute(path, "definition", field.data_set.help);
    writer.set_attribute(path, "parameters", parameters_text(field, analysis.parameters));
  }
}

AnalysisValues read_array(hdf5::Reader& reader, const DataSetField& field) {
  if (field.type == ElementType::int32) return reader.read<Index>(field.path);
  if (field.type == ElementType::float32) return reader.read<float>(field.path);
  return reader.read<double>(field.path);
}

/// The sizes of the letters of a stored analysis, each from a data set whose shape begins with it.
Sizes stored_sizes(hdf5::Reader& reader) {
  Sizes sizes = {{'N', reader.row_count("/particles/grains/id")}};
  if (!reader.has(group + "/threshold")) sizes['F'] = 0;
  for (const AnalysisField& field : analysis_schema()) {
    if (!is_array(field) || field.data_set.shape.empty()) continue;
    const Extent first = extents(field.data_set).front();
    if (first.symbol != '\0' && !sizes.contains(first.symbol))
      sizes[first.symbol] = reader.row_count(field.data_set.path) - first.plus;
  }
  return sizes;
}

/// The frames of the tilt, those that an analysis has rows for.
std::size_t tilted_frames(const std::string& path) {
  const auto tilts = hdf5::Reader::from_file(path).read_finite("/frames/tilt");
  const auto highest = std::ranges::max_element(tilts);
  return static_cast<std::size_t>(highest - tilts.begin()) + (tilts.empty() ? 0 : 1);
}

/// Others take the rows of all these frames without looking.
void check_frame_count(const hdf5::Reader& reader, std::size_t rows, std::size_t frames) {
  if (rows != frames)
    reader.refuse(group, "(a group) has rows for " + std::to_string(rows) + " frames, the tilt has " +
                             std::to_string(frames));
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
                path + ": has become the file of another run while it was analysed; analyse it again");
  // HDF5 leaves holes where something is removed from a file, so a file that has an analysis is packed again.
  return reader.has(group) ? packed_bytes(RunFile::open(path)) : std::move(bytes);
}

}  // namespace

std::optional<Analysis> read_analysis(const std::string& path) {
  verify_seal(path);
  hdf5::Reader reader = hdf5::Reader::from_file(path);
  if (!reader.has(group) || reader.read_scalar<std::int32_t>(group + "/version") != analysis_version)
    return std::nullopt;
  Analysis analysis;
  analysis.key = reader.read_text(group + "/key");
  for (const std::string& name : reader.names(group + "/parameters"))
    analysis.parameters.emplace_back(name, reader.read_text(group + "/parameters/" + name));
  analysis.sizes = stored_sizes(reader);
  check_frame_count(reader, analysis.sizes.at('T'), tilted_frames(path));
  for (const AnalysisField& field : analysis_schema())
    if (is_array(field) && is_present(field, analysis.sizes))
      analysis.data_sets.emplace(analysis_name(field), read_array(reader, field.data_set));
  return analysis;
}

void store_analysis(const std::string& path, const Analysis& analysis, const std::string& state_hash) {
  hdf5::Writer writer(analysis.sizes, seal_size, bare_bytes(path, state_hash));
  write_analysis(writer, analysis);
  std::vector<std::byte> file = writer.image();
  seal(file);
  write_durably(path, file, path + ".tmp");
}

}  // namespace talus
