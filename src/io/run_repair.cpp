#include "io/run_repair.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <span>

#include "core/errors.h"
#include "io/durable_file.h"
#include "io/manifest.h"
#include "io/repaired_file.h"
#include "io/run_records.h"
#include "io/run_salvage.h"

namespace talus {
namespace {

namespace fs = std::filesystem;

/// The folder in which the files of a run lie; nothing where `path` is a file.
std::optional<std::string> folder_of(const std::string& path) {
  std::error_code unknown;
  if (fs::is_regular_file(path, unknown)) return std::nullopt;
  for (const std::string& folder : {path, run_folder(path)})
    if (fs::exists(fs::path(folder) / Manifest::header_name, unknown) ||
        fs::exists(fs::path(folder) / Manifest::file_name, unknown))
      return folder;
  throw Error(ExitCode::missing_input,
              path + ": no such run; expected a run file, or a folder " + run_folder(path));
}

/// A run that opens is whole: all of its bytes have been compared with their hashes.
bool is_whole(const std::string& path) {
  try {
    RunFile::open(path);
    return true;
  } catch (const Error& error) {
    if (error.code() != ExitCode::bad_data && error.code() != ExitCode::missing_input) throw;
    return false;
  }
}

void refuse_output(const RepairRequest& request) {
  const auto whole = [](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path)).string();
  };
  const std::string output = whole(request.output), run = whole(request.run);
  if (output == run || run_folder(output) == run)
    throw Error(ExitCode::usage, request.output + " is the damaged run; choose another output with -o");
  std::error_code unknown;
  if (fs::is_directory(request.output, unknown))
    throw Error(ExitCode::cannot_create, request.output + " is a folder; choose another output with -o");
  if (request.overwrite) return;
  for (const std::string& path : {request.output, run_folder(request.output)})
    if (fs::exists(path, unknown))
      throw Error(ExitCode::cannot_create,
                  path + " exists already; replace it with --overwrite, or choose another output with -o");
}

std::uint64_t rows_of(const RunPieces& pieces, const std::string& path) {
  const auto found = pieces.arrays.find(path);
  return found == pieces.arrays.end() || found->second.dims.empty() ? 0 : found->second.dims[0];
}

void set_fact(RunPieces& pieces, const std::string& name, const std::string& fact) {
  const auto bytes = std::as_bytes(std::span(fact));
  set_array(pieces, "/provenance/" + name, {{}, {bytes.begin(), bytes.end()}});
}

/// What was lost in an earlier repair is so still.
void note_origin(RunPieces& pieces, const std::string& run, bool goes_on) {
  set_fact(pieces, "repaired_from", run);
  const std::string before = text_of(pieces, std::string("/provenance/").append(lost_fact));
  std::string lost = lost_text(pieces);
  if (!before.empty()) lost = before + (lost.empty() ? "" : "; ") + lost;
  if (!goes_on || !lost.empty()) set_fact(pieces, lost_fact, lost);
}

void refuse_nothing(const RunPieces& pieces, const std::string& run) {
  if (!pieces.frames.empty() || rows_of(pieces, "/observables/step") > 0 ||
      rows_of(pieces, "/steps/step") > 0 || pieces.arrays.contains("/checkpoint/state_hash"))
    return;
  throw Error(ExitCode::bad_data, run +
                                      ": nothing can be kept: no frame, no series and no state is whole; "
                                      "restore the run from a copy, or compute it again");
}

/// The numbers that the frames which are kept had before.
std::vector<std::size_t> numbers_of(const RunPieces& pieces) {
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; numbers.size() < pieces.frames.size(); ++k)
    if (std::ranges::find(pieces.lost_frames, k, &LostFrame::number) == pieces.lost_frames.end())
      numbers.push_back(k);
  return numbers;
}

