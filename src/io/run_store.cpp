#include "io/run_store.h"

#include <fcntl.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/core.h>
#include <regex>
#include <string_view>
#include <system_error>
#include <thread>

#include "base/errors.h"
#include "base/locked_file.h"
#include "base/output_file.h"
#include "io/durable_file.h"
#include "io/packed_file.h"
#include "io/run_folder.h"
#include "io/run_records.h"

namespace talus::io {
namespace {

/// Returns the suffix of a writer's file names: eight letters that no other writer has. Two writers that both
/// consider themselves the only one therefore never write to the same file.
std::string mark_of_writer() {
  std::array<unsigned char, 8> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw system_error(ExitCode::io_error, "get random bytes for", "the names of files", errno);
  std::string mark = "-";
  for (const unsigned char byte : bytes) mark += static_cast<char>('a' + byte % 26);
  return mark;
}

std::uint64_t serial_of(const StoredFile& checkpoint) {
  const auto digit = checkpoint.name.find_first_of("0123456789");
  return digit == std::string::npos ? 0 : std::stoull(checkpoint.name.substr(digit));
}

/// Whether a name is that of a numbered file, such as "segment_000001-abcdefgh.h5"; the suffix is optional.
bool is_serial_name(const std::string& name) {
  static const std::regex form(R"((header|segment|checkpoint)_[0-9]{6,16}(-[a-z]{8})?\.h5)");
  return std::regex_match(name, form);
}

/// Temporary names of a manifest and of a packed file before they are renamed.
constexpr std::string_view made_manifest = "manifest", made_packed = "packed";

bool is_temporary(const std::string& name) { return name.ends_with(temporary_ending); }

/// Whether a file of this name belongs to the store; no other file is ever removed.
bool is_own(std::string name) {
  static const std::regex made(fmt::format("({}|{})-[a-z]{{8}}", made_manifest, made_packed));
  const bool temporary = is_temporary(name);
  if (temporary) name.resize(name.size() - std::string_view(temporary_ending).size());
  return name == Manifest::header_name || name == Manifest::file_name || is_serial_name(name) ||
         (temporary && std::regex_match(name, made));
}

bool is_named(const Manifest& manifest, const std::string& name) {
  return name == Manifest::file_name ||
         std::ranges::any_of(files_of(manifest), [&](const StoredFile& file) { return file.name == name; });
}

/// Returns the store's files in the folder that `is_wanted` selects.
std::vector<std::string> own_files(const std::string& folder,
                                   const std::function<bool(const std::string&)>& is_wanted) {
  std::error_code unknown;
  std::vector<std::string> names = names_in(folder, unknown);
  std::erase_if(names, [&](const std::string& name) { return !is_own(name) || !is_wanted(name); });
  return names;
}

/// Removes files of the store from the folder. Files of a writer that has taken over the run after the lock
/// was checked have other names, which are not among these.
void remove_own(const std::string& folder, const WriterLock& lock,
                const std::function<bool(const std::string&)>& is_wanted) {
  const std::vector<std::string> names = own_files(folder, is_wanted);
  lock.require();
  for (const std::string& name : names) remove_file(path_in(folder, name));
}

/// Takes over the run from a writer that has lost its lock without knowing it: its temporary file is removed,
/// so that its rename cannot become a commit (see publish). Must be called before anything is read.
void exclude_other_writers(const std::string& folder, const WriterLock& lock) {
  remove_own(folder, lock, is_temporary);
}

/// Removes the leftovers of a kill: files of the store that the manifest does not list.
void remove_leftovers(const std::string& folder, const WriterLock& lock, const Manifest& manifest) {
  remove_own(folder, lock, [&](const std::string& name) { return !is_named(manifest, name); });
}

/// Whether only files remain that a file system keeps, after removal, until they are closed (NFS) or until
/// its server knows that (FUSE).
bool is_kept_until_closed(const std::string& folder) {
  std::error_code unknown;
  for (const std::string& name : names_in(folder, unknown))
    if (!name.starts_with(".nfs") && !name.starts_with(".fuse_hidden")) return false;
  return !unknown;
}

/// Removes the folder of a run that is packed or has not begun, the lock last; does nothing if another writer
/// has taken over the run. Files that cannot be removed are harmless, and so is a folder with foreign files.
void remove_folder(const std::string& folder, WriterLock& lock) {
  const std::vector<std::string> names = own_files(folder, [](const std::string&) { return true; });
  if (!lock.is_held()) return;
  ::unlink(path_in(folder, Manifest::file_name).c_str());
  for (const std::string& name : names) ::unlink(path_in(folder, name).c_str());
  lock.remove();
  for (int attempt = 0; attempt < 100 && ::rmdir(folder.c_str()) != 0; ++attempt) {
    if (!is_kept_until_closed(folder)) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

StoredFile store(const std::string& folder, const std::string& name, std::span<const std::byte> bytes) {
  write_durably(path_in(folder, name), bytes);
  return describe(name, bytes);
}

std::vector<std::byte> header_bytes(const RunHeader& header) {
  Writer writer(with_branch({{'N', header.statics.radius.size()}}, header));
  write_header(writer, header);
  writer.write_contents();
  return writer.image();
}

std::vector<std::byte> checkpoint_bytes(const Checkpoint& checkpoint) {
  const World& world = checkpoint.world;
  Writer writer({{'G', world.grains.radius.size()},
                 {'C', world.contacts.a.size()},
                 {'P', world.boundary.planes.size()}});
  write_checkpoint(writer, checkpoint);
  writer.write_contents();
  return writer.image();
}

std::vector<std::byte> segment_bytes(const Segment& segment, const StoredSegment& sizes, std::size_t grains) {
  Sizes letters = {{'T', sizes.frames}, {'N', grains}, {'M', sizes.contacts}};
  letters.merge(sizes_of(segment));
  // Compression would take half of the time of a commit, for a file that the packed one soon replaces.
  Writer writer(std::move(letters));
  write_frames(writer, [&segment](std::size_t k) { return segment.frames[k]; });
  write_series(writer, segment);
  writer.write_contents();
  return writer.image();
}

StoredSegment store_segment(const std::string& folder, const std::string& name, const Segment& segment,
                            std::size_t grains) {
  StoredSegment stored;
  stored.frames = segment.frames.size();
  stored.observables = segment.observables.size();
  stored.steps = segment.steps.size();
  for (const Frame& frame : segment.frames) stored.contacts += frame.contacts.a.size();
  stored.file = store(folder, name, segment_bytes(segment, stored, grains));
  return stored;
}

bool is_empty(const Segment& segment) {
  return segment.frames.empty() && segment.observables.empty() && segment.steps.empty() &&
         segment.commands.empty() && segment.trials.empty();
}

/// Lets a run replace no file that has appeared under its name when it is packed.
void keep_file_free(const std::string& path) {
  keep_free(path, fmt::format(
                      "the run is in {}: move the file away, and complete the run with talus run --resume {}",
                      run_folder(path), path));
}

void refuse_existing(const std::string& path, bool overwrite) {
  output_target(path);
  if (overwrite) return allow_replacing(path);
  if (run_presence(path) == RunPresence::none) return keep_file_free(path);
  throw Error(ExitCode::cannot_create, path +
                                           " exists already; continue it with --resume, replace it with "
                                           "--overwrite, or choose another output with -o");
}

/// Returns the first serial number that no file of the folder uses.
std::uint64_t next_serial(const std::string& folder) {
  std::uint64_t serial = 0;
  for (const std::string& name : own_files(folder, is_serial_name))
    serial = std::max(serial, serial_of({name, 0, 0}));
  return serial + 1;
}

}  // namespace

struct RunStore::State {
  /// Acquires the lock of the folder, which must exist.
  explicit State(const std::string& run) : path(run), folder(run_folder(run)), lock(folder) {}
  /// Removes the folder of a run that has not begun.
  ~State() {
    const bool has_begun = !manifest.checkpoint.name.empty() ||
                           ::access(path_in(folder, Manifest::file_name).c_str(), F_OK) == 0 ||
                           errno != ENOENT;
    if (!has_begun) remove_folder(folder, lock);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::string name_of_next(const char* kind) const { return fmt::format("{}{:06}{}.h5", kind, serial, mark); }
  void publish(std::string_view made, std::span<const std::byte> bytes, const std::string& target,
               const std::function<void(const std::string& written)>& check = {}) const;
  void publish(const Manifest& next) const;

  std::string path;
  std::string folder;
  WriterLock lock;
  std::string mark = mark_of_writer();
  Manifest manifest;
  std::vector<std::string> replaced;  ///< names of files of a run that this one replaces in its folder
  std::size_t grains = 0;
  double farthest = 0.0;          ///< farthest_place of the bed, m
  std::vector<std::byte> header;  ///< header of a run that has not begun, written with its first commit
  /// Number of the next commit. A commit that failed may have left its files, or even its manifest, so no
  /// name is used twice.
  std::uint64_t serial = 1;
  double seconds_writing = 0.0;
};

/// Writes bytes and renames them to `target` while this writer holds the run. The writer can lose the run at
/// any moment, and be stopped before any line. But another process that takes over the run first removes the
/// temporary file (exclude_other_writers), so that the rename either precedes that and counts, or fails.
void RunStore::State::publish(std::string_view made, std::span<const std::byte> bytes,
                              const std::string& target,
                              const std::function<void(const std::string& written)>& check) const {
  OutputFile file(path_in(folder, fmt::format("{}{}", made, mark)));
  file.write(bytes);
  file.flush();
  if (check) check(file.temporary_path());
  lock.require();
  publish_file(file.temporary_path(), target);
  sync_name(target);
}

void RunStore::State::publish(const Manifest& next) const {
  const std::string text = manifest_text(next);
  publish(made_manifest, std::as_bytes(std::span(text)), path_in(folder, Manifest::file_name));
}

RunStore::RunStore(std::unique_ptr<State> state) : state_(std::move(state)) {}
RunStore::RunStore(RunStore&&) noexcept = default;
RunStore& RunStore::operator=(RunStore&&) noexcept = default;
RunStore::~RunStore() = default;

RunStore RunStore::create(const std::string& path, const RunHeader& header, bool overwrite) {
  require_run_name(path);
  refuse_existing(path, overwrite);
  prepare_folder_of(path);
  const std::string folder = run_folder(path);
  make_folder(folder);
  std::unique_ptr<State> state;
  try {
    state = std::make_unique<State>(path);
  } catch (const Error&) {
    ::rmdir(folder.c_str());  // removes it only if it is empty
    throw;
  }
  refuse_existing(path, overwrite);  // checked again while other writers are excluded
  exclude_other_writers(folder, state->lock);
  if (!is_there(path_in(folder, Manifest::file_name))) remove_leftovers(folder, state->lock, {});
  state->replaced = own_files(folder, is_serial_name);
  if (is_there(path_in(folder, Manifest::header_name))) state->replaced.emplace_back(Manifest::header_name);
  state->manifest.replaces = is_file(path);
  state->header = header_bytes(header);
  state->grains = header.statics.radius.size();
  state->farthest = farthest_place(header.statics);
  state->serial = next_serial(folder);
  // No name of an existing run is used, so that it remains complete until its manifest is replaced.
  state->manifest.header = describe(state->name_of_next("header_"), state->header);
  return RunStore(std::move(state));
}

RunStore RunStore::resume(const std::string& path, RunHeader& header, Checkpoint& checkpoint) {
  const std::string folder = run_folder(path);
  const RunPresence presence = run_presence(path);
  if (presence == RunPresence::packed && is_run(path))
    throw Error(ExitCode::usage, path + ": the run is complete: it has no further step to resume");
  if (presence != RunPresence::folder)
    throw Error(ExitCode::missing_input, folder + ": no interrupted run there");
  auto state = std::make_unique<State>(path);
  if (run_presence(path) != RunPresence::folder)
    throw Error(ExitCode::cannot_create,
                path + " was being written by another process until just now; repeat the command");
  exclude_other_writers(folder, state->lock);
  try {
    state->manifest = read_manifest(folder);
    state->manifest.replaces ? allow_replacing(path) : keep_file_free(path);
    state->manifest.packed_seal = 0;  // it is packed again
    state->serial = serial_of(state->manifest.checkpoint) + 1;
    const RunFile run =
        RunFile::open(folder);  // reads every file, to detect damage before computing continues
    header = run.header();
    checkpoint = run.checkpoint();
  } catch (const Error&) {
    state->lock.require();  // changes by another writer are not damage
    throw;
  }
  state->grains = header.statics.radius.size();
  state->farthest = farthest_place(header.statics);
  remove_leftovers(folder, state->lock, state->manifest);
  return RunStore(std::move(state));
}

void RunStore::commit(const Segment& segment, const Checkpoint& checkpoint) try {
  const auto start = std::chrono::steady_clock::now();
  State& state = *state_;
  const std::string& folder = state.folder;
  state.lock.require();
  for (const Frame& frame : segment.frames)
    check_frame(RecordCheck(), frame, state.farthest, checkpoint.world.boundary.planes.size());
  Manifest next = state.manifest;
  const std::string segment_name = state.name_of_next("segment_"),
                    checkpoint_name = state.name_of_next("checkpoint_");
  ++state.serial;
  if (!is_empty(segment)) next.segments.push_back(store_segment(folder, segment_name, segment, state.grains));
  next.checkpoint = store(folder, checkpoint_name, checkpoint_bytes(checkpoint));
  if (!state.header.empty()) store(folder, next.header.name, state.header);
  state.publish(next);  // the commit happens here
  state.header = {};
  std::swap(state.manifest, next);
  if (!next.checkpoint.name.empty())
    ::unlink(path_in(folder, next.checkpoint.name).c_str());  // a leftover is harmless
  for (const std::string& name : std::exchange(state.replaced, {})) ::unlink(path_in(folder, name).c_str());
  state.seconds_writing += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
} catch (const Error&) {
  state_->lock.require();  // if another writer has taken over the run, this explains a missing file
  throw;
}

bool RunStore::pack(const std::function<bool()>& should_continue, const PackedParts& parts) try {
  const std::string folder = state_->folder;
  state_->lock.require();
  const RunFile run = RunFile::open(folder);
  std::vector<std::byte> bytes = packed_bytes(content_of(run, parts.frames), should_continue);
  if (bytes.empty()) return false;
  if (parts.analysis != nullptr) bytes = with_analysis(bytes, state_->path, *parts.analysis, parts.readings);
  // Once the new file is there, the folder next to it must no longer hide it, but another file of this name
  // must not hide the folder. The manifest identifies the new file by its seal, before and after the rename.
  Manifest last = state_->manifest;
  last.packed_seal = seal_hash(bytes);
  state_->publish(last);
  // Until the file is known to be readable, the run exists only in the folder. The seal shows that the bytes
  // on disk equal those in memory, which HDF5 reads.
  state_->publish(made_packed, bytes, state_->path, [&](const std::string& packed) {
    verify_seal(packed);
    RunFile::from_bytes(std::move(bytes), state_->path);
  });
  remove_folder(folder, state_->lock);
  state_.reset();
  return true;
} catch (const Error&) {
  state_->lock.require();
  throw;
}

double RunStore::seconds_writing() const { return state_->seconds_writing; }

/// Whether the folder was left behind when it was packed into the file, or holds no run.
static bool is_left_behind(const std::string& folder, const std::string& packed) try {
  return !is_there(path_in(folder, Manifest::file_name)) ||
         read_manifest(folder).packed_seal == seal_hash_of(packed);
} catch (const Error& error) {
  if (error.code() != ExitCode::bad_data) throw;
  return false;
}

void discard_folder(const std::string& path, bool of_any_run) {
  const std::string folder = run_folder(path);
  if (!is_file(path) || !is_folder(folder)) return;
  if (!of_any_run && !is_left_behind(folder, path)) return;
  WriterLock lock(folder);
  remove_folder(folder, lock);
}

std::string damage_of_packed(const std::string& path) {
  try {
    verify_seal(path);
    return "";
  } catch (const Error& error) {
    if (error.code() == ExitCode::missing_input && !is_there(path))
      return "";  // another process has moved it
    if (error.code() != ExitCode::bad_data) throw;
    return begins_with(path, "talus run file ") && !begins_as_run(path) ? "" : error.what();
  }
}

/// Renames what makes way for a run to a free name: `path`, `ending`, and a number from the second one on.
/// Returns the name; empty if another process has already done so.
static std::string move_aside(const std::string& what, const std::string& path, const std::string& ending) {
  std::string aside = path + ending;
  for (int number = 2; is_there(aside); ++number) aside = fmt::format("{}{}-{}", path, ending, number);
  if (std::rename(what.c_str(), aside.c_str()) == 0) return aside;
  const int error = errno;
  if (error == ENOENT && !is_there(what)) return "";
  throw Error(ExitCode::cannot_create, "{} cannot be renamed to {}: {}", what, aside, std::strerror(error));
}

/// Describes the damage and its new location. Advice after a semicolon is removed.
static std::string damage_text(const std::string& damage, const std::string& aside) {
  if (aside.empty()) return "";
  return fmt::format("{}; what is left of it is in {}", damage.substr(0, damage.find(';')), aside);
}

std::string set_damaged_aside(const std::string& path) {
  const RunPresence presence = run_presence(path);
  if (presence == RunPresence::packed) {
    const std::string damage = damage_of_packed(path);
    const std::string aside = damage.empty() ? "" : move_aside(path, path, ".damaged");
    if (aside.empty() || !damage_of_packed(aside).empty()) return damage_text(damage, aside);
    // Another process was faster and has already recomputed the run.
    ::renameat2(AT_FDCWD, aside.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE);
    return "";
  }
  if (presence != RunPresence::folder) return "";
  const std::string folder = run_folder(path);
  WriterLock lock(folder);
  exclude_other_writers(folder, lock);
  try {
    for (const StoredFile& file : files_of(read_manifest(folder))) read_stored(folder, file);
    return "";
  } catch (const Error& error) {
    lock.require();
    if (error.code() != ExitCode::bad_data) throw;
    return damage_text(error.what(), move_aside(folder, path, ".damaged"));
  }
}

void set_withdrawn_aside(const std::string& path) {
  if (run_presence(path) != RunPresence::folder) return;
  WriterLock lock(run_folder(path));
  exclude_other_writers(run_folder(path), lock);
  move_aside(run_folder(path), path, ".withdrawn");
}

std::string run_folder(const std::string& path) { return path + ".run"; }

std::string run_of_folder(std::string folder) {
  while (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
  const std::string ending = run_folder("");
  if (folder.ends_with(ending)) folder.resize(folder.size() - ending.size());
  return folder;
}

RunPresence run_presence(const std::string& path) {
  const bool has_folder = is_there(path_in(run_folder(path), Manifest::file_name));
  if (is_file(path) && !(has_folder && hides_packed(run_folder(path), path))) return RunPresence::packed;
  return has_folder ? RunPresence::folder : RunPresence::none;
}

void refuse_no_run(const std::string& path) {
  const std::string folder = run_folder(run_of_folder(path));
  if (is_file(path))
    throw Error(ExitCode::bad_data,
                "{}: is not a Talus run file (it does not begin with 'talus run file 1'); expected one that "
                "talus run, view or replay has written",
                path);
  if (is_folder(folder))
    throw Error(ExitCode::missing_input,
                "{}: nothing is committed there yet; wait for the first checkpoint, or start its command "
                "again; if it was damaged, save what is undamaged with: talus repair",
                folder);
  if (is_folder(path))
    throw Error(ExitCode::missing_input,
                path + " is a folder, but not a run; expected a run file, or a folder RUN.h5.run");
  throw Error(ExitCode::missing_input, "{}: no such run; expected a run file, or a folder {}", path, folder);
}

void require_run_name(const std::string& path) {
  const std::string name = run_of_folder(path), ending = std::filesystem::path(name).extension();
  const bool is_numbered = ending.find_first_of("0123456789") != std::string::npos;
  if (name == path && (ending.empty() || is_numbered)) return;
  std::string meant = is_numbered ? name : name.substr(0, name.size() - ending.size());
  if (!meant.ends_with(".h5")) meant += ".h5";
  throw Error(ExitCode::usage, "{}: expected the name of a run, which ends in .h5, such as {}", path, meant);
}

void refuse_no_scenario(const std::string& path) {
  const std::string run = run_of_folder(path);
  if (is_file(path) ? begins_as_run(path) : run_presence(run) != RunPresence::none)
    throw Error(ExitCode::bad_data,
                "{} is not a scenario but a run; talus info {} shows how far it is, and talus run --resume "
                "{} continues it if it is incomplete",
                path, run, run);
}

}  // namespace talus::io
