#pragma once
/// Metadata of pictures, which show whether an existing picture is the one that would be drawn.

#include <span>
#include <string>
#include <vector>

#include "base/hash.h"
#include "pictures/picture_series.h"
#include "render/png.h"

namespace talus::pictures {

/// A hash of named values.
class PictureKey {
 public:
  void add(const std::string& name, const std::string& value);
  void add(const std::string& name, double value);
  void add(const std::string& name, const std::vector<double>& values);
  /// Returns 16 hexadecimal digits.
  std::string text() const;

 private:
  Hasher hasher_;
};

/// Returns a hash of everything that determines map `map` of frame k: the run (its scenario, seed, start time
/// and version), the frame, the settings, and the version that draws.
std::string picture_key(const PictureSeries& series, std::size_t k, std::size_t map);

/// Returns a hash of the request of a command for one picture, independent of the contents of the run: the
/// command with its choice of frames, the options of these maps, and the path of the run file relative to the
/// picture. If an existing picture has the same name and request but another key, the run was recomputed or
/// continued, or the version of Talus is different.
std::string picture_request(const std::string& command, const PictureSeries& series,
                            std::span<const MapSettings> maps, const std::string& picture);

/// The metadata that identify a picture.
struct PictureMarks {
  std::string key;      ///< picture_key, or a combination of the keys of several maps
  std::string request;  ///< picture_request
  std::string source;   ///< picture_source
};

/// Returns "v_1.h5, frame at 12.000 deg, gamma+forces": the file of a run and what is shown of it, in ASCII.
std::string picture_source(const PictureSeries& series, std::size_t k, std::size_t map);
std::string picture_source(const std::string& run, const std::string& shown);

/// Returns "12.000"; tilt in rad.
std::string tilt_text(double tilt);

/// Returns the texts of a PNG: its marks, and the program that made it.
render::PictureTexts picture_texts(const PictureMarks& marks);

/// Whether the file is a picture with this key. One with this request and another key is out of date, and is
/// to be replaced. Throws Error(cannot_create) for any other file, unless `overwrite`.
bool is_drawn(const std::string& path, const PictureMarks& marks, bool overwrite);

}  // namespace talus::pictures
