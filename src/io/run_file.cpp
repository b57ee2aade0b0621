#include "io/run_file.h"

#include <algorithm>
#include <fmt/core.h>
#include <functional>
#include <limits>

#include "base/errors.h"
#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/run_folder.h"
#include "io/run_records.h"

namespace talus::io {
namespace {

/// Checks that the state contains the grains of the run, except those not yet poured.
void check_grains(const Reader& reader, const RunStatics& statics, const Grains& grains) {
  const Index all = static_cast<Index>(statics.radius.size());
  if (grains.free_count <= statics.free_count &&
      grains.count() - grains.free_count == all - statics.free_count)
    return;
  reader.refuse("/checkpoint/free_count",
                fmt::format("is {} of {} grains, the run has {} of {}", grains.free_count, grains.count(),
                            statics.free_count, all));
}

/// Returns the letters of the shapes that a file must match.
Sizes sizes_of(const StoredSegment& segment, std::size_t grains) {
  return {{'T', segment.frames},
          {'M', segment.contacts},
          {'R', segment.observables},
          {'S', segment.steps},
          {'N', grains}};
}

Reader open_file_of(const std::string& folder, const StoredFile& file, const Sizes& known) {
  return Reader::from_memory(read_stored(folder, file), path_in(folder, file.name), known);
}

/// Describes a packed file as one segment of a manifest.
StoredSegment whole_file(Reader& reader) {
  StoredSegment segment;
  segment.frames = reader.row_count("/frames/tilt");
  if (reader.has("/contacts")) segment.contacts = reader.row_count("/contacts/pair");
  return segment;
}

/// Whether a row of a series, which begins with its step, belongs to the first `last` steps; names always do.
template <typename Row>
bool is_known(const Row& row, std::int64_t last) {
  if constexpr (std::is_same_v<Row, std::string>)
    return true;
  else
    return row.front() <= static_cast<double>(last);
}

/// Last step before the flow of a run that has none.
constexpr std::int64_t no_flow = std::numeric_limits<std::int64_t>::max();

}  // namespace

/// An open run. A packed file is one segment that is always open; of a folder, the segment used last is open.
struct RunFile::State {
  std::string folder;  ///< empty for a packed file
  RunHeader header;
  Checkpoint checkpoint;
  std::vector<StoredSegment> segments;
  std::string name;  ///< name in messages
  std::vector<double> all_tilts, all_times;
  std::vector<Command> commands;
  std::vector<OwnQuantity> own;
  std::vector<std::int64_t> all_steps;
  bool has_frames = true;
  std::vector<double> tilts;        ///< tilts of the frames that belong to the tilt
  std::int64_t last_tilt_step = 0;  ///< frames and rows of later steps belong to the flow
  std::size_t open_segment = 0;
  std::optional<Reader> reader;
  bool packed_since =
      false;  ///< the folder was packed after it was opened, and `reader` reads the packed file

  Reader& segment(std::size_t s) {
    if (packed_since || (reader && open_segment == s)) return *reader;
    try {
      const Sizes sizes = sizes_of(segments[s], header.statics.radius.size());
      reader = open_file_of(folder, segments[s].file, sizes);
      open_segment = s;
    } catch (const Error&) {
      if (!follow_packing()) throw;
    }
    return *reader;
  }

  /// Switches to the file into which the writer of this folder has packed the run since it was opened;
  /// returns false if there is none. Known data remain valid, because the file begins with them.
  bool follow_packing() {
    if (folder.empty() || is_there(path_in(folder, Manifest::file_name))) return false;
    const std::string path = run_of_folder(folder);
    if (!is_file(path)) return false;
    verify_seal(path);
    reader = Reader::from_file(path);
    const RunHeader now = read_header(*reader);
    if (now.scenario_resolved != header.scenario_resolved || now.seed != header.seed)
      throw Error(ExitCode::missing_input,
                  path + ": was replaced by another run while it was being read; open it again");
    whole_file(*reader);  // establishes the sizes that its data sets must match
    packed_since = true;
    return true;
  }

  /// The location of frame k.
  struct FramePlace {
    Reader& reader;
    std::size_t row;
  };
  FramePlace place_of(const std::size_t k) {
    std::size_t s = 0, in_segment = k;
    for (; s < segments.size() && in_segment >= segments[s].frames; ++s) in_segment -= segments[s].frames;
    if (s == segments.size()) throw Error(ExitCode::internal, "the run has only {} frames", all_tilts.size());
    Reader& from = segment(s);
    return {from, packed_since ? k : in_segment};
  }

  /// Returns what `record` reads of frame k from its segment.
  Frame read(Frame (*record)(Reader&, std::size_t), std::size_t k) {
    if (!has_frames)
      throw Error(ExitCode::missing_input,
                  "{} has no frames: it was kept for its analysis alone (--keep analysis); compute "
                  "it again with talus run for pictures",
                  name);
    const FramePlace place = place_of(k);
    Frame frame = record(place.reader, place.row);
    check_frame(place.reader, frame, farthest_place(header.statics), plane_count());
    frame.friction = friction_of_frame(k);
    return frame;
  }

