#pragma once
/// The records of a run to and from HDF5: header, frames, series, checkpoint. The same data sets stand in the
/// files of a run folder and in a packed file. Private to this room.

#include <functional>

#include "core/bed_frame.h"
#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"
#include "io/run_store.h"

namespace talus::io {

/// Adds the sizes of the state that a branch begins from, where the run is one.
Sizes with_branch(Sizes sizes, const RunHeader& header);

/// /parameters, /provenance and the static data sets of /particles. Sizes: N.
void write_header(hdf5::Writer& writer, const RunHeader& header);
/// Refuses a file of another version of the schema.
void check_version(hdf5::Reader& reader);
/// Facts of the provenance that `keeps` does not keep, of all that it is asked for by path, are left out.
RunHeader read_header(hdf5::Reader& reader, const std::function<bool(const std::string&)>& keeps = {});

/// /frames, the time-dependent data sets of /particles, and /contacts. Sizes: T, N, M.
/// `frame_at(k)` is called once for each frame, in order.
void write_frames(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at);
/// Of the frames only /frames/step, time and tilt.
void write_instants(hdf5::Writer& writer, const std::function<Frame(std::size_t)>& frame_at);
/// Frame `row` of the file; or only its step, time, tilt, x and y.
Frame read_frame(hdf5::Reader& reader, std::size_t row);
Frame read_positions(hdf5::Reader& reader, std::size_t row);
/// The value of /frames/hash: of the number of bytes and the bytes of each data set, as they are stored.
std::uint64_t frame_hash(const Frame& frame);
/// How far from the origin a grain or a contact can be along either axis, m: as cells of the size of a grain,
/// it must still be a number of cells.
double farthest_place(const RunStatics& statics);
/// Refuses a frame whose grains or contacts cannot be those of a bed with so many planes: what others use as
/// an index, or make a grid from, without looking.
void check_frame(const hdf5::Reader& reader, const BedFrame& bed, std::size_t planes);

/// The metadata that H5MD 1.1 asks for, and the meaning of each data set.
void write_h5md(hdf5::Writer& writer, bool periodic);
void write_help(hdf5::Writer& writer);

/// /observables and /steps. Sizes: R, S.
void write_observables(hdf5::Writer& writer, const std::vector<ObservableRow>& rows);
void write_steps(hdf5::Writer& writer, const std::vector<StepRow>& rows);
std::vector<ObservableRow> read_observables(hdf5::Reader& reader);
std::vector<StepRow> read_steps(hdf5::Reader& reader);

/// /commands, a group that is there where there are any. Sizes: K.
void write_commands(hdf5::Writer& writer, const std::vector<Command>& commands);
std::vector<Command> read_commands(hdf5::Reader& reader);

/// /trials, a group that is there where there are any. Sizes: Q.
void write_trials(hdf5::Writer& writer, const std::vector<TrialRow>& rows);
std::vector<TrialRow> read_trials(hdf5::Reader& reader);

/// /checkpoint, /results and /provenance/timing. Sizes: G, C, P.
void write_checkpoint(hdf5::Writer& writer, const Checkpoint& checkpoint);
Checkpoint read_checkpoint(hdf5::Reader& reader);
/// /branch, of a run that begins with a frame of another one. Sizes: G, B, P.
void write_branch(hdf5::Writer& writer, const BranchOrigin& branch);
BranchOrigin read_branch(hdf5::Reader& reader);
/// Of a repaired run whose last state is lost: only /results and /provenance/timing.
void write_results(hdf5::Writer& writer, const Checkpoint& checkpoint);
Checkpoint read_results(hdf5::Reader& reader);

/// The data sets of the run, without its analysis, that a file says it holds.
std::vector<std::string> listed_data_sets(hdf5::Reader& reader);
/// Whether a data set agrees with its own hash. One that is covered by the hashes of the frames does; one
/// that cannot be read does not.
bool is_as_written(hdf5::Reader& reader, const std::string& path);
/// Paths of the data sets that do not, those of a stored analysis included.
std::vector<std::string> changed_data_sets(hdf5::Reader& reader);

/// The provenance that says what was lost of a run before it was repaired.
inline constexpr const char* lost_fact = "repaired_lost";

}  // namespace talus::io