/// Frames that can be read and yet cannot be are those of damage that no hash tells.
void leave_out_faulty(RunPieces& pieces, const RepairRequest& request) {
  if (pieces.verified || !request.faulty_frames) return;
  const std::vector<std::size_t> numbers = numbers_of(pieces);
  RunPieces marked = pieces;
  set_fact(marked, lost_fact, "not known yet");
  const auto faulty = request.faulty_frames(RunFile::of_bytes(file_of(marked), request.run));
  std::vector<StoredFrame> kept;
  for (std::size_t k = 0; k < pieces.frames.size(); ++k)
    if (std::ranges::find(faulty, k) == faulty.end())
      kept.push_back(std::move(pieces.frames[k]));
    else
      pieces.lost_frames.push_back({numbers[k], tilt_of(pieces.frames[k])});
  pieces.frames = std::move(kept);
  std::ranges::sort(pieces.lost_frames, {}, &LostFrame::number);
}

/// The packed file and a folder beside it would be two runs of one name.
void write_packed(const RunPieces& pieces, const RepairRequest& request) {
  const std::vector<std::byte> bytes = file_of(pieces);
  RunFile::of_bytes(bytes, request.output);  // nothing is written that cannot be read
  write_durably(request.output, bytes, request.output + ".tmp");
  discard_folder(request.output);
}

void write_folder(const RunPieces& pieces, const RepairRequest& request) {
  const RunFile run = RunFile::of_bytes(file_of(pieces), request.output);
  Segment segment;
  for (std::size_t k = 0; k < run.all_frame_tilts().size(); ++k) segment.frames.push_back(run.frame(k));
  segment.observables = run.all_observables();
  segment.steps = run.steps();
  segment.commands = run.commands();
  RunStore::create(request.output, run.header(), request.overwrite).commit(segment, run.checkpoint());
}

std::string count_text(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what;
}

std::vector<std::string> kept_lines(const RunPieces& pieces, std::size_t frames) {
  std::vector<std::string> lines = {count_text(pieces.frames.size(), "of ") + count_text(frames, "frames"),
                                    count_text(rows_of(pieces, "/observables/step"), "rows of observables"),
                                    count_text(rows_of(pieces, "/steps/step"), "steps"),
                                    count_text(rows_of(pieces, "/commands/step"), "commands")};
  if (pieces.arrays.contains("/checkpoint/state_hash")) lines.emplace_back("the last state");
  return lines;
}

void append_lines(std::vector<std::string>& lines, const std::vector<LostPiece>& pieces) {
  for (const LostPiece& lost : pieces) lines.push_back(std::string(lost.name).append(": ").append(lost.how));
}

std::vector<std::string> lost_lines(const RunPieces& pieces) {
  std::vector<std::string> lines;
  append_lines(lines, pieces.lost);
  for (const std::string& frames : lost_frame_lines(pieces)) lines.push_back(frames);
  return lines;
}

}  // namespace

RepairReport repair_run(const RepairRequest& request) {
  const std::optional<std::string> folder = folder_of(request.run);
  RepairReport report;
  report.of_folder = folder.has_value();
  report.was_whole = is_whole(request.run);
  if (report.was_whole) return report;
  refuse_output(request);
  Salvage salvage = folder ? salvage_folder(*folder) : salvage_file(request.run);
  RunPieces& pieces = salvage.pieces;
  if (!salvage.goes_on) leave_out_faulty(pieces, request);
  refuse_nothing(pieces, request.run);
  report.lost = lost_lines(pieces);
  note_origin(pieces, request.run, salvage.goes_on);
  if (salvage.goes_on)
    write_folder(pieces, request);
  else
    write_packed(pieces, request);
  report.goes_on = salvage.goes_on;
  report.verified = pieces.verified;
  report.kept = kept_lines(pieces, salvage.frames);
  append_lines(report.lost, salvage.not_needed);
  if (salvage.goes_on && salvage.frames > pieces.frames.size())
    report.lost.push_back(count_text(salvage.frames - pieces.frames.size(),
                                     "frames after the state that is kept; they are computed again"));
  return report;
}

std::vector<std::string> damaged_pieces(const std::string& run) {
  const std::optional<std::string> folder = folder_of(run);
  return lost_lines(folder ? inspect_folder(*folder) : inspect_file(run));
}

}  // namespace talus
