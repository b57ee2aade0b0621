#include <algorithm>
#include <deque>
#include <fmt/core.h>
#include <optional>
#include <set>
#include <utility>

#include "base/errors.h"
#include "base/output_file.h"
#include "base/text.h"
#include "io/child_process.h"
#include "io/durable_file.h"
#include "io/packed_file.h"
#include "io/run_file.h"
#include "io/run_folder.h"
#include "io/run_records.h"

namespace talus::io {
namespace {

using Bytes = std::vector<std::byte>;
using Lines = std::vector<std::string>;

/// A file of a run: a packed file is the entire run; a folder has one file for each commit and two more.
struct Part {
  std::string name;  ///< name in the folder; empty for a packed file
  Bytes bytes;
};

/// The new run, packed (empty if nothing can be kept), and the lines of the report.
struct Salvage {
  Bytes file;
  Lines kept, lost;
};

constexpr const char* origin_fact = "repaired_from";
constexpr const char* lost_analysis = "/analysis: is not part of the run; recompute it with talus analyze";

/// Whether the folder has a header, which has a number if the run replaced another one in its folder.
bool has_header(const std::string& folder) {
  std::error_code unknown;
  return std::ranges::any_of(names_in(folder, unknown), [](const std::string& name) {
    return name.starts_with("header") && name.ends_with(".h5");
  });
}

std::optional<std::string> folder_of(const std::string& run) {
  if (is_file(run) && !run.ends_with(".toml") && !begins_as_averages(run)) return std::nullopt;
  for (const std::string& folder : {run, run_folder(run)})
    if (is_there(path_in(folder, Manifest::file_name)) || has_header(folder)) return folder;
  refuse_no_run(run);
}

/// Pads a file to its original size. After that HDF5 opens it, and the data before the cut can be read.
Bytes padded(Bytes bytes) {
  constexpr std::uint64_t most = 8;  // times the remaining size
  const std::uint64_t size = sealed_size(bytes);
  if (size > bytes.size() && size / most <= bytes.size()) bytes.resize(size);
  return bytes;
}

/// Returns the files of a folder in the order of their commits; without a manifest, the files found there.
Lines files_in(const std::string& folder, Lines& lost) {
  Lines names;
  try {
    for (const StoredFile& file : files_of(read_manifest(folder))) names.push_back(file.name);
  } catch (const Error&) {
    lost.emplace_back("manifest: is not as it was written");
    for (const std::string& name : names_in(folder))
      if (name.ends_with(".h5")) names.push_back(name);
    // Sorted by the length of their names: the header, segments, checkpoints.
    std::ranges::sort(names, {}, [](const std::string& name) { return std::pair(name.size(), name); });
  }
  return names;
}

std::vector<Part> parts_of(const std::string& run, Lines& lost) {
  const std::optional<std::string> folder = folder_of(run);
  if (!folder) return {{"", padded(read_file(run))}};
  std::vector<Part> parts;
  for (const std::string& name : files_in(*folder, lost))
    if (const std::string path = path_in(*folder, name); is_there(path))
      parts.push_back({name, read_file(path)});
    else
      lost.push_back(name + ": is missing");
  return parts;
}

/// Reads the parts in a child process, in which HDF5 can do no harm. Except for frames and facts, data are
/// kept or dropped group by group.
class Salvager {
 public:
  Salvager(std::string run, Lines lost) : name_(std::move(run)) { salvage_.lost = std::move(lost); }

  Salvage salvage(std::vector<Part> parts) {
    for (Part& part : parts) try {
        prefix_ = part.name.empty() ? "" : part.name + ": ";
        const std::string name = part.name.empty() ? "the file" : part.name;
        readers_.push_back(Reader::from_memory(std::move(part.bytes), name, {}));
        add_part(readers_.back());
      } catch (const Error& error) {
        salvage_.lost.emplace_back(error.what());
      }
    const std::size_t state = run_.checkpoint.world.grains.x.size();
    if (places_.size() + run_.series.observables.size() + run_.series.steps.size() + state == 0)
      salvage_.lost.emplace_back("no frame, series or state is undamaged");
    else if (has_header_)
      pack();
    else
      salvage_.lost.emplace_back(
          "/parameters and /particles are damaged, and without them no frame can be read");
    if (has_analysis_) salvage_.lost.emplace_back(lost_analysis);
    return std::move(salvage_);
  }

 private:
  void report_loss(const std::string& path, const std::string& with) {
    salvage_.lost.push_back(fmt::format("{}{}: is not as it was written{}", prefix_, path, with));
  }

