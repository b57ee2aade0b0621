#pragma once
/// What tells whether a picture that exists is the one that would be drawn.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/map_options.h"
#include "core/hash.h"
#include "io/run_store.h"
#include "maps/maps.h"
#include "render/png.h"

namespace talus {

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

/// Which run it is: its scenario, seed, when it began and with which version; and the version that draws.
void add_run(PictureKey& key, const RunHeader& header);
void add_settings(PictureKey& key, const MapSettings& settings, int width, const MapExtent& extent);
void add_frame(PictureKey& key, std::int64_t step, double tilt);

/// What a picture says of itself in its texts.
struct PictureMarks {
  std::string key;      ///< a hash of everything that it depends on
  std::string request;  ///< a hash of what was asked for: see picture_request
};

/// A hash of what a command asks of a run for one picture, whatever that run holds: the command with what it
/// says of frames, the options of these maps, and where the run file lies, as seen from the picture. Where a
/// picture has the name and the request of the one to be drawn but another key, the run was made again, or
/// has gone on, or Talus is another version.
std::string picture_request(const std::string& command, const std::string& run, const MapPlan& plan,
                            std::span<const MapSettings> maps, const std::string& picture);

/// The texts of a PNG: its marks, what made it, and what it shows.
PngTexts picture_texts(const PictureMarks& marks, const std::string& source);

/// "v_1.h5, frame at 12.000 deg, gamma+forces": the file of a run and what is shown of it, in ASCII.
std::string picture_source(const std::string& run, double tilt, const MapLayers& layers);
std::string picture_source(const std::string& run, const std::string& shown);

/// "12.000"; tilt in rad.
std::string tilt_text(double tilt);

/// Whether the file is a picture with this key. One with this request and another key is out of date, and to
/// be replaced. Throws Error(cannot_create) where it is anything else, unless `overwrite`.
bool is_drawn(const std::string& path, const PictureMarks& marks, bool overwrite);

}  // namespace talus
