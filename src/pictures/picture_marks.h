#pragma once
/// Metadata of pictures: what they show, and the program that made them.

#include <string>

#include "pictures/picture_series.h"
#include "render/png.h"

namespace talus::pictures {

/// Returns "v_1.h5, frame at 12.000 deg, gamma+forces": the file of a run and what is shown of it, in ASCII.
std::string picture_source(const PictureSeries& series, std::size_t k, std::size_t map);
std::string picture_source(const std::string& run, const std::string& shown);

/// Returns "12.000"; tilt in rad.
std::string tilt_text(double tilt);

/// Returns the texts of a picture of this source.
render::PictureTexts picture_texts(const std::string& source);

}  // namespace talus::pictures
