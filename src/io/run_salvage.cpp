#include "io/run_salvage.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "core/descriptor.h"
#include "core/errors.h"
#include "io/durable_file.h"
#include "io/manifest.h"
#include "io/packed_file.h"
#include "io/repaired_file.h"
#include "io/writer_lock.h"

namespace talus {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

constexpr std::uint64_t most_padding = 8;  // times the bytes that are there

/// HDF5 opens no file that is shorter than it was; what lies before the cut can be read then.
void pad(Bytes& bytes, std::uint64_t size) {
  if (size > bytes.size() && size / most_padding <= bytes.size()) bytes.resize(size);
}

/// A file of a folder, as it is found.
struct FoundFile {
  std::string name;
  std::uint64_t serial = 0;  ///< of its commit
  bool is_spare = false;     ///< no part of the run: the checkpoint of the commit before
  RunPieces pieces;
};

/// What the folder holds of each kind, in the order of commits.
struct FoundFolder {
  RunPieces header;
  std::vector<FoundFile> segments, checkpoints;
  std::vector<LostPiece> missing;  ///< files that the manifest names
  bool has_manifest = false;
};

std::uint64_t serial_in(const std::string& name) {
  const auto digit = name.find_first_of("0123456789");
  return digit == std::string::npos ? 0 : std::stoull(name.substr(digit, 16));
}

RunPieces read_file_of(const std::string& folder, const StoredFile& file, bool described, bool keep_frames) {
  const std::string path = (fs::path(folder) / file.name).string();
  Bytes bytes = read_file(path);
  const bool vouched = described && describe(file.name, bytes).hash == file.hash;
  if (described) pad(bytes, file.size);
  RunPieces pieces = read_pieces(std::move(bytes), path, vouched, keep_frames);
  if (!pieces.verified && described) pieces.lost.push_back({file.name, "is not as it was written"});
  return pieces;
}

std::optional<Manifest> manifest_of(const std::string& folder) {
  try {
    return read_manifest(folder);
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// Files of the folder that are named like those of a store, in the order of their serial numbers.
std::vector<StoredFile> files_named(const std::string& folder, const std::string& kind) {
  std::vector<StoredFile> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    StoredFile file;
    file.name = entry.path().filename().string();
    if (file.name.starts_with(kind) && file.name.ends_with(".h5")) files.push_back(std::move(file));
  }
  std::ranges::sort(files, {}, [](const StoredFile& file) { return serial_in(file.name); });
  return files;
}

void refuse_if_at_work(const std::string& folder) {
  const std::string path = (fs::path(folder) / WriterLock::file_name).string();
  const Descriptor lock(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (lock.get() >= 0 && ::flock(lock.get(), LOCK_SH | LOCK_NB) != 0)
    throw Error(ExitCode::cannot_create, folder + " is being written by another process; wait for it to end");
}

/// Reads every file, of what the manifest names or, without it, of what is there.
FoundFolder look_into(const std::string& folder, bool keep_frames) {
  FoundFolder found;
  const std::optional<Manifest> manifest = manifest_of(folder);
  found.has_manifest = manifest.has_value();
  if (!manifest) found.missing.push_back({Manifest::file_name, "is not as it was written"});
  const auto read = [&](const StoredFile& file, bool described) -> std::optional<FoundFile> {
    if (fs::exists(fs::path(folder) / file.name))
      return FoundFile{file.name, serial_in(file.name), manifest && !described,
                       read_file_of(folder, file, described, keep_frames)};
    if (described) found.missing.push_back({file.name, "is missing"});
    return std::nullopt;
  };
  StoredFile header;
  header.name = Manifest::header_name;
  if (auto file = read(manifest ? manifest->header : header, manifest.has_value()))
    found.header = std::move(file->pieces);
  std::vector<StoredFile> segments;
  if (manifest)
    for (const StoredSegment& segment : manifest->segments) segments.push_back(segment.file);
  else
    segments = files_named(folder, "segment_");
  for (const StoredFile& segment : segments)
    if (auto file = read(segment, manifest.has_value())) found.segments.push_back(std::move(*file));
  for (const StoredFile& checkpoint : files_named(folder, "checkpoint_")) {
    const bool named = manifest && checkpoint.name == manifest->checkpoint.name;
    if (manifest && serial_in(checkpoint.name) > serial_in(manifest->checkpoint.name)) continue;
    if (auto file = read(named ? manifest->checkpoint : checkpoint, named))
      found.checkpoints.push_back(std::move(*file));
  }
  if (manifest && std::ranges::find(found.checkpoints, manifest->checkpoint.name, &FoundFile::name) ==
                      found.checkpoints.end())
    found.missing.push_back({manifest->checkpoint.name, "is missing"});
  return found;
}

/// The steps of a segment: the first and the last; nothing where it has none.
std::optional<std::pair<double, double>> steps_of(const RunPieces& segment) {
  const std::vector<double> steps = reals_of(segment, "/steps/step");
  if (steps.empty()) return std::nullopt;
  return std::pair(steps.front(), steps.back());
}

double step_of_state(const RunPieces& checkpoint) {
  const auto found = checkpoint.arrays.find("/checkpoint/step");
  std::int64_t step = -1;
  if (found != checkpoint.arrays.end() && found->second.values.size() == sizeof step)
    std::copy_n(found->second.values.data(), sizeof step, reinterpret_cast<std::byte*>(&step));
  return static_cast<double>(step);
}

/// The segments of the commits up to the one of a checkpoint, if all of them are whole and each goes on where
/// the one before it ended. A segment that begins before others have ended was committed in their place.
std::optional<std::vector<const FoundFile*>> chain_to(const FoundFolder& found, const FoundFile& checkpoint) {
  if (!checkpoint.pieces.is_whole()) return std::nullopt;
  for (const LostPiece& missing : found.missing)
    if (missing.name.starts_with("segment_") && serial_in(missing.name) <= checkpoint.serial)
      return std::nullopt;
  std::vector<const FoundFile*> chain;
  for (const FoundFile& segment : found.segments) {
    if (segment.serial > checkpoint.serial) break;
    if (!segment.pieces.is_whole()) return std::nullopt;
    const auto steps = steps_of(segment.pieces);
    if (steps)
      std::erase_if(chain, [&](const FoundFile* before) {
        const auto own = steps_of(before->pieces);
        return own && own->first >= steps->first;
      });
    chain.push_back(&segment);
  }
  double end = 0.0;
  for (const FoundFile* segment : chain)
    if (const auto steps = steps_of(segment->pieces)) {
      if (steps->first != end + 1.0) return std::nullopt;
      end = steps->second;
    }
  if (end != step_of_state(checkpoint.pieces)) return std::nullopt;
  return chain;
}

/// Adds the rows of a segment to those before it.
void append_rows(RunPieces& run, const RunPieces& segment) {
  for (const std::string& path : segment.order) {
    const StoredArray& more = segment.arrays.at(path);
    if (!run.arrays.contains(path)) {
      set_array(run, path, more);
      continue;
    }
    StoredArray& rows = run.arrays.at(path);
    if (rows.dims.size() != 1 || more.dims.size() != 1) continue;
    rows.dims[0] += more.dims[0];
    rows.values.insert(rows.values.end(), more.values.begin(), more.values.end());
  }
  run.frames.insert(run.frames.end(), segment.frames.begin(), segment.frames.end());
}

void append_arrays(RunPieces& run, const RunPieces& from) {
  for (const std::string& path : from.order) set_array(run, path, from.arrays.at(path));
}

void append_lost(RunPieces& run, const FoundFile& file) {
  for (const LostPiece& lost : file.pieces.lost)
    run.lost.push_back({lost.name == file.name ? lost.name : file.name + ":" + lost.name, lost.how});
  for (const std::string& frames : lost_frame_lines(file.pieces))
    run.lost.push_back({std::string(frames).append(" of ").append(file.name), "are not whole"});
}

void append_damage(RunPieces& run, const FoundFolder& found) {
  run.lost.insert(run.lost.end(), found.missing.begin(), found.missing.end());
  for (const auto* files : {&found.segments, &found.checkpoints})
    for (const FoundFile& file : *files)
      if (!file.is_spare) append_lost(run, file);
}

/// The run up to a commit.
Salvage up_to(const FoundFolder& found, const std::vector<const FoundFile*>& chain,
              const FoundFile& checkpoint) {
  Salvage salvage;
  salvage.goes_on = true;
  salvage.pieces = found.header;
  for (const FoundFile* segment : chain) {
    append_rows(salvage.pieces, segment->pieces);
    salvage.pieces.verified = salvage.pieces.verified && segment->pieces.verified;
  }
  append_arrays(salvage.pieces, checkpoint.pieces);
  salvage.pieces.verified = salvage.pieces.verified && checkpoint.pieces.verified;
  RunPieces damage;
  append_damage(damage, found);
  salvage.not_needed = std::move(damage.lost);
  return salvage;
}

/// The end of a run depends on all but a few words of its header.
bool has_all_to_go_on(const RunPieces& pieces) {
  return std::ranges::all_of(pieces.lost, [](const LostPiece& lost) {
    return lost.name.starts_with("/provenance/") || lost.name == "/parameters/scenario_given";
  });
}

/// All that is whole, with nothing to go on from.
RunPieces without_state(FoundFolder& found) {
  RunPieces run = found.header;
  append_damage(run, found);
  for (FoundFile& segment : found.segments) {
    run.verified = run.verified && segment.pieces.verified;
    drop_array(segment.pieces, "/contents");
    mend_series(segment.pieces);
    append_rows(run, segment.pieces);
  }
  std::int64_t last = -1;
  std::erase_if(run.frames, [&last](const StoredFrame& frame) {
    const bool again = step_of(frame) <= last;
    last = std::max(last, step_of(frame));
    return again;
  });
  run.lost.push_back({"/checkpoint", "no commit is whole up to its state"});
  return run;
}

}  // namespace

RunPieces inspect_file(const std::string& path, bool keep_frames) {
  Bytes bytes = read_file(path);
  bool vouched = true;
  try {
    verify_seal(path);
  } catch (const Error&) {
    vouched = false;
  }
  pad(bytes, sealed_size(bytes));
  return read_pieces(std::move(bytes), path, vouched, keep_frames);
}

Salvage salvage_file(const std::string& path) {
  Salvage salvage;
  salvage.pieces = inspect_file(path, true);
  salvage.frames = salvage.pieces.frames.size() + salvage.pieces.lost_frames.size();
  if (salvage.pieces.has_analyses)
    salvage.not_needed.push_back({"/analysis", "is no part of the run; make it again with talus analyze"});
  mend(salvage.pieces, path);
  return salvage;
}

RunPieces inspect_folder(const std::string& folder) {
  FoundFolder found = look_into(folder, false);
  RunPieces run = std::move(found.header);
  append_damage(run, found);
  return run;
}

Salvage salvage_folder(const std::string& folder) {
  refuse_if_at_work(folder);
  FoundFolder found = look_into(folder, true);
  std::size_t frames = 0;
  for (const FoundFile& segment : found.segments)
    frames += segment.pieces.frames.size() + segment.pieces.lost_frames.size();
  for (std::size_t k = found.checkpoints.size(); k-- > 0;) {
    const auto chain = chain_to(found, found.checkpoints[k]);
    if (!chain) continue;
    Salvage salvage = up_to(found, *chain, found.checkpoints[k]);
    salvage.frames = frames;
    mend(salvage.pieces, folder);
    if (has_all_to_go_on(salvage.pieces)) return salvage;
  }
  Salvage salvage;
  salvage.pieces = without_state(found);
  salvage.frames = frames;
  mend(salvage.pieces, folder);
  return salvage;
}

}  // namespace talus
