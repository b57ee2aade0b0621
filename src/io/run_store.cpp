#include "io/run_store.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <system_error>

#include "core/errors.h"
#include "io/durable_file.h"
#include "io/manifest.h"
#include "io/packed_file.h"
#include "io/run_records.h"
#include "io/writer_lock.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

constexpr const char* temporary_suffix = ".tmp";

std::string in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string serial_name(const char* kind, std::uint64_t serial) {
  const std::string digits = std::to_string(serial);
  return kind + std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits + ".h5";
}

std::uint64_t serial_of(const StoredFile& checkpoint) {
  const auto digit = checkpoint.name.find_first_of("0123456789");
  return digit == std::string::npos ? 0 : std::stoull(checkpoint.name.substr(digit));
}

/// Whether a file of this name is the store's own: no other is ever removed.
bool is_own(const std::string& name) {
  return name == Manifest::header_name || name == Manifest::file_name || name.ends_with(temporary_suffix) ||
         (name.ends_with(".h5") && (name.starts_with("segment_") || name.starts_with("checkpoint_")));
}

bool is_named(const Manifest& manifest, const std::string& name) {
  return name == Manifest::file_name || name == manifest.header.name || name == manifest.checkpoint.name ||
         std::ranges::any_of(manifest.segments,
                             [&](const auto& segment) { return segment.file.name == name; });
}

/// The checkpoint of the commit before the last; empty where there is none.
std::string spare_checkpoint(const std::string& folder, const Manifest& manifest) {
  std::string spare;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string();
        name.starts_with("checkpoint_") && name.ends_with(".h5") &&
        name.size() == manifest.checkpoint.name.size() && name < manifest.checkpoint.name)
      spare = std::max(spare, name);
  return spare;
}

/// Removes what a kill left behind: own files that the manifest does not name, but for the spare checkpoint.
void remove_leftovers(const std::string& folder, const Manifest& manifest, const std::string& spare) {
  std::vector<std::string> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (const std::string name = entry.path().filename().string();
        is_own(name) && !is_named(manifest, name) && name != spare)
      leftovers.push_back(name);
  for (const std::string& name : leftovers) remove_file(in(folder, name));
}

/// Removes the folder of a packed run, the lock last. What cannot be removed stays and does no harm; so does
/// a folder where somebody keeps other files.
void remove_folder(const std::string& folder) {
  ::unlink(in(folder, Manifest::file_name).c_str());
  std::error_code unknown;
  std::vector<std::string> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, unknown))
    if (is_own(entry.path().filename().string())) paths.push_back(entry.path().string());
  for (const std::string& path : paths) ::unlink(path.c_str());
  ::unlink(in(folder, WriterLock::file_name).c_str());
  ::rmdir(folder.c_str());
}

StoredFile store(const std::string& folder, const std::string& name, std::span<const std::byte> bytes) {
  const std::string path = in(folder, name);
  write_durably(path, bytes, path + temporary_suffix);
  return describe(name, bytes);
}

std::vector<std::byte> header_bytes(const RunHeader& header) {
  hdf5::Writer writer({{'N', header.statics.radius.size()}});
  write_header(writer, header);
  return writer.image();
}

std::vector<std::byte> checkpoint_bytes(const Checkpoint& checkpoint) {
  const World& world = checkpoint.world;
  hdf5::Writer writer({{'G', world.grains.radius.size()},
                       {'C', world.contacts.a.size()},
                       {'P', world.boundary.planes.size()}});
  write_checkpoint(writer, checkpoint);
  return writer.image();
}

StoredSegment store_segment(const std::string& folder, const std::string& name, const Segment& segment,
                            std::size_t grains) {
  StoredSegment stored;
  stored.frames = segment.frames.size();
  stored.observables = segment.observables.size();
  stored.steps = segment.steps.size();
  for (const Frame& frame : segment.frames) stored.contacts += frame.contacts.a.size();
  hdf5::Writer writer({{'T', stored.frames},
                       {'N', grains},
                       {'M', stored.contacts},
                       {'R', stored.observables},
                       {'S', stored.steps},
                       {'K', segment.commands.size()}});
  write_frames(writer, [&segment](std::size_t k) { return segment.frames[k]; });
  write_observables(writer, segment.observables);
  write_steps(writer, segment.steps);
  write_commands(writer, segment.commands);
  stored.file = store(folder, name, writer.image());
  return stored;
}

bool is_empty(const Segment& segment) {
  return segment.frames.empty() && segment.observables.empty() && segment.steps.empty() &&
         segment.commands.empty();
}

void refuse_existing(const std::string& path, bool overwrite) {
  std::error_code unknown;
  if (fs::is_directory(path, unknown))
    throw Error(ExitCode::cannot_create, path + " is a folder; choose another output with -o");
  if (overwrite || run_presence(path) == RunPresence::none) return;
  throw Error(ExitCode::cannot_create, path +
                                           " exists already; continue it with --resume, replace it with "
                                           "--overwrite, or choose another output with -o");
}

