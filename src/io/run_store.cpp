#include "io/run_store.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fmt/core.h>
#include <string_view>
#include <system_error>

#include "core/errors.h"
#include "core/paths.h"
#include "io/durable_file.h"
#include "io/manifest.h"
#include "io/packed_file.h"
#include "io/run_records.h"
#include "io/writer_lock.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

std::string in(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string serial_name(const char* kind, std::uint64_t serial) {
  return fmt::format("{}{:06}.h5", kind, serial);
}

std::uint64_t serial_of(const StoredFile& checkpoint) {
  const auto digit = checkpoint.name.find_first_of("0123456789");
  return digit == std::string::npos ? 0 : std::stoull(checkpoint.name.substr(digit));
}

bool is_serial_name(std::string_view name, std::string_view kind) {
  constexpr std::string_view ending = ".h5";
  if (!name.starts_with(kind) || !name.ends_with(ending) || name.size() < kind.size() + ending.size() + 6)
    return false;
  const auto digits = name.substr(kind.size(), name.size() - kind.size() - ending.size());
  return std::ranges::all_of(digits, [](char c) { return c >= '0' && c <= '9'; });
}

/// Whether a file of this name is the store's own: no other is ever removed.
bool is_own(std::string_view name) {
  if (name.ends_with(temporary_ending)) name.remove_suffix(std::string_view(temporary_ending).size());
  return name == Manifest::header_name || name == Manifest::file_name || is_serial_name(name, "header_") ||
         is_serial_name(name, "segment_") || is_serial_name(name, "checkpoint_");
}

bool is_named(const Manifest& manifest, const std::string& name) {
  return name == Manifest::file_name ||
         std::ranges::any_of(files_of(manifest), [&](const StoredFile& file) { return file.name == name; });
}

/// Removes what a kill left behind: own files that the manifest does not name.
void remove_leftovers(const std::string& folder, const Manifest& manifest) {
  std::vector<std::string> leftovers;
  for (const std::string& name : names_in(folder))
    if (is_own(name) && !is_named(manifest, name)) leftovers.push_back(name);
  for (const std::string& name : leftovers) remove_file(in(folder, name));
}

/// Removes the folder of a packed run, the lock last. What cannot be removed stays and does no harm; so does
/// a folder where somebody keeps other files.
void remove_folder(const std::string& folder) {
  ::unlink(in(folder, Manifest::file_name).c_str());
  std::error_code unknown;
  for (const std::string& name : names_in(folder, unknown))
    if (is_own(name)) ::unlink(in(folder, name).c_str());
  ::unlink(in(folder, WriterLock::file_name).c_str());
  ::rmdir(folder.c_str());
}

StoredFile store(const std::string& folder, const std::string& name, std::span<const std::byte> bytes) {
  write_durably(in(folder, name), bytes);
  return describe(name, bytes);
}

std::vector<std::byte> header_bytes(const RunHeader& header) {
  hdf5::Writer writer(with_branch({{'N', header.statics.radius.size()}}, header));
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
  // Half of the time of a commit would go into compression, for a file that the packed one soon replaces.
  hdf5::Writer writer({{'T', stored.frames},
                       {'N', grains},
                       {'M', stored.contacts},
                       {'R', stored.observables},
                       {'S', stored.steps},
                       {'K', segment.commands.size()}},
                      0, hdf5::Storage::as_it_is);
  write_frames(writer, [&segment](std::size_t k) { return segment.frames[k]; });
  write_observables(writer, segment.observables);
  write_steps(writer, segment.steps);
  write_commands(writer, segment.commands);
  stored.file = store(folder, name, writer.image());
  return stored;
}

void store_manifest(const std::string& folder, const Manifest& manifest) {
  const std::string text = manifest_text(manifest);
  store(folder, Manifest::file_name, std::as_bytes(std::span(text)));
}

bool is_empty(const Segment& segment) {
  return segment.frames.empty() && segment.observables.empty() && segment.steps.empty() &&
         segment.commands.empty();
}

void refuse_existing(const std::string& path, bool overwrite) {
  output_target(path);
  if (overwrite || run_presence(path) == RunPresence::none) return;
  throw Error(ExitCode::cannot_create, path +
                                           " exists already; continue it with --resume, replace it with "
                                           "--overwrite, or choose another output with -o");
}

/// The first serial number that no file of the folder has.
std::uint64_t next_serial(const std::string& folder) {
  std::uint64_t serial = 0;
  for (const std::string& name : names_in(folder))
    if (is_serial_name(name, "header_") || is_serial_name(name, "segment_") ||
        is_serial_name(name, "checkpoint_"))
      serial = std::max(serial, serial_of({name, 0, 0}));
  return serial + 1;
}

}  // namespace

