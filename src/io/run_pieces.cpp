#include "io/run_pieces.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

#include "core/errors.h"
#include "core/text_stream.h"
#include "io/child_process.h"
#include "io/piece_code.h"

namespace talus {
namespace {

using Bytes = std::vector<std::byte>;

constexpr const char* cannot_be_read = "cannot be read";
constexpr const char* not_as_written = "is not as it was written";

bool is_family(const std::string& path) { return path.ends_with("/*"); }

/// Whether a path is one of the schema; none is trusted that a damaged file names.
bool is_known(const std::string& path) {
  const std::string family = path.substr(0, path.rfind('/')) + "/*";
  return std::ranges::any_of(run_schema(), [&](const DataSetField& field) {
    return (field.path == path && !is_by_frame(field)) || (field.path == family && !is_family(path));
  });
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream from = text_stream(text);
  for (std::string line; std::getline(from, line);) lines.push_back(line);
  return lines;
}

/// The file as it is opened in a child, when a piece is first asked for.
class OpenLater {
 public:
  OpenLater(const Bytes& bytes, const std::string& path, Sizes known)
      : bytes_(&bytes), path_(path), known_(std::move(known)) {}

  hdf5::Reader& reader() {
    if (!reader_) reader_.emplace(hdf5::Reader::from_memory(*bytes_, path_, known_));
    return *reader_;
  }

 private:
  const Bytes* bytes_;
  std::string path_;
  Sizes known_;
  std::optional<hdf5::Reader> reader_;
};

/// A file whose pieces are being read.
class PieceReader {
 public:
  PieceReader(Bytes bytes, const std::string& path, bool vouched, bool keeps_frames)
      : bytes_(std::move(bytes)), path_(path), vouched_(vouched), keeps_frames_(keeps_frames) {}

  RunPieces read() {
    const std::vector<std::string> paths = list();
    read_arrays(paths);
    pieces_.verified = vouched_ || has_hashes_;
    read_frames();
    return std::move(pieces_);
  }

 private:
  using Work = std::function<Bytes(hdf5::Reader&, std::size_t)>;

  void in_children(std::size_t count, const Sizes& known, const Work& work,
                   const std::function<void(std::size_t, Bytes)>& take) const {
    OpenLater file(bytes_, path_, known);
    in_child_processes(path_, bytes_.size(),
                       {count, [&](std::size_t k) { return work(file.reader(), k); }, take});
  }

  /// What comes of each, as far as it can be read.
  std::vector<std::optional<Bytes>> in_children(std::size_t count, const Work& work) const {
    std::vector<std::optional<Bytes>> results(count);
    in_children(count, {}, work, [&](std::size_t k, Bytes bytes) { results[k] = std::move(bytes); });
    return results;
  }

  /// The paths that there should be.
  std::vector<std::string> list() {
    const auto contents = in_children(2, [](hdf5::Reader& reader, std::size_t k) {
      if (k == 1) return Bytes(reader.has("/analysis") ? 1 : 0);
      return encode(reader.has("/contents") ? std::optional(reader.read_stored("/contents")) : std::nullopt);
    });
    pieces_.has_analyses = contents[1] && !contents[1]->empty();
    const auto stored = contents[0] ? decode_array(*contents[0]) : std::nullopt;
    if (stored && is_right("/contents", *stored)) {
      set_array(pieces_, "/contents", {{}, stored->values});
      std::vector<std::string> paths = lines_of(text_of(pieces_, "/contents"));
      std::erase_if(paths, [](const std::string& path) { return !is_known(path); });
      return paths;
    }
    return look_around();
  }

  /// The same of a file without /contents: all that the schema has, and what is found of the run's own names.
  std::vector<std::string> look_around() {
    std::vector<std::string> paths, families;
    for (const DataSetField& field : run_schema()) {
      if (is_by_frame(field) || field.path == "/contents") continue;
      (is_family(field.path) ? families : paths).push_back(field.path);
    }
    const auto names = in_children(families.size(), [&](hdf5::Reader& reader, std::size_t k) {
      return encode(reader.names(families[k].substr(0, families[k].size() - 2)));
    });
    for (std::size_t k = 0; k < families.size(); ++k)
      for (const std::string& name : names[k] ? decode_names(*names[k]) : std::vector<std::string>{}) {
        std::string path = families[k].substr(0, families[k].size() - 1) + name;
        if (std::ranges::find(paths, path) == paths.end() && is_known(path)) paths.push_back(std::move(path));
      }
    return paths;
  }

  bool is_right(const std::string& path, const hdf5::Reader::Stored& stored) {
    if (stored.hash) has_hashes_ = true;
    return stored.hash && *stored.hash == hdf5::piece_hash(path, stored.values);
  }

