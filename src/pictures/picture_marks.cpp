#include "pictures/picture_marks.h"

#include <filesystem>
#include <fmt/core.h>

#include "base/version.h"
#include "core/trigonometry.h"
#include "pictures/texts.h"

namespace talus::pictures {

std::string picture_source(const PictureSeries& series, std::size_t k, std::size_t map) {
  return picture_source(series.path,
                        fmt::format("frame at {} deg, {}", tilt_text(series.seen_frames.instants[k].tilt),
                                    layers_name(series.plan.maps[map].layers)));
}

std::string picture_source(const std::string& run, const std::string& shown) {
  std::string source = fmt::format("{}, {}", std::filesystem::path(run).filename().string(), shown);
  for (char& c : source)  // texts of pictures are ASCII, and those of documents end at these characters
    if (c < ' ' || c > '~' || c == ';' || c == '<' || c == '(' || c == ')' || c == '\\') c = '?';
  return source;
}

std::string tilt_text(double tilt) { return fmt::format("{:.3f}", degrees(tilt)); }

render::PictureTexts picture_texts(const std::string& source) {
  return {{"Software", version_text()}, {"Source", source}};
}

}  // namespace talus::pictures