struct RunStore::State {
  /// Takes the lock of the folder, which must exist.
  explicit State(const std::string& run) : path(run), folder(run_folder(run)), lock(folder) {}

  std::string path;
  std::string folder;
  WriterLock lock;
  Manifest manifest;
  std::size_t grains = 0;
  std::vector<std::byte> header;  ///< of a run that has not begun: written with its first commit
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
  std::error_code unknown;
  if (!fs::exists(in(folder, Manifest::file_name), unknown)) remove_leftovers(folder, {});
  state->manifest.replaces = fs::is_regular_file(path, unknown);
  state->header = header_bytes(header);
  state->grains = header.statics.radius.size();
  state->serial = next_serial(folder);
  // No name of a run that is there is used: it is whole until the one manifest takes the place of the other.
  const bool is_free = !fs::exists(in(folder, Manifest::header_name), unknown);
  state->manifest.header =
      describe(is_free ? Manifest::header_name : serial_name("header_", state->serial), state->header);
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
  state->manifest.packed_seal = 0;  // it is packed again
  state->serial = serial_of(state->manifest.checkpoint) + 1;
  const RunFile run =
      RunFile::open(folder);  // reads every file, so that damage is found before computing goes on
  header = run.header();
  checkpoint = run.checkpoint();
  state->grains = header.statics.radius.size();
  remove_leftovers(folder, state->manifest);
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
  if (!state_->header.empty()) store(state_->folder, next.header.name, state_->header);
  store_manifest(state_->folder, next);  // here the commit happens
  state_->header = {};
  std::swap(state_->manifest, next);
  if (!next.checkpoint.name.empty())
    ::unlink(in(state_->folder, next.checkpoint.name).c_str());  // or a leftover
  else
    remove_leftovers(state_->folder, state_->manifest);  // of a run that this one replaces
  state_->seconds_writing += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool RunStore::pack(const std::function<bool()>& goes_on) {
  const std::string& folder = state_->folder;
  state_->lock.require();
  const RunFile run = RunFile::open(folder);
  std::vector<std::byte> bytes = packed_bytes(content_of(run), goes_on);
  if (bytes.empty()) return false;
  if (state_->manifest.replaces) {
    // When the new file has taken the name of the old one, the folder beside it must not hide it any more:
    // the manifest tells the two apart, before and after the rename alike.
    Manifest last = state_->manifest;
    last.packed_seal = seal_hash(bytes);
    store_manifest(folder, last);
  }
  // Until the file can be read, the folder is all there is of the run. Its bytes on the disk are those in
  // memory, which HDF5 reads: it would not open a file that is locked.
  write_durably(state_->path, bytes, [&](const std::string& packed) {
    verify_seal(packed);
    RunFile::of_bytes(std::move(bytes), state_->path);
  });
  remove_folder(folder);
  state_.reset();
  return true;
}

double RunStore::seconds_writing() const { return state_->seconds_writing; }

void discard_folder(const std::string& path) {
  std::error_code unknown;
  const std::string folder = run_folder(path);
  if (!fs::is_regular_file(path, unknown) || !fs::is_directory(folder, unknown)) return;
  const WriterLock lock(folder);
  remove_folder(folder);
}

std::string run_folder(const std::string& path) { return path + ".run"; }

RunPresence run_presence(const std::string& path) {
  std::error_code unknown;
  const bool has_folder = fs::exists(in(run_folder(path), Manifest::file_name), unknown);
  if (fs::is_regular_file(path, unknown) && !(has_folder && replaces_packed(run_folder(path), path)))
    return RunPresence::packed;
  return has_folder ? RunPresence::folder : RunPresence::none;
}

}  // namespace talus
