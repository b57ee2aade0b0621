#pragma once
/// What a picture says of itself, and what tells whether one that exists is the one that would be drawn.

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
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  Hasher hasher_;
};

/// A hash of all that map `map` of frame k depends on: the run (its scenario, seed, when it began and with
/// which version), the frame, the settings, and the version that draws.
std::string picture_key(const PictureSeries& series, std::size_t k, std::size_t map);

/// A hash of what a command asks of a run for one picture, whatever that run holds: the command with what it
/// says of frames, the options of these maps, and where the run file lies, as seen from the picture. Where a
/// picture has the name and the request of the one to be drawn but another key, the run was made again, or
/// has gone on, or Talus is another version.
std::string picture_request(const std::string& command, const PictureSeries& series,
                            std::span<const MapSettings> maps, const std::string& picture);

/// What a picture says of itself in its texts.
struct PictureMarks {
  std::string key;      ///< picture_key, or what a picture of several maps makes of theirs
  std::string request;  ///< picture_request
  std::string source;   ///< picture_source
};

/// "v_1.h5, frame at 12.000 deg, gamma+forces": the file of a run and what is shown of it, in ASCII.
std::string picture_source(const PictureSeries& series, std::size_t k, std::size_t map);
std::string picture_source(const std::string& run, const std::string& shown);

/// "12.000"; tilt in rad.
std::string tilt_text(double tilt);

/// The texts of a PNG: its marks, and what made it.
render::PictureTexts picture_texts(const PictureMarks& marks);

/// Whether the file is a picture with this key. One with this request and another key is out of date, and to
/// be replaced. Throws Error(cannot_create) where it is anything else, unless `overwrite`.
bool is_drawn(const std::string& path, const PictureMarks& marks, bool overwrite);

}  // namespace talus::pictures