  /// Returns the data sets that a part should have; if its list is lost, those that every run has.
  Lines contents_of(Reader& reader) {
    if (is_as_written(reader, "/contents")) return listed_data_sets(reader);
    report_loss("/contents", ", so the last state, results and commands are left out");
    Lines paths;
    for (const DataSetField& field : run_schema())
      for (const char* group : {"/parameters/", "/particles/", "/frames/", "/observables/", "/steps/"})
        if (field.path.starts_with(group) && reader.has(field.path)) paths.push_back(field.path);
    return paths;
  }

  /// Returns the group that is kept or dropped together. The state needs the results.
  static std::string group_of(const std::string& path) {
    if (path.starts_with("/provenance/timing/")) return "/results";
    return path == "/provenance/seed" ? "/parameters" : path.substr(0, path.find('/', 1));
  }

  /// Returns the undamaged groups of a part.
  std::set<std::string> whole_groups(Reader& reader) {
    std::set<std::string> whole, broken;
    for (const std::string& path : contents_of(reader)) {
      const std::string group = group_of(path);
      whole.insert(group);
      if (is_as_written(reader, path)) continue;
      if (group == "/provenance") {  // facts are kept individually
        report_loss(path, "");
        continue;
      }
      report_loss(path, fmt::format(", so all of {}{} is left out", group,
                                    group == "/results" ? " and /checkpoint" : ""));
      broken.insert(group);
    }
    for (const std::string& group : broken) whole.erase(group);
    return whole;
  }

  void add_part(Reader& reader) {
    if (reader.has("/parameters")) check_version(reader);
    has_analysis_ = has_analysis_ || reader.has("/analysis");
    const std::set<std::string> whole = whole_groups(reader);
    if (whole.contains("/parameters") && whole.contains("/particles")) {
      run_.header = read_header(reader, [&](const std::string& path) {
        return path == "/branch" ? whole.contains(path) : is_as_written(reader, path);
      });
      has_header_ = true;
    }
    if (whole.contains("/frames") && reader.has("/frames/hash")) add_frames(reader);
    if (reader.has("/own")) add_own(reader);
    if (whole.contains("/observables")) append(run_.series.observables, read_observables(reader));
    if (whole.contains("/steps")) append(run_.series.steps, read_steps(reader));
    if (whole.contains("/commands")) append(run_.series.commands, read_commands(reader));
    if (whole.contains("/trials")) append(run_.series.trials, read_trials(reader));
    if (!whole.contains("/results")) return;
    run_.checkpoint = whole.contains("/checkpoint") ? read_checkpoint(reader) : read_results(reader);
  }

  /// Adds the frames that match their hashes, whatever else is damaged.
  void add_frames(Reader& reader) {
    const auto hashes = reader.read<std::uint64_t>("/frames/hash");
    frames_before_ += hashes.size();
    std::size_t lost = 0;  // length of the current sequence of lost frames
    for (std::size_t row = 0; row < hashes.size(); ++row) {
      const bool kept = add_frame(reader, row, hashes[row]);
      if (kept) report_lost_frames(reader, row - lost, lost);
      lost = kept ? 0 : lost + 1;
    }
    report_lost_frames(reader, hashes.size() - lost, lost);
  }

  void report_lost_frames(Reader& reader, std::size_t first, std::size_t count) {
    if (count == 0) return;
    std::string line = count == 1 ? fmt::format("{}frame {}", prefix_, first)
                                  : fmt::format("{}frames {} to {}", prefix_, first, first + count - 1);
    try {
      const double tilt = reader.read<double>("/frames/tilt", {}, hdf5::Rows{first, 1})[0];
      line += fmt::format(", {} {} deg", count == 1 ? "at" : "from", degrees_text(tilt, 3));
    } catch (const Error&) {  // the tilt is lost too
    }
    salvage_.lost.push_back(line);
  }

  bool add_frame(Reader& reader, std::size_t row, std::uint64_t hash) try {
    const Frame frame = read_frame(reader, row);
    if (frame_hash(frame) != hash) return false;
    run_.contacts += frame.contacts.a.size();
    places_.emplace_back(readers_.size() - 1, row);
    return true;
  } catch (const Error&) {
    return false;
  }

  /// Adds the undamaged quantities of scripts; their rows are those of all frames.
  void add_own(Reader& reader) try {
    for (const std::string& path : own_data_sets(reader)) {
      if (places_.size() == frames_before_ && is_as_written(reader, path)) {
        own_.push_back(read_own_head(reader, path));
        own_.back().values = read_own_values(reader, own_.back());
      } else {
        salvage_.lost.push_back(path + ": is not as it was written, or lacks frames; store it again");
      }
    }
  } catch (const Error& error) {
    own_.clear();
    salvage_.lost.push_back(fmt::format("/own: {}", error.what()));
  }