  /// Returns the rows that `record` reads from all segments; if the run was packed since it was opened, only
  /// rows up to the last step that was known then.
  template <typename Row>
  std::vector<Row> rows(std::vector<Row> (*record)(Reader&)) {
    std::vector<Row> all;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      Reader& from = segment(s);
      if (packed_since) {
        all = record(from);
        std::erase_if(all, [&](const Row& row) { return !is_known(row, checkpoint.world.step); });
        return all;
      }
      append(all, record(from));
    }
    return all;
  }

  /// The number is unknown without the last state; two walls and a floor are the maximum.
  std::size_t plane_count() const {
    return checkpoint.world.grains.count() == 0 ? 3 : checkpoint.world.boundary.planes.size();
  }

  std::optional<double> commanded_friction(std::int64_t step) const {
    std::optional<double> friction;
    if (header.branch) friction = find_value(header.branch->start.reals, "friction");
    for (const Command& command : commands)
      if (command.kind == CommandKind::friction && command.step < step) friction = command.x;
    return friction;
  }

  Friction friction_of_frame(std::size_t k) const {
    // A branch begins with the forces of the last step of its parent run; earlier versions have not stored
    // the friction of that step.
    if (header.branch && all_steps[k] == header.branch->start.world.step) {
      const Figures& reals = header.branch->start.reals;
      const auto grains = find_value(reals, "last_friction"), walls = find_value(reals, "last_wall_friction");
      if (grains && walls) return {*grains, *walls};
    }
    const bool follows_deposition = k == 0 && all_tilts[k] == 0.0;
    Friction friction = follows_deposition ? header.deposition_friction : header.friction;
    friction.grains = commanded_friction(all_steps[k]).value_or(friction.grains);
    return friction;
  }

  void read_tilts() {
    for (std::size_t s = 0; s < segments.size(); ++s) {
      Reader& from = segment(s);
      if (packed_since)
        throw Error(ExitCode::missing_input, folder + ": was packed while it was being read; open it again");
      append(all_tilts, from.read<double>("/frames/tilt"));
      append(all_times, from.read<double>("/frames/time"));
      append(all_steps, from.read<std::int64_t>("/frames/step"));
      append(commands, read_commands(from));
    }
    last_tilt_step = checkpoint.world.grains.count() > 0 ? step_before_flow() : step_before_recorded_flow();
    // A branch that begins in a flow shows its start.
    if (!all_steps.empty()) last_tilt_step = std::max(last_tilt_step, all_steps.front());
    const auto count = std::ranges::upper_bound(all_steps, last_tilt_step) - all_steps.begin();
    tilts.assign(all_tilts.begin(), all_tilts.begin() + count);
  }

  /// Returns the last step before the flow after failure, whose steps are the last of a run that follows it.
  std::int64_t step_before_flow() const {
    const std::int64_t last = checkpoint.world.step;
    const std::int64_t flow_steps = find_value(checkpoint.integers, flow_steps_name).value_or(0);
    return flow_steps > 0 && flow_steps <= last ? last - flow_steps : no_flow;
  }

  /// Returns the same for a repaired run that has lost its last state, from the phases of its steps.
  std::int64_t step_before_recorded_flow() {
    constexpr double flow = 3.0;
    const std::vector<StepRow> steps = rows(read_steps);
    const auto first =
        std::ranges::find(steps, flow, [](const StepRow& row) { return at(row, StepField::phase); });
    if (first == steps.end()) return no_flow;
    return static_cast<std::int64_t>(at(*first, StepField::step)) - 1;
  }
};

/// Reads the manifest of a folder; empty if it no longer exists.
static std::string find_manifest(const std::string& folder) {
  const std::string manifest = path_in(folder, Manifest::file_name);
  try {
    return read_text(manifest);
  } catch (const Error&) {
    if (is_there(manifest)) throw;
    return {};
  }
}

/// Returns the folder of a run, or nothing if `path` is a packed file.
static std::optional<std::string> folder_to_read(const std::string& path) {
  if (run_presence(path) == RunPresence::packed) return std::nullopt;
  for (const std::string& folder : {path, run_folder(path)})
    if (is_there(path_in(folder, Manifest::file_name))) return folder;
  if (is_file(path)) return std::nullopt;  // packed at this moment
  refuse_no_run(path);
}

RunFile::RunFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
RunFile::RunFile(RunFile&&) noexcept = default;
RunFile& RunFile::operator=(RunFile&&) noexcept = default;
RunFile::~RunFile() = default;

RunFile RunFile::from_bytes(std::vector<std::byte> bytes, const std::string& name) {
  return read_packed(Reader::from_memory(std::move(bytes), name, {}), name);
}

