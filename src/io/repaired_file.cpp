#include "io/repaired_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/errors.h"
#include "core/trigonometry.h"
#include "io/packed_file.h"
#include "io/run_records.h"

namespace talus {
namespace {

using Bytes = std::vector<std::byte>;

template <typename T>
StoredArray array_of(const std::vector<T>& values, std::vector<std::uint64_t> dims) {
  const auto bytes = std::as_bytes(std::span(values));
  return {std::move(dims), {bytes.begin(), bytes.end()}};
}

/// Takes all arrays of a group away, and notes it once, with the first that was lost.
void leave_out(RunPieces& pieces, const std::string& group, const std::string& how) {
  const auto paths = pieces.order;
  for (const std::string& path : paths)
    if (path.starts_with(group + "/")) drop_array(pieces, path);
  std::erase_if(pieces.lost, [&](const LostPiece& lost) { return lost.name.starts_with(group + "/"); });
  if (std::ranges::find(pieces.lost, group, &LostPiece::name) == pieces.lost.end())
    pieces.lost.push_back({group, how});
}

/// What is left out where one of it is lost.
void keep_whole_or_not(RunPieces& pieces, const std::string& group) {
  for (const LostPiece& lost : pieces.lost)
    if (lost.name.starts_with(group + "/")) {
      const std::string how = std::string(lost.name).append(" ").append(lost.how);
      return leave_out(pieces, group, how);
    }
}

/// Whether an array has the shape of its field, with letters that have the sizes known so far or none yet.
bool agrees(const DataSetField& field, const std::vector<std::uint64_t>& dims, Sizes& sizes) {
  const std::vector<Extent> shape = extents(field);
  if (shape.size() != dims.size()) return false;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    if (dims[d] < shape[d].plus) return false;
    const std::uint64_t size = dims[d] - shape[d].plus;
    if (shape[d].symbol == '\0' ? size != 0 : sizes.emplace(shape[d].symbol, size).first->second != size)
      return false;
  }
  return true;
}

/// Arrays of a file without hashes need not agree.
void leave_out_other_shapes(RunPieces& pieces) {
  Sizes sizes;
  const auto paths = pieces.order;
  for (const std::string& path : paths) {
    if (agrees(field_of(path), pieces.arrays.at(path).dims, sizes)) continue;
    drop_array(pieces, path);
    pieces.lost.push_back({path, "has another shape than what belongs to it"});
  }
}

Sizes sizes_of(const RunPieces& pieces) {
  Sizes sizes = {{'T', pieces.frames.size()}, {'M', 0}};
  for (const std::string& path : pieces.order) agrees(field_of(path), pieces.arrays.at(path).dims, sizes);
  for (const StoredFrame& frame : pieces.frames) sizes['M'] += frame.contacts;
  return sizes;
}

void require(const RunPieces& pieces, const std::string& path) {
  for (const char* needed :
       {"/parameters/scenario_resolved", "/parameters/periodic", "/parameters/mean_diameter",
        "/parameters/gravity", "/parameters/friction", "/provenance/seed", "/particles/grains/box/edges",
        "/particles/grains/species", "/particles/grains/radius", "/particles/grains/mass"})
    if (!pieces.arrays.contains(needed))
      throw Error(ExitCode::bad_data, path + ": nothing can be kept: data set " + needed +
                                          " is lost, without which no frame can be read; restore the run "
                                          "from a copy, or compute it again");
}

/// What another version of Talus has written may mean something else.
void require_known_version(const RunPieces& pieces, const std::string& path) {
  const auto found = pieces.arrays.find("/parameters/schema_version");
  std::int32_t version = run_schema_version;
  if (found != pieces.arrays.end() && found->second.values.size() == sizeof version)
    std::memcpy(&version, found->second.values.data(), sizeof version);
  if (version < oldest_run_schema_version || version > run_schema_version)
    throw Error(ExitCode::bad_data, path + ": data set /parameters/schema_version is " +
                                        std::to_string(version) + ", this Talus reads versions " +
                                        std::to_string(oldest_run_schema_version) + " to " +
                                        std::to_string(run_schema_version));
}

/// What stands in the file for its reader, and follows from the rest.
void make_again(RunPieces& pieces) {
  std::vector<Index> ids(pieces.arrays.at("/particles/grains/species").values.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<Index>(i);
  set_array(pieces, "/particles/grains/id", array_of(ids, {ids.size()}));
  set_array(pieces, "/parameters/schema_version", array_of(std::vector{run_schema_version}, {}));
  if (!pieces.arrays.contains("/parameters/scenario_given"))
    set_array(pieces, "/parameters/scenario_given", {});
  drop_array(pieces, "/contents");
  for (const char* path : {"/particles/grains/id", "/parameters/schema_version"})
    std::erase_if(pieces.lost, [&](const LostPiece& lost) { return lost.name == path; });
}

/// Without /contents nobody knows whether there was more.
void doubt_without_contents(RunPieces& pieces) {
  const std::size_t before = pieces.lost.size();
  std::erase_if(pieces.lost, [](const LostPiece& lost) { return lost.name == "/contents"; });
  if (pieces.lost.size() == before) return;
  const std::string how = "/contents is lost, so nobody knows whether it is complete";
  leave_out(pieces, "/checkpoint", how);
  if (!pieces.arrays.contains("/commands/step")) pieces.lost.push_back({"/commands", how});
}

template <typename Fields>
void mend_table(RunPieces& pieces, const std::string& group, const Fields& fields,
                std::span<const char* const> keys) {
  const auto rows_of = [&](const std::string& path) {
    const auto found = pieces.arrays.find(path);
    return found == pieces.arrays.end() || found->second.dims.size() != 1 ? std::optional<std::uint64_t>()
                                                                          : found->second.dims[0];
  };
  const auto rows = rows_of(group + "/step");
  const bool usable =
      rows && std::ranges::all_of(keys, [&](const char* key) { return rows_of(group + "/" + key) == rows; });
  if (!usable && !pieces.arrays.contains(group + "/step"))
    leave_out(pieces, group, "its column step is lost");
  else if (!usable)
    leave_out(pieces, group, "a column without which it cannot be read is lost");
  for (const auto& field : fields) {
    const std::string path = group + "/" + std::string(field.name);
    if (usable && rows_of(path) == rows) continue;
    const std::uint64_t count = usable ? *rows : 0;
    set_array(pieces, path,
              array_of(std::vector<double>(count, std::numeric_limits<double>::quiet_NaN()), {count}));
  }
}

/// The reader's own checks, of what no hash has proven; of the rest they find nothing.
void leave_out_what_is_refused(RunPieces& pieces, const std::string& path) {
  std::vector<StoredFrame> frames = std::exchange(pieces.frames, {});
  hdf5::Reader reader = hdf5::Reader::from_memory(file_of(pieces), path, {});
  pieces.frames = std::move(frames);
  const auto try_to = [&](const std::string& group, const auto& read) {
    try {
      read();
      return true;
    } catch (const Error& error) {
      leave_out(pieces, group, error.what());
      return false;
    }
  };
  try {
    read_header(reader);
  } catch (const Error& error) {
    throw Error(error.code(), std::string("nothing can be kept: ") + error.what());
  }
  if (pieces.arrays.contains("/checkpoint/state_hash"))
    try_to("/checkpoint", [&] { read_checkpoint(reader); });
  try_to("/commands", [&] { read_commands(reader); });
  if (!try_to("/observables", [&] { read_observables(reader); }) ||
      !try_to("/steps", [&] { read_steps(reader); }))
    mend_series(pieces);
}

std::string numbers_text(std::size_t first, std::size_t last) {
  return first == last ? "frame " + std::to_string(first)
                       : "frames " + std::to_string(first) + " to " + std::to_string(last);
}

std::string tilts_text(double first, double last) {
  std::array<char, 80> text{};
  if (std::isnan(first) || std::isnan(last)) return "";
  if (first == last)
    std::snprintf(text.data(), text.size(), ", at %.3f deg", degrees(first));
  else
    std::snprintf(text.data(), text.size(), ", at %.3f to %.3f deg", degrees(first), degrees(last));
  return text.data();
}

}  // namespace

void mend_series(RunPieces& pieces) {
  constexpr std::array observable_keys = {"step", "time", "tilt"};
  constexpr std::array step_keys = {"step", "phase"};
  mend_table(pieces, "/observables", observable_fields, observable_keys);
  mend_table(pieces, "/steps", step_fields, step_keys);
}

void mend(RunPieces& pieces, const std::string& path) {
  require_known_version(pieces, path);
  leave_out_other_shapes(pieces);
  doubt_without_contents(pieces);
  require(pieces, path);
  make_again(pieces);
  for (const char* group : {"/checkpoint", "/commands"}) keep_whole_or_not(pieces, group);
  if (!pieces.arrays.contains("/checkpoint/state_hash")) leave_out(pieces, "/checkpoint", "is missing");
  mend_series(pieces);
  leave_out_what_is_refused(pieces, path);
}

std::vector<std::string> lost_frame_lines(const RunPieces& pieces) {
  std::vector<std::string> lines;
  const std::vector<LostFrame>& lost = pieces.lost_frames;
  for (std::size_t k = 0, end = 0; k < lost.size(); k = end) {
    for (end = k + 1; end < lost.size() && lost[end].number == lost[end - 1].number + 1;) ++end;
    lines.push_back(numbers_text(lost[k].number, lost[end - 1].number) +
                    tilts_text(lost[k].tilt, lost[end - 1].tilt));
  }
  return lines;
}

std::string lost_text(const RunPieces& pieces) {
  std::string text;
  for (const LostPiece& lost : pieces.lost) text.append(text.empty() ? "" : "; ").append(lost.name);
  for (const std::string& line : lost_frame_lines(pieces)) text.append(text.empty() ? "" : "; ").append(line);
  return text;
}

Bytes file_of(const RunPieces& pieces) {
  hdf5::Writer writer(sizes_of(pieces), seal_size);
  for (const std::string& path : pieces.order)
    if (field_of(path).type == ElementType::text)
      writer.write_text(path, text_of(pieces, path));
    else
      writer.write_bytes(path, pieces.arrays.at(path).values);
  for (const char* group : {"/results", "/provenance/timing"}) writer.create_group(group);
  if (pieces.arrays.contains("/checkpoint/state_hash"))
    for (const char* group : {"/checkpoint/integers", "/checkpoint/reals"}) writer.create_group(group);
  write_h5md(writer, pieces.arrays.at("/parameters/periodic").values.at(0) != std::byte{0});
  write_stored_frames(writer, [&pieces](std::size_t k) { return pieces.frames[k]; });
  writer.write_contents();
  write_help(writer);
  Bytes file = writer.image();
  seal(file);
  return file;
}

}  // namespace talus