  void read_arrays(std::vector<std::string> paths) {
    const bool listed = pieces_.arrays.contains("/contents");
    const std::size_t own = paths.size();
    for (const char* of_frames : {"/frames/tilt", "/frames/hash"}) paths.emplace_back(of_frames);
    const auto results = in_children(paths.size(), [&](hdf5::Reader& reader, std::size_t k) {
      return encode(reader.has(paths[k]) ? std::optional(reader.read_stored(paths[k])) : std::nullopt);
    });
    std::vector<std::pair<std::string, hdf5::Reader::Stored>> unproven;
    for (std::size_t k = 0; k < own; ++k) {
      auto stored = results[k] ? decode_array(*results[k]) : std::nullopt;
      if (!stored) {
        if (listed || !results[k]) pieces_.lost.push_back({paths[k], cannot_be_read});
      } else if (is_right(paths[k], *stored)) {
        set_array(pieces_, paths[k], {std::move(stored->dims), std::move(stored->values)});
      } else {
        unproven.emplace_back(paths[k], std::move(*stored));
      }
    }
    if (has_hashes_ && !listed) pieces_.lost.push_back({"/contents", cannot_be_read});
    for (auto& [path, stored] : unproven)
      if (has_hashes_)
        pieces_.lost.push_back({path, not_as_written});
      else
        set_array(pieces_, path, {std::move(stored.dims), std::move(stored.values)});
    tilts_ = of_each_frame<double>(results[own]);
    frame_hashes_ = of_each_frame<std::uint64_t>(results[own + 1]);
  }

  /// The values of a data set that has one for each frame; nothing where they cannot be read.
  template <typename T>
  static std::optional<std::vector<T>> of_each_frame(const std::optional<Bytes>& result) {
    const auto stored = result ? decode_array(*result) : std::nullopt;
    if (!stored) return std::nullopt;
    std::vector<T> values(stored->values.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), stored->values.data(), values.size() * sizeof(T));
    return values;
  }

  /// A frame that agrees with its hash is proven, whatever else is damaged; where hashes were and are lost,
  /// no frame is.
  void read_frames() {
    const char* counting = has_hashes_ ? "/frames/hash" : "/frames/tilt";
    const bool counted = has_hashes_ ? frame_hashes_.has_value() : tilts_.has_value();
    if (!counted && should_have(counting)) pieces_.lost.push_back({counting, cannot_be_read});
    std::vector<double> tilt = tilts_.value_or(std::vector<double>{});
    if (has_hashes_ && counted) tilt.resize(frame_hashes_->size(), std::numeric_limits<double>::quiet_NaN());
    const auto species = pieces_.arrays.find("/particles/grains/species");
    const std::uint64_t grains = species == pieces_.arrays.end() ? 0 : species->second.values.size();
    std::vector<bool> whole(tilt.size());
    in_children(
        counted ? tilt.size() : 0, grains > 0 ? Sizes{{'N', grains}} : Sizes{},
        [](hdf5::Reader& reader, std::size_t k) { return encode(read_stored_frame(reader, k)); },
        [&](std::size_t k, const Bytes& bytes) {
          auto frame = decode_frame(bytes);
          whole[k] = frame && (!has_hashes_ || frame_hash(*frame) == (*frame_hashes_)[k]) &&
                     (grains == 0 || fits(*frame, grains));
          if (whole[k] && keeps_frames_) pieces_.frames.push_back(std::move(*frame));
        });
    for (std::size_t k = 0; k < tilt.size(); ++k)
      if (!whole[k]) pieces_.lost_frames.push_back({k, tilt[k]});
  }

  /// A header and a state have no frames; a file that does not tell is one that has.
  bool should_have(const std::string& path) const {
    const std::string contents = text_of(pieces_, "/contents");
    return contents.empty() ? has_hashes_ : contents.find(path + "\n") != std::string::npos;
  }

  Bytes bytes_;
  const std::string& path_;
  bool vouched_, keeps_frames_;
  bool has_hashes_ = false;
  std::optional<std::vector<double>> tilts_;
  std::optional<std::vector<std::uint64_t>> frame_hashes_;
  RunPieces pieces_;
};

}  // namespace

RunPieces read_pieces(Bytes bytes, const std::string& path, bool vouched, bool keep_frames) {
  return PieceReader(std::move(bytes), path, vouched, keep_frames).read();
}

void set_array(RunPieces& pieces, const std::string& path, StoredArray array) {
  if (!pieces.arrays.contains(path)) pieces.order.push_back(path);
  pieces.arrays.insert_or_assign(path, std::move(array));
}

void drop_array(RunPieces& pieces, const std::string& path) {
  pieces.arrays.erase(path);
  std::erase(pieces.order, path);
}

std::string text_of(const RunPieces& pieces, const std::string& path) {
  const auto found = pieces.arrays.find(path);
  if (found == pieces.arrays.end()) return {};
  const Bytes& values = found->second.values;
  return {reinterpret_cast<const char*>(values.data()), values.size()};
}

std::vector<double> reals_of(const RunPieces& pieces, const std::string& path) {
  const auto found = pieces.arrays.find(path);
  if (found == pieces.arrays.end()) return {};
  std::vector<double> values(found->second.values.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), found->second.values.data(), 8 * values.size());
  return values;
}

}  // namespace talus