RunFile RunFile::read_packed(Reader&& reader, const std::string& name) {
  auto state = std::make_unique<State>();
  state->name = name;
  state->has_frames = reader.has("/contacts") || reader.has("/frames/hash");
  state->reader = std::move(reader);
  state->header = read_header(*state->reader);
  const bool was_repaired = find_value(state->header.provenance, lost_fact).has_value();
  if (was_repaired && !state->reader->has("/checkpoint")) {
    state->checkpoint = read_results(*state->reader);
  } else {
    state->checkpoint = read_checkpoint(*state->reader);
    check_grains(*state->reader, state->header.statics, state->checkpoint.world.grains);
  }
  state->segments = {whole_file(*state->reader)};
  if (state->has_frames)
    for (const std::string& path : own_data_sets(*state->reader))
      state->own.push_back(read_own_head(*state->reader, path));
  state->read_tilts();
  return RunFile(std::move(state));
}

RunFile RunFile::open_folder(const std::string& folder) {
  const Manifest manifest = read_manifest(folder);
  auto state = std::make_unique<State>();
  state->folder = folder;
  // Read first, because the next commit replaces it.
  Reader checkpoint = open_file_of(folder, manifest.checkpoint, {});
  Reader header = open_file_of(folder, manifest.header, {});
  state->header = read_header(header);
  state->checkpoint = read_checkpoint(checkpoint);
  check_grains(checkpoint, state->header.statics, state->checkpoint.world.grains);
  state->segments = manifest.segments;
  state->read_tilts();
  return RunFile(std::move(state));
}

RunFile RunFile::open(const std::string& path) {
  for (int attempts_left = 20;; --attempts_left) {
    const std::optional<std::string> folder = folder_to_read(path);
    try_run(folder.value_or(path));
    if (!folder) {
      verify_seal(path);
      return read_packed(Reader::from_file(path), path);
    }
    const std::string before = find_manifest(*folder);
    try {
      return open_folder(*folder);
    } catch (const Error&) {
      // A writer at work replaces the checkpoint, and finally packs the folder. In these cases, retry.
      const bool changed = before.empty() || find_manifest(*folder) != before;
      if (!changed || attempts_left == 0) throw;
    }
  }
}

const RunHeader& RunFile::header() const { return state_->header; }
bool RunFile::complete() const { return state_->folder.empty(); }
const std::vector<double>& RunFile::frame_tilts() const { return state_->tilts; }
const std::vector<double>& RunFile::all_frame_tilts() const { return state_->all_tilts; }
const std::vector<double>& RunFile::all_frame_times() const { return state_->all_times; }
bool RunFile::has_program() const {
  return find_value(state_->checkpoint.integers, last_tilt_step_name).has_value();
}
bool RunFile::goes_by_time() const {
  return has_program() ||
         std::ranges::adjacent_find(frame_tilts(), std::greater_equal()) != frame_tilts().end();
}
const Checkpoint& RunFile::checkpoint() const { return state_->checkpoint; }

std::string RunFile::lost() const { return find_value(state_->header.provenance, lost_fact).value_or(""); }

std::uint64_t RunFile::contact_count() const {
  std::uint64_t count = 0;
  for (const StoredSegment& segment : state_->segments) count += segment.contacts;
  return count;
}

Frame RunFile::stored_frame(std::size_t k) const { return state_->read(read_frame, k); }

Frame RunFile::frame(std::size_t k) const {
  Frame frame = stored_frame(k);
  frame.own = state_->own;
  for (OwnQuantity& own : frame.own)
    own.values = read_own_values(*state_->reader, own,
                                 own.of_grains ? hdf5::Rows{k, 1} : contact_rows(*state_->reader, k));
  remove_open_contacts(frame, force_threshold(header().statics));
  return frame;
}

const std::vector<OwnQuantity>& RunFile::own() const { return state_->own; }

bool RunFile::has_frames() const { return state_->has_frames; }

Frame RunFile::instant(std::size_t k) const {
  Frame frame;
  frame.step = state_->all_steps.at(k);
  frame.time = state_->all_times.at(k);
  frame.tilt = state_->all_tilts.at(k);
  return frame;
}

Reader RunFile::packed_reader() const { return state_->reader->again(); }

bool RunFile::is_as_written(const Frame& frame, std::size_t k) const {
  const State::FramePlace place = state_->place_of(k);
  return place.reader.read<std::uint64_t>("/frames/hash", {}, hdf5::Rows{place.row, 1}).front() ==
         frame_hash(frame);
}

std::vector<std::string> RunFile::changed_data_sets() const {
  return state_->rows<std::string>(talus::io::changed_data_sets);
}

Frame RunFile::positions(std::size_t k) const { return state_->read(read_positions, k); }

std::vector<ObservableRow> RunFile::observables() const {
  std::vector<ObservableRow> rows = all_observables();
  std::erase_if(rows, [&](const ObservableRow& row) { return !is_known(row, state_->last_tilt_step); });
  return rows;
}

std::vector<ObservableRow> RunFile::all_observables() const { return state_->rows(read_observables); }

std::vector<StepRow> RunFile::steps() const { return state_->rows(read_steps); }

std::vector<TrialRow> RunFile::trials() const { return state_->rows(read_trials); }

const std::vector<Command>& RunFile::commands() const { return state_->commands; }

std::optional<double> RunFile::commanded_friction(std::int64_t step) const {
  return state_->commanded_friction(step);
}

Friction RunFile::friction_of_frame(std::size_t k) const { return state_->friction_of_frame(k); }

}  // namespace talus::io
