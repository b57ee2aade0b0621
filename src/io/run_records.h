#pragma once
/// Conversion of the records of a run to and from HDF5: header, frames, series, checkpoint. The files of a
/// run folder and a packed file contain the same data sets. Private to src/io.

#include <functional>

#include "core/bed_frame.h"
#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"
#include "io/record_fields.h"
#include "io/run_store.h"

namespace talus::io {

/// Adds the sizes of the state from which a branch begins, if the run is a branch.
Sizes with_branch(Sizes sizes, const RunHeader& header);

/// Writes /parameters, /provenance and the static data sets of /particles. Sizes: N.
void write_header(hdf5::Writer& writer, const RunHeader& header);
/// Rejects a file with another version of the schema.
void check_version(hdf5::Reader& reader);
/// Reads the header; facts of the provenance for whose path `keeps` returns false are left out.
RunHeader read_header(hdf5::Reader& reader, const std::function<bool(const std::string&)>& keeps = {});

/// Writes /frames, the time-dependent data sets of /particles, and /contacts. Sizes: T, N, M. `frame_at(k)`
/// is called once for each frame, in order.
void write_frames(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at);
/// Writes only /frames/step, time and tilt of the frames.
void write_instants(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at);
/// Read frame `row` of the file, entirely or only its step, time, tilt, x and y.
Frame read_frame(hdf5::Reader& reader, std::size_t row);
Frame read_positions(hdf5::Reader& reader, std::size_t row);
/// Returns the value of /frames/hash: the hash of the size and the bytes of each data set, as stored.
std::uint64_t frame_hash(const Frame& frame);
/// Rejects a frame whose grains or contacts cannot belong to a bed with `planes` planes and farthest_place
/// `farthest`, because other code uses these values as indices, or sizes grids by them, without a check.
void check_frame(const RecordCheck& record, const Frame& frame, double farthest, std::size_t planes);

/// Writes the metadata that H5MD 1.1 requires, and the meaning of each data set.
void write_h5md(hdf5::Writer& writer, bool periodic);
void write_help(hdf5::Writer& writer);

/// Write and read /observables and /steps. Sizes: R, S.
void write_observables(hdf5::Writer& writer, const std::vector<ObservableRow>& rows);
void write_steps(hdf5::Writer& writer, const std::vector<StepRow>& rows);
std::vector<ObservableRow> read_observables(hdf5::Reader& reader);
std::vector<StepRow> read_steps(hdf5::Reader& reader);

/// Write and read /commands, a group that exists only if there are commands. Sizes: K.
void write_commands(hdf5::Writer& writer, const std::vector<Command>& commands);
std::vector<Command> read_commands(hdf5::Reader& reader);

/// Write and read /trials, a group that exists only if there are trials. Sizes: Q.
void write_trials(hdf5::Writer& writer, const std::vector<TrialRow>& rows);
std::vector<TrialRow> read_trials(hdf5::Reader& reader);

/// Write and read /checkpoint, /results and /provenance/timing. Sizes: G, C, P.
void write_checkpoint(hdf5::Writer& writer, const Checkpoint& checkpoint);
Checkpoint read_checkpoint(hdf5::Reader& reader);
/// Write and read /branch, for a run that begins with a frame of another one. Sizes: G, B, P.
void write_branch(hdf5::Writer& writer, const BranchOrigin& branch);
BranchOrigin read_branch(hdf5::Reader& reader);
/// Write and read only /results and /provenance/timing, for a repaired run without its last state.
void write_results(hdf5::Writer& writer, const Checkpoint& checkpoint);
Checkpoint read_results(hdf5::Reader& reader);

/// Returns the data sets of the run, without its analysis, that a file lists.
std::vector<std::string> listed_data_sets(hdf5::Reader& reader);
/// Whether a data set matches its own hash. Data sets covered by the hashes of frames do; unreadable ones do
/// not.
bool is_as_written(hdf5::Reader& reader, const std::string& path);
/// Returns the paths of the data sets that do not match, including those of a stored analysis.
std::vector<std::string> changed_data_sets(hdf5::Reader& reader);

/// The provenance fact that records what a run lost before it was repaired.
inline constexpr const char* lost_fact = "repaired_lost";

}  // namespace talus::io
