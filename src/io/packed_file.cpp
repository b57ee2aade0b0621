#include "io/packed_file.h"

#include <algorithm>
#include <filesystem>
#include <fmt/core.h>

#include "base/errors.h"
#include "base/hash.h"
#include "base/text.h"
#include "base/version.h"
#include "io/durable_file.h"
#include "io/run_records.h"

namespace talus::io {

/// Thrown to leave write_frames.
struct Interruption {};

/// Writes the metadata that H5MD 1.1 requires.
static void write_h5md(Writer& writer, bool periodic) {
  writer.set_attribute("/h5md", "version", std::vector<std::int32_t>{1, 1});
  writer.set_attribute("/h5md/author", "name", "unspecified");
  writer.set_attribute("/h5md/creator", "name", "talus");
  writer.set_attribute("/h5md/creator", "version", version);
  const std::string box = "/particles/grains/box";
  writer.set_attribute(box, "dimension", std::vector<std::int32_t>{2});
  writer.set_attribute(box, "boundary", std::vector<std::string>{periodic ? "periodic" : "none", "none"});
}

bool is_run(const std::string& path) {
  const std::filesystem::path ending = std::filesystem::path(path).extension();
  return ending == ".h5" || ending == ".run" || is_folder(path) || begins_as_run(path) ||
         begins_with(path, hdf5_signature);
}

RunContent content_of(const RunFile& run, bool with_frames) {
  const bool whole = with_frames && run.has_frames();
  return {run.header(),
          run.checkpoint(),
          {{}, run.all_observables(), run.steps(), run.commands(), run.trials()},
          run.all_frame_tilts().size(),
          run.contact_count(),
          [&run, whole](std::size_t k) { return whole ? run.stored_frame(k) : run.instant(k); },
          whole};
}

bool lacks_state(const RunHeader& header, const Checkpoint& checkpoint) {
  return find_value(header.provenance, lost_fact) && checkpoint.world.grains.count() == 0;
}

std::vector<std::byte> packed_bytes(const RunContent& run, const std::function<bool()>& should_continue) try {
  const World& world = run.checkpoint.world;
  Sizes sizes = {{'T', run.frames},
                 {'N', run.header.statics.radius.size()},
                 {'M', run.contacts},
                 {'G', world.grains.radius.size()},
                 {'C', world.contacts.a.size()},
                 {'P', world.boundary.planes.size()}};
  sizes.merge(sizes_of(run.series));
  Writer writer(with_branch(std::move(sizes), run.header), seal_size);
  write_header(writer, run.header);
  write_h5md(writer, run.header.statics.periodic);
  const auto frame_at = [&](std::size_t k) {
    if (should_continue && !should_continue()) throw Interruption{};
    return run.frame_at(k);
  };
  if (run.has_frames)
    write_frames(writer, frame_at);
  else
    write_instants(writer, frame_at);
  write_series(writer, run.series);
  if (lacks_state(run.header, run.checkpoint))
    write_results(writer, run.checkpoint);
  else
    write_checkpoint(writer, run.checkpoint);
  writer.write_contents();
  writer.write_help(run_schema());
  return sealed(writer.image());
} catch (const Interruption&) {
  return {};
}

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

void describe(Writer& writer, const std::string& path, const std::string& definition,
              const std::string& parameters) {
  writer.set_attribute(path, "definition", definition);
  writer.set_attribute(path, "parameters", parameters);
}

void write_analysis(Writer& writer, const analysis::Analysis& analysis,
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

analysis::Values read_values(Reader& reader, const DataSetField& field) {
  if (field.type == ElementType::int32) return reader.read<Index>(field);
  if (field.type == ElementType::float32) return reader.read<float>(field, hdf5::any_number);
  return reader.read<double>(field, hdf5::any_number);
}

/// Creates the empty frames, thresholds and events of a stored analysis.
void make_records(Reader& reader, const std::vector<double>& tilts, analysis::Analysis& analysis) {
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

/// Returns the packed file at `path` without an analysis.
std::vector<std::byte> bare_bytes(const std::string& path, const std::string& state_hash, bool keep_frames) {
  verify_seal(path);
  std::vector<std::byte> bytes = read_file(path);
  const RunFile run = RunFile::from_bytes(bytes, path);
  if (hash_text(talus::state_hash(run.checkpoint().world)) != state_hash)
    throw Error(ExitCode::cannot_create,
                path + ": was replaced by another run while it was being analysed; analyse it again");
  // HDF5 leaves holes after a removal, so the file is packed again.
  if (!run.packed_reader().has(analysis_group) && run.own().empty() && keep_frames) return bytes;
  return packed_bytes(content_of(run, keep_frames));
}

/// Data stored with a run after it was computed.
struct Additions {
  std::optional<analysis::Analysis> analysis;
  std::vector<StoredReading> readings;
  std::vector<OwnQuantity> own;
};

/// Replaces the packed file of `run` by one with these additions, those of frames only with `keep_frames`.
void replace_packed(const std::string& path, const RunFile& run, const std::string& state_hash,
                    const Additions& more, std::span<const analysis::Quantity> table = analysis::quantities(),
                    bool keep_frames = true) {
  std::vector<std::byte> file = bare_bytes(path, state_hash, keep_frames);
  if (more.analysis) file = with_analysis(file, path, *more.analysis, more.readings, table);
  if (keep_frames && !more.own.empty())
    file = with_own(file, path,
                    {{'T', run.all_frame_tilts().size()},
                     {'N', run.header().statics.radius.size()},
                     {'M', run.contact_count()}},
                    more.own);
  // After a kill during packing, the leftover folder identifies its file by the seal, which changes here.
  if (const std::string target = output_target(path); run_presence(target) == RunPresence::packed)
    discard_folder(target);
  prepare_folder_of(path);
  write_durably(path, file);
}

}  // namespace

std::optional<analysis::Analysis> read_analysis(const RunFile& run,
                                                std::span<const analysis::Quantity> table) {
  if (!run.complete()) return std::nullopt;
  Reader reader = run.packed_reader();
  if (!reader.has(analysis_group) ||
      reader.read_scalar<std::int32_t>(analysis_group + "/version") != analysis_version)
    return std::nullopt;
  analysis::Analysis analysis;
  analysis.key = reader.read_text(analysis_group + "/key");
  for (const std::string& name : reader.names(analysis_group + "/parameters"))
    analysis.parameters.emplace_back(name,
                                     reader.read_text(fmt::format("{}/parameters/{}", analysis_group, name)));
  const std::vector<double>& tilts = run.frame_tilts();
  // Other code reads the rows of all these frames without a check.
  if (const std::uint64_t rows = reader.row_count(analysis_group + "/packing/volume"); rows != tilts.size())
    reader.refuse(analysis_group,
                  fmt::format("(a group) has rows for {} frames, the tilt has {}", rows, tilts.size()));
  reader.row_count("/particles/grains/id");  // establishes the number of grains
  make_records(reader, tilts, analysis);
  for (const analysis::Quantity& quantity : table)
    if (is_present(quantity, analysis))
      analysis::set_values(quantity, read_values(reader, data_set_of(quantity)), analysis);
  return analysis;
}

std::vector<StoredReading> read_readings(const RunFile& run) {
  if (!run.complete()) return {};
  Reader reader = run.packed_reader();
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
  Writer writer(std::move(sizes), seal_size, packed, name);
  write_analysis(writer, analysis, table);
  for (const StoredReading& reading : readings) {
    writer.write_text("/readings/key/" + reading.name, reading.key);
    writer.write("/readings/value/" + reading.name, reading.values);
    writer.write("/readings/at_most/" + reading.name, reading.at_most);
  }
  return sealed(writer.image());
}

std::vector<OwnQuantity> read_own(const RunFile& run) {
  std::vector<OwnQuantity> all = run.own();
  if (all.empty()) return all;
  Reader reader = run.packed_reader();
  for (OwnQuantity& own : all) own.values = read_own_values(reader, own);
  return all;
}

std::vector<std::byte> with_own(const std::vector<std::byte>& packed, const std::string& name, Sizes sizes,
                                const std::vector<OwnQuantity>& own) {
  Writer writer(std::move(sizes), seal_size, packed, name);
  for (const OwnQuantity& quantity : own) write_own(writer, quantity);
  return sealed(writer.image());
}

void store_analysis(const std::string& path, const analysis::Analysis& analysis,
                    const std::string& state_hash, std::span<const analysis::Quantity> table,
                    bool keep_frames) {
  const RunFile run = RunFile::open(path);
  replace_packed(path, run, state_hash, {analysis, read_readings(run), read_own(run)}, table, keep_frames);
}

void store_readings(const std::string& path, const std::vector<StoredReading>& readings,
                    const std::string& state_hash) {
  const RunFile run = RunFile::open(path);
  std::optional<analysis::Analysis> analysis = read_analysis(run);
  if (!analysis) throw Error(ExitCode::bad_data, path + " has no analysis of this version of Talus");
  replace_packed(path, run, state_hash, {std::move(analysis), readings, read_own(run)});
}

void store_own(const std::string& path, const OwnQuantity& own, const std::string& state_hash) {
  const RunFile run = RunFile::open(path);
  std::vector<OwnQuantity> all = read_own(run);
  std::erase_if(all, [&own](const OwnQuantity& other) { return other.name == own.name; });
  all.push_back(own);
  std::ranges::sort(all, {}, path_of);  // equal contents give equal bytes
  replace_packed(path, run, state_hash, {read_analysis(run), read_readings(run), std::move(all)});
}

}  // namespace talus::io
