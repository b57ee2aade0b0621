#include <fmt/core.h>

#include "base/errors.h"
#include "base/text_stream.h"
#include "io/analysis_schema.h"
#include "io/run_records.h"

namespace talus::io {
namespace {

/// Returns the data sets of a stored analysis; none if it has another version, which is not interpreted.
std::vector<std::string> analysis_data_sets(hdf5::Reader& reader) {
  const std::string version = "/analysis/version", parameters = "/analysis/parameters";
  if (!reader.has("/analysis")) return {};
  if (is_as_written(reader, version) && reader.read_scalar<std::int32_t>(version) != analysis_version)
    return {};
  std::vector<std::string> paths;
  for (const DataSetField& field : analysis_schema())
    if (reader.has(field.path)) paths.push_back(field.path);
  for (const std::string& name : reader.names(parameters)) paths.push_back(parameters + "/" + name);
  for (const char* group : {"/readings/key", "/readings/value", "/readings/at_most"})
    if (reader.has(group))
      for (const std::string& name : reader.names(group)) paths.push_back(fmt::format("{}/{}", group, name));
  return paths;
}

void keep_changed(hdf5::Reader& reader, std::vector<std::string>& paths) {
  std::erase_if(paths, [&reader](const std::string& path) { return is_as_written(reader, path); });
}

}  // namespace

bool is_as_written(hdf5::Reader& reader, const std::string& path) try {
  return is_by_frame(field_of(path)) || reader.is_as_written(path);
} catch (const Error& error) {
  if (error.code() == ExitCode::out_of_memory) throw;
  return false;
}

std::vector<std::string> listed_data_sets(hdf5::Reader& reader) {
  std::vector<std::string> paths;
  std::istringstream lines = text_stream(reader.read_text("/contents"));
  for (std::string path; std::getline(lines, path);) paths.push_back(path);
  return paths;
}

std::vector<std::string> changed_data_sets(hdf5::Reader& reader) {
  std::vector<std::string> changed = listed_data_sets(reader);
  changed.emplace_back("/contents");
  keep_changed(reader, changed);
  hdf5::Reader reopened = reader.again();  // an analysis may have fewer frames
  std::vector<std::string> of_analysis = analysis_data_sets(reopened);
  keep_changed(reopened, of_analysis);
  changed.insert(changed.end(), of_analysis.begin(), of_analysis.end());
  return changed;
}

}  // namespace talus::io
