#include "io/run_file.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/errors.h"
#include "io/durable_file.h"
#include "io/manifest.h"
#include "io/packed_file.h"
#include "io/run_records.h"
#include "io/structure_probe.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// The state of a run has its grains, but for those that have not arrived yet while it is poured.
void check_grains(const hdf5::Reader& reader, const RunStatics& statics, const Grains& grains) {
  const Index all = static_cast<Index>(statics.radius.size());
  if (grains.free_count <= statics.free_count &&
      grains.count() - grains.free_count == all - statics.free_count)
    return;
  reader.refuse("/checkpoint/free_count", "is " + std::to_string(grains.free_count) + " of " +
                                              std::to_string(grains.count()) + " grains, the run has " +
                                              std::to_string(statics.free_count) + " of " +
                                              std::to_string(all));
}

/// Sizes of the letters of the shapes that a file must agree with.
Sizes sizes_of(const StoredSegment& segment, std::size_t grains) {
  return {{'T', segment.frames},
          {'M', segment.contacts},
          {'R', segment.observables},
          {'S', segment.steps},
          {'N', grains}};
}

hdf5::Reader open_image_of(const std::string& folder, const StoredFile& file, std::vector<std::byte> bytes,
                           const Sizes& known) {
  return hdf5::Reader::from_memory(std::move(bytes), (fs::path(folder) / file.name).string(), known);
}