  /// Adds what was lost before an earlier repair to the record.
  void note_origin() {
    Facts& facts = run_.header.provenance;
    std::string lost = find_value(facts, lost_fact).value_or("");
    for (const std::string& line : salvage_.lost) lost += (lost.empty() ? "" : "; ") + line;
    std::erase_if(facts,
                  [](const auto& fact) { return fact.first == lost_fact || fact.first == origin_fact; });
    facts.emplace_back(origin_fact, name_);
    facts.emplace_back(lost_fact, lost);
  }

  void pack() {
    note_origin();
    run_.frames = places_.size();
    run_.frame_at = [this](std::size_t k) {
      return read_frame(readers_[places_[k].first], places_[k].second);
    };
    salvage_.file = packed_bytes(run_);
    if (!own_.empty())
      salvage_.file = with_own(
          salvage_.file, name_,
          {{'T', run_.frames}, {'N', run_.header.statics.radius.size()}, {'M', run_.contacts}}, own_);
    salvage_.kept = {fmt::format("{} of {}", run_.frames, counted(frames_before_, "frame")),
                     counted(run_.series.observables.size(), "row") + " of observables",
                     counted(run_.series.steps.size(), "step"),
                     counted(run_.series.commands.size(), "command")};
    if (!lacks_state(run_.header, run_.checkpoint)) salvage_.kept.emplace_back("the last state");
    for (const OwnQuantity& own : own_) salvage_.kept.push_back(path_of(own));
  }

  std::string name_;
  Salvage salvage_;
  std::string prefix_;  ///< prefix of the lines about the current part
  std::deque<Reader> readers_;
  RunContent run_;
  std::vector<OwnQuantity> own_;
  bool has_header_ = false, has_analysis_ = false;
  std::size_t frames_before_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> places_;  ///< part and row of each kept frame
};

Salvage salvage_run(const std::string& run) {
  Lines lost;
  std::vector<Part> parts = parts_of(run, lost);
  std::size_t size = 0;
  for (const Part& part : parts) size += part.bytes.size();
  Parcels found = in_child_process(run, size, [&] {
    Salvage made = Salvager(run, std::move(lost)).salvage(std::move(parts));
    return Parcels{{"file", std::move(made.file)},
                   {"kept", bytes_of(joined(made.kept, "\n"))},
                   {"lost", bytes_of(joined(made.lost, "\n"))}};
  });
  const auto lines = [&](const char* name) { return lines_of(values_of<std::string>(found[name])); };
  return {std::move(found["file"]), lines("kept"), lines("lost")};
}

/// Whether a run opens, and its contents match their own hashes.
bool is_whole(const std::string& run) try {
  const RunFile file = RunFile::open(run);
  for (std::size_t k = 0; file.has_frames() && k < file.all_frame_tilts().size(); ++k)
    if (!file.is_as_written(file.stored_frame(k), k)) return false;
  return file.changed_data_sets().empty();
} catch (const Error& error) {
  if (error.code() != ExitCode::bad_data && error.code() != ExitCode::missing_input) throw;
  return false;
}

void refuse_output(const RepairRequest& request) {
  require_run_name(request.output);
  output_target(request.output, {true, {request.run, run_folder(request.run)}});
  for (const std::string& path : {request.output, run_folder(request.output)}) {
    if (resolved_path(path) == resolved_path(request.run))
      throw Error(ExitCode::usage, request.output + " is the damaged run; choose another output with -o");
    if (!request.overwrite && is_there(path))
      throw Error(ExitCode::cannot_create,
                  path + " exists already; replace it with --overwrite, or choose another output with -o");
  }
  if (!request.overwrite) keep_free(request.output);
}

}  // namespace

RepairReport repair_run(const RepairRequest& request) {
  const std::optional<std::string> folder = folder_of(request.run);
  if (is_whole(request.run)) return {true, folder.has_value(), {}, {}};
  refuse_output(request);
  if (folder) require_no_writer(*folder);
  Salvage salvage = salvage_run(request.run);
  if (salvage.file.empty())
    throw Error(ExitCode::bad_data,
                "{}: nothing can be saved: {}; restore the run from a copy, or compute it again", request.run,
                salvage.lost.at(0));
  RunFile::from_bytes(salvage.file,
                      request.output);  // checks that the output can be read before it is written
  prepare_folder_of(request.output);
  write_durably(request.output, salvage.file);
  discard_folder(request.output, true);  // next to the file it would be another run of the same name
  return {false, folder.has_value(), std::move(salvage.kept), std::move(salvage.lost)};
}

std::vector<std::string> damaged_pieces(const std::string& run) try {
  Lines lost = salvage_run(run).lost;
  std::erase(lost, lost_analysis);
  return lost;
} catch (const Error& error) {
  if (error.code() != ExitCode::bad_data) throw;
  return {error.what()};  // HDF5 crashes on it
}

}  // namespace talus::io
