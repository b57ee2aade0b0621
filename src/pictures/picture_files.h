#pragma once
/// Maps of a run as files in a folder.

#include <string>
#include <vector>

#include "core/types.h"
#include "pictures/frame_choice.h"
#include "pictures/picture_series.h"
#include "render/png.h"
#include "render/sheet.h"

namespace talus::pictures {

/// A picture to be drawn.
struct PictureFile {
  std::size_t frame = 0, map = 0;  ///< indices in the series
  std::string path;
  std::string source;  ///< picture_source
};

/// Returns the picture of map `map` of frame k in the folder. Names sort by time.
PictureFile picture_file(const PictureSeries& series, const std::string& folder, std::size_t k,
                         std::size_t map, int decimals, const std::string& ending = "png");

/// Returns the pictures of all maps, frame by frame. Fits the ranges of motion to these frames.
std::vector<PictureFile> picture_files(DrawnRun& run, const FrameChoice& choice, const std::string& folder,
                                       const std::string& ending);

/// Returns a picture as a sheet of the size of the plan. Throws the errors of sheet_of and arrange.
render::Sheet sheet_of_plan(render::FrameView view, const MapPlan& plan, const render::Font& font);

/// Writes a sheet to a file in the format of its name: pixels, with a resolution for print, or a document.
void write_sheet(const std::string& path, const render::Sheet& sheet, const MapPlan& plan,
                 const render::PictureTexts& texts);

/// Draws the pictures, and creates a missing folder before the first is written. Throws Error(stopped) if it
/// was stopped; the pictures so far are complete.
void draw_files(DrawnRun& run, const std::vector<PictureFile>& files, const std::string& folder,
                const Watch& watch);

// Metadata of pictures: what they show, and the program that made them.

/// Returns "v_1.h5, frame at 12.000 deg, gamma+forces": the file of a run and what is shown of it, in ASCII.
std::string picture_source(const PictureSeries& series, std::size_t k, std::size_t map);
std::string picture_source(const std::string& run, const std::string& shown);

/// Returns "12.000"; tilt in rad.
std::string tilt_text(double tilt);

/// Returns the texts of a picture of this source.
render::PictureTexts picture_texts(const std::string& source);

}  // namespace talus::pictures