template <typename Row>
void append(std::vector<Row>& rows, const std::vector<Row>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace

/// A packed file is one segment that is open all the time; of a folder the segment used last is open.
struct RunFile::State {
  std::string folder;  ///< empty for a packed file
  RunHeader header;
  Checkpoint checkpoint;
  std::vector<StoredSegment> segments;
  std::vector<double> all_tilts;
  std::vector<double> tilts;  ///< of the frames up to the highest tilt
  std::size_t open_segment = 0;
  std::optional<hdf5::Reader> reader;

  hdf5::Reader& segment(std::size_t s) {
    if (!reader || open_segment != s) {
      const StoredFile& file = segments[s].file;
      const Sizes sizes = sizes_of(segments[s], header.statics.radius.size());
      reader = open_image_of(folder, file, read_stored(folder, file), sizes);
      open_segment = s;
    }
    return *reader;
  }

  /// What `record` reads of frame k, from the segment that holds it.
  Frame read(Frame (*record)(hdf5::Reader&, std::size_t), std::size_t k) {
    std::size_t s = 0;
    for (; s < segments.size() && k >= segments[s].frames; ++s) k -= segments[s].frames;
    if (s == segments.size())
      throw Error(ExitCode::internal, "the run has " + std::to_string(all_tilts.size()) + " frames only");
    Frame frame = record(segment(s), k);
    check_frame(segment(s), frame, header.statics, plane_count());
    return frame;
  }

  /// Without its last state a run does not tell; two walls and a floor are the most that there can be.
  std::size_t plane_count() const {
    return checkpoint.world.grains.count() == 0 ? 3 : checkpoint.world.boundary.planes.size();
  }

  void read_tilts() {
    for (std::size_t s = 0; s < segments.size(); ++s)
      append(all_tilts, segment(s).read_finite("/frames/tilt"));
    const auto highest = std::ranges::max_element(all_tilts);
    tilts.assign(all_tilts.begin(), highest == all_tilts.end() ? highest : std::next(highest));
  }
};

namespace {

/// What a packed file says of itself, in the words of a manifest.
StoredSegment whole_file(hdf5::Reader& reader) {
  StoredSegment segment;
  segment.frames = reader.row_count("/frames/tilt");
  segment.contacts = reader.row_count("/contacts/pair");
  return segment;
}

[[noreturn]] void refuse_absent(const std::string& path) {
  std::error_code unknown;
  if (fs::is_directory(run_folder(path), unknown))
    throw Error(ExitCode::missing_input,
                run_folder(path) +
                    ": nothing is committed there yet; wait for the first "
                    "checkpoint, or start again: talus run ... --resume; where it was damaged, "
                    "keep what is whole: talus repair");
  throw Error(ExitCode::missing_input,
              path + ": no such run; expected a run file, or a folder " + run_folder(path));
}

/// The folder of a run, or nothing where `path` is a packed file.
std::optional<std::string> folder_to_read(const std::string& path) {
  std::error_code unknown;
  if (fs::is_regular_file(path, unknown)) return std::nullopt;
  for (const std::string& folder : {path, run_folder(path)})
    if (fs::exists(fs::path(folder) / Manifest::file_name, unknown)) return folder;
  refuse_absent(path);
}

}  // namespace

RunFile::RunFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
RunFile::RunFile(RunFile&&) noexcept = default;
RunFile& RunFile::operator=(RunFile&&) noexcept = default;
RunFile::~RunFile() = default;

RunFile RunFile::open_packed(const std::string& path) {
  verify_seal(path);
  probe_packed(path);
  return read_packed(hdf5::Reader::from_file(path));
}

RunFile RunFile::of_bytes(std::vector<std::byte> bytes, const std::string& name) {
  return read_packed(hdf5::Reader::from_memory(std::move(bytes), name, {}));
}

RunFile RunFile::read_packed(hdf5::Reader&& reader) {
  auto state = std::make_unique<State>();
  state->reader = std::move(reader);
  state->header = read_header(*state->reader);
  const bool may_lack = find_value(state->header.provenance, lost_fact).has_value();
  if (may_lack && !state->reader->has("/checkpoint")) {
    state->checkpoint = read_results(*state->reader);
  } else {
    state->checkpoint = read_checkpoint(*state->reader);
    check_grains(*state->reader, state->header.statics, state->checkpoint.world.grains);
  }
  state->segments = {whole_file(*state->reader)};
  state->read_tilts();
  return RunFile(std::move(state));
}

RunFile RunFile::open_folder(const std::string& folder) {
  const Manifest manifest = read_manifest(folder);
  std::vector<std::vector<std::byte>> files = {read_stored(folder, manifest.header),
                                               read_stored(folder, manifest.checkpoint)};
  probe_folder(folder, files, manifest.segments);
  auto state = std::make_unique<State>();
  state->folder = folder;
  hdf5::Reader header = open_image_of(folder, manifest.header, std::move(files[0]), {});
  state->header = read_header(header);
  hdf5::Reader checkpoint = open_image_of(folder, manifest.checkpoint, std::move(files[1]), {});
  state->checkpoint = read_checkpoint(checkpoint);
  check_grains(checkpoint, state->header.statics, state->checkpoint.world.grains);
  state->segments = manifest.segments;
  state->read_tilts();
  return RunFile(std::move(state));
}

RunFile RunFile::open(const std::string& path) {
  for (int attempts_left = 5;; --attempts_left) {
    const std::optional<std::string> folder = folder_to_read(path);
    if (!folder) return open_packed(path);
    const auto before = read_file((fs::path(*folder) / Manifest::file_name).string());
    try {
      return open_folder(*folder);
    } catch (const Error&) {
      // A writer at work replaces the checkpoint, and at the end packs the folder away: then look again.
      const auto manifest = fs::path(*folder) / Manifest::file_name;
      const bool changed = !fs::exists(manifest) || read_file(manifest.string()) != before;
      if (!changed || attempts_left == 0) throw;
    }
  }
}

const RunHeader& RunFile::header() const { return state_->header; }
bool RunFile::complete() const { return state_->folder.empty(); }
const std::vector<double>& RunFile::frame_tilts() const { return state_->tilts; }
const std::vector<double>& RunFile::all_frame_tilts() const { return state_->all_tilts; }
const Checkpoint& RunFile::checkpoint() const { return state_->checkpoint; }

std::string RunFile::lost() const { return find_value(state_->header.provenance, lost_fact).value_or(""); }

std::uint64_t RunFile::contact_count() const {
  std::uint64_t count = 0;
  for (const StoredSegment& segment : state_->segments) count += segment.contacts;
  return count;
}

Frame RunFile::frame(std::size_t k) const { return state_->read(read_frame, k); }
Frame RunFile::positions(std::size_t k) const { return state_->read(read_positions, k); }

std::vector<ObservableRow> RunFile::observables() const {
  std::vector<ObservableRow> rows = all_observables();
  const auto highest =
      std::ranges::max_element(rows, {}, [](const ObservableRow& row) { return at(row, Observable::tilt); });
  if (highest != rows.end()) rows.erase(std::next(highest), rows.end());
  return rows;
}

std::vector<ObservableRow> RunFile::all_observables() const {
  std::vector<ObservableRow> rows;
  for (std::size_t s = 0; s < state_->segments.size(); ++s)
    append(rows, read_observables(state_->segment(s)));
  return rows;
}

std::vector<StepRow> RunFile::steps() const {
  std::vector<StepRow> rows;
  for (std::size_t s = 0; s < state_->segments.size(); ++s) append(rows, read_steps(state_->segment(s)));
  return rows;
}

std::vector<Command> RunFile::commands() const {
  std::vector<Command> commands;
  for (std::size_t s = 0; s < state_->segments.size(); ++s)
    append(commands, read_commands(state_->segment(s)));
  return commands;
}

}  // namespace talus
