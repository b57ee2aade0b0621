#pragma once
/// Pictures as vector documents: PDF and SVG.

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/sheet.h"
#include "render/target.h"

namespace talus::render {

/// A vector target: discs, lines and texts are kept as such.
class DocumentTarget : public Target {
 public:
  /// Returns the bytes of the file. Throws Error(internal) if drawing failed.
  virtual std::string end() = 0;
};

/// Make a target with one page, `page_width` m wide. The same picture gives the same bytes.
std::unique_ptr<DocumentTarget> make_pdf_target(double page_width, const PictureTexts& texts);
std::unique_ptr<DocumentTarget> make_svg_target(double page_width, const PictureTexts& texts);

// The shapes that shaders compute for each pixel, as both documents draw them; lengths in px.

/// Returns the width of the rim of a disc.
double rim_width(double radius);
/// Returns half the width of a line, at least as much as is visible.
double half_line_width(double half_width);

/// The lines over a hatched disc: their end points and their width.
struct Hatching {
  std::vector<std::pair<Point, Point>> lines;
  double width = 0.0;
};
Hatching hatching(const Point& centre, double radius);

/// Joins texts into the one line that a document stores: "Software=talus 0.1.0; Source=a.h5".
std::string joined_texts(const PictureTexts& texts);

/// Whether a path ends in .pdf or .svg.
bool is_document(const std::string& path);

/// Writes a sheet as a document of the type that the path names, `page_width` m wide. An existing file is
/// replaced once the new one is complete. Throws Error(cannot_create) or Error(io_error), and leaves no
/// partial file.
void write_document(const std::string& path, const Sheet& sheet, double page_width,
                    const PictureTexts& texts);

}  // namespace talus::render
