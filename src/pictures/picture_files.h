#pragma once
/// Maps of a run as files in a folder.

#include <string>
#include <vector>

#include "core/watch.h"
#include "pictures/frame_choice.h"
#include "pictures/picture_marks.h"
#include "render/sheet.h"

namespace talus::pictures {

/// A picture to be drawn.
struct PictureFile {
  std::size_t frame = 0, map = 0;  ///< of the series
  std::string path;
  PictureMarks marks;
};

/// Of map `map` of frame k, as `command` draws it into the folder. Names sort by time.
PictureFile picture_file(const PictureSeries& series, const std::string& command, const std::string& folder,
                         std::size_t k, std::size_t map, int decimals, const std::string& ending = "png");

/// Of all maps of the frames chosen, those that are not in the folder yet; all maps of a frame, then the next
/// frame. Fits the ranges of motion to them. Throws as is_drawn does.
std::vector<PictureFile> files_to_draw(DrawnRun& run, const FrameChoice& choice, const std::string& folder,
                                       const std::string& ending, bool overwrite);

/// Writes a sheet into the file that its name asks for: pixels, with their resolution where the plan is for
/// print, or a document.
void write_sheet(const std::string& path, const render::Sheet& sheet, const MapPlan& plan,
                 const render::PictureTexts& texts);

/// Draws them, and makes the folder where it is missing once there is something to put there. Throws
/// Error(stopped) where it was stopped, with the pictures so far whole.
void draw_files(DrawnRun& run, const std::vector<PictureFile>& files, const std::string& folder,
                const Watch& watch);

}  // namespace talus::pictures
