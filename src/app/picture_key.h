#pragma once
/// What tells whether a picture that exists is the one that would be drawn.

#include <optional>
#include <string>
#include <vector>

#include "core/hash.h"
#include "io/run_store.h"
#include "maps/maps.h"
#include "render/png.h"

namespace talus {

/// A hash of named values: of everything that a picture depends on, and of the version of Talus.
class PictureKey {
 public:
  PictureKey();
  void add(const std::string& name, const std::string& value);
  void add(const std::string& name, double value);
  void add(const std::string& name, const std::vector<double>& values);
  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  Hasher hasher_;
};

/// Which run it is: its scenario, seed, when it began and with which version.
void add_run(PictureKey& key, const RunHeader& header);
void add_settings(PictureKey& key, const MapSettings& settings, int width, const MapExtent& extent);
void add_frame(PictureKey& key, std::int64_t step, double tilt);

/// The texts of a PNG: its key, what made it, and what it shows.
PngTexts picture_texts(const std::string& key, const std::string& source);

/// "v_1.h5, frame at 12.000 deg, gamma+forces": the file of a run and what is shown of it, in ASCII.
std::string picture_source(const std::string& run, double tilt, const MapLayers& layers);
std::string picture_source(const std::string& run, const std::string& shown);

/// "12.000"; tilt in rad.
std::string tilt_text(double tilt);

/// Whether the file is a picture with this key. Throws Error(cannot_create) where it is anything else, unless
/// `overwrite`.
bool is_drawn(const std::string& path, const std::string& key, bool overwrite);

}  // namespace talus
