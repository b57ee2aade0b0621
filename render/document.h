#pragma once
/// Pictures as documents of vectors: PDF and SVG.

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/sheet.h"
#include "render/target.h"

namespace talus::render {

/// A target of vectors: discs, lines and texts stay what they are.
class DocumentTarget : public Target {
 public:
  /// The file. Throws Error(internal) if drawing failed.
  virtual std::string end() = 0;
};

/// One page, `page_width` m wide. The same picture gives the same bytes.
std::unique_ptr<DocumentTarget> make_pdf_target(double page_width, const PictureTexts& texts);
std::unique_ptr<DocumentTarget> make_svg_target(double page_width, const PictureTexts& texts);

// How both draw what shaders compute for each pixel, px.

/// The width of the rim of a disc.
double rim_width(double radius);
/// Half the width of a line, which is never too thin to be seen.
double half_line_width(double half_width);

/// The lines over a hatched disc: their ends, and their width.
struct Hatching {
  std::vector<std::pair<Point, Point>> lines;
  double width = 0.0;
};
Hatching hatching(const Point& centre, double radius);

/// The corners of what is seen through a window.
std::vector<Point> seen_corners(const Window& window);

/// Texts as the one line that a document keeps: "talus:key=0123; talus:request=4567".
std::string joined_texts(const PictureTexts& texts);

/// Whether a path ends as that of a document: in .pdf or .svg.
bool is_document(const std::string& path);

/// Writes a sheet as the document that the path names, `page_width` m wide; an existing file is replaced once
/// the new one is whole. Throws Error(cannot_create) or Error(io_error), and leaves no partial file.
void write_document(const std::string& path, const Sheet& sheet, double page_width,
                    const PictureTexts& texts);

/// The text of a keyword in a document; none as for png_text.
std::optional<std::string> document_text(const std::string& path, const std::string& keyword);

}  // namespace talus::render
