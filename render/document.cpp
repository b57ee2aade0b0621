#include "render/document.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/output_file.h"

namespace talus::render {

double rim_width(double radius) { return std::min(0.18 * radius, 2.0); }

double half_line_width(double half_width) { return std::max(half_width, 0.35); }

Hatching hatching(const Point& centre, double radius) {
  const double inner = radius - rim_width(radius);
  const double period = std::max(0.8 * radius, 3.0);
  const double across = (centre.x + centre.y) / std::numbers::sqrt2;
  Hatching hatching;
  hatching.width = 0.3 * period;
  for (double k = std::ceil((across - inner) / period - 0.5); (k + 0.5) * period < across + inner; k += 1.0) {
    const double off = (k + 0.5) * period - across;  // distance of the line from the centre
    const double half = std::sqrt(std::max(0.0, inner * inner - off * off)) / std::numbers::sqrt2;
    const Point middle{centre.x + off / std::numbers::sqrt2, centre.y + off / std::numbers::sqrt2};
    hatching.lines.push_back({{middle.x - half, middle.y + half}, {middle.x + half, middle.y - half}});
  }
  return hatching;
}

std::vector<Point> seen_corners(const Window& window) {
  if (window.camera.sine == 0.0) {
    const Box& box = window.box;
    return {{box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
  }
  const Camera& camera = window.camera;
  return {camera.project(window.x_min, window.y_min), camera.project(window.x_max, window.y_min),
          camera.project(window.x_max, window.y_max), camera.project(window.x_min, window.y_max)};
}

std::string joined_texts(const PictureTexts& texts) {
  std::string joined;
  for (const auto& [keyword, text] : texts)
    joined.append(joined.empty() ? "" : "; ").append(keyword).append("=").append(text);
  for (char& c : joined)  // cairo would encode these differently, hidden from searches
    if (c == '(' || c == ')' || c == '\\') c = c == '(' ? '[' : c == ')' ? ']' : '/';
  return joined;
}

bool is_document(const std::string& path) { return path.ends_with(".pdf") || path.ends_with(".svg"); }

void write_document(const std::string& path, const Sheet& sheet, double page_width,
                    const PictureTexts& texts) {
  const std::unique_ptr<DocumentTarget> target =
      path.ends_with(".pdf") ? make_pdf_target(page_width, texts) : make_svg_target(page_width, texts);
  paint(*target, sheet);
  const std::string bytes = target->end();
  OutputFile file(path);
  file.write(std::as_bytes(std::span(bytes)));
  file.commit();
}

}  // namespace talus::render