/// Removes a run that is to be overwritten. The manifest goes first, so that no kill leaves half a run.
void remove_run(const std::string& path, const std::string& folder) {
  remove_file(in(folder, Manifest::file_name));
  sync_name(in(folder, Manifest::file_name));
  remove_file(path);
  sync_name(path);
}

}  // namespace

struct RunStore::State {
  /// Takes the lock of the folder, which must exist.
  explicit State(const std::string& run) : path(run), folder(run_folder(run)), lock(folder) {}

  std::string path;
  std::string folder;
  WriterLock lock;
  Manifest manifest;
  /// The checkpoint of the commit before, for `talus repair`; the manifest does not name it.
  std::string spare;
  std::size_t grains = 0;
  /// Of the next commit. A commit that failed may have left its files, or even its manifest: no name is used
  /// twice.
  std::uint64_t serial = 1;
  double seconds_writing = 0.0;
};

RunStore::RunStore(std::unique_ptr<State> state) : state_(std::move(state)) {}
RunStore::RunStore(RunStore&&) noexcept = default;
RunStore& RunStore::operator=(RunStore&&) noexcept = default;
RunStore::~RunStore() = default;

RunStore RunStore::create(const std::string& path, const RunHeader& header, bool overwrite) {
  refuse_existing(path, overwrite);
  const std::string folder = run_folder(path);
  make_folder(folder);
  auto state = std::make_unique<State>(path);
  refuse_existing(path, overwrite);  // again, now that nobody else can change it
  if (overwrite) remove_run(path, folder);
  remove_leftovers(folder, {}, {});
  state->manifest.header = store(folder, Manifest::header_name, header_bytes(header));
  state->grains = header.statics.radius.size();
  return RunStore(std::move(state));
}

RunStore RunStore::resume(const std::string& path, RunHeader& header, Checkpoint& checkpoint) {
  const std::string folder = run_folder(path);
  if (run_presence(path) != RunPresence::folder)
    throw Error(ExitCode::missing_input, folder + ": no interrupted run there");
  auto state = std::make_unique<State>(path);
  if (run_presence(path) != RunPresence::folder)
    throw Error(ExitCode::cannot_create, path + " was being written by another process until this moment");
  state->manifest = read_manifest(folder);
  state->serial = serial_of(state->manifest.checkpoint) + 1;
  const RunFile run =
      RunFile::open(folder);  // reads every file, so that damage is found before computing goes on
  header = run.header();
  checkpoint = run.checkpoint();
  state->grains = header.statics.radius.size();
  state->spare = spare_checkpoint(folder, state->manifest);
  remove_leftovers(folder, state->manifest, state->spare);
  return RunStore(std::move(state));
}

void RunStore::commit(const Segment& segment, const Checkpoint& checkpoint) {
  const auto start = std::chrono::steady_clock::now();
  state_->lock.require();
  const std::uint64_t serial = state_->serial++;
  Manifest next = state_->manifest;
  if (!is_empty(segment))
    next.segments.push_back(
        store_segment(state_->folder, serial_name("segment_", serial), segment, state_->grains));
  next.checkpoint = store(state_->folder, serial_name("checkpoint_", serial), checkpoint_bytes(checkpoint));
  const std::string text = manifest_text(next);
  store(state_->folder, Manifest::file_name, std::as_bytes(std::span(text)));  // here the commit happens
  std::swap(state_->manifest, next);
  std::swap(state_->spare, next.checkpoint.name);
  if (!next.checkpoint.name.empty())
    ::unlink(in(state_->folder, next.checkpoint.name).c_str());  // or a leftover
  state_->seconds_writing += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool RunStore::pack(const std::function<bool()>& goes_on) {
  const std::string& folder = state_->folder;
  state_->lock.require();
  const std::vector<std::byte> bytes = packed_bytes(RunFile::open(folder), goes_on);
  if (bytes.empty()) return false;
  write_durably(state_->path, bytes, in(folder, "packed.h5") + temporary_suffix);
  try {
    RunFile::open(state_->path);  // until it can be read, the folder is all there is of the run
  } catch (const Error&) {
    remove_file(state_->path);
    throw;
  }
  remove_folder(folder);
  state_.reset();
  return true;
}

double RunStore::seconds_writing() const { return state_->seconds_writing; }

void discard_folder(const std::string& path) {
  std::error_code unknown;
  const std::string folder = run_folder(path);
  if (run_presence(path) != RunPresence::packed || !fs::is_directory(folder, unknown)) return;
  const WriterLock lock(folder);
  remove_folder(folder);
}

std::string run_folder(const std::string& path) { return path + ".run"; }

RunPresence run_presence(const std::string& path) {
  std::error_code unknown;
  if (fs::is_regular_file(path, unknown)) return RunPresence::packed;
  if (fs::exists(in(run_folder(path), Manifest::file_name), unknown)) return RunPresence::folder;
  return RunPresence::none;
}

}  // namespace talus
