#include "render/document.h"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "base/output_file.h"
#include "base/text.h"

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

namespace {

/// Formats a number to 0.01 px, without trailing zeros.
std::string number(double value) {
  std::string text = fmt::format("{:.2f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  if (text == "-0") return "0";
  if (text.starts_with("0.") || text.starts_with("-0.")) text.erase(text.find('0'), 1);
  return text;
}

std::string colour_text(const char* property, const Colour& colour) {
  std::string text =
      fmt::format(" {}=\"#{:02x}{:02x}{:02x}\"", property, colour.red, colour.green, colour.blue);
  if (colour.alpha < 255) text += fmt::format(" {}-opacity=\"{:.3g}\"", property, colour.alpha / 255.0);
  return text;
}

class SvgTarget final : public DocumentTarget {
 public:
  SvgTarget(double page_width, const PictureTexts& texts) : page_width_(page_width), texts_(texts) {}

  void begin(int width, int height, PixelFormat format) override {
    const double mm = 1000.0 * page_width_ / width;
    names_ = 0;
    file_ = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
        "width=\"{:.4f}mm\" height=\"{:.4f}mm\" viewBox=\"0 0 {} {}\">\n<metadata>{}</metadata>\n",
        mm * width, mm * height, width, height, xml_text(joined_texts(texts_)));
    if (format != PixelFormat::transparent)
      file_ += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", width, height);
  }

  void draw_discs(std::span<const Disc> discs, const Window& window) override {
    begin_window(window);
    std::string look;
    for (const Disc& disc : discs) {
      const Point centre = window.camera.project(static_cast<double>(disc.x), static_cast<double>(disc.y));
      const double radius = window.camera.scale * static_cast<double>(disc.radius), rim = rim_width(radius);
      begin_group(look, colour_text("fill", disc.fill) + colour_text("stroke", disc.rim));
      file_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" stroke-width=\"{}\"/>\n", number(centre.x),
                           number(centre.y), number(radius - 0.5 * rim), number(rim));
      if (disc.hatched > 0.5f) draw_hatching(hatching(centre, radius));
    }
    end_window(look);
  }

  void draw_lines(std::span<const Line> lines, const Window& window) override {
    begin_window(window);
    std::string look;
    for (const Line& line : lines) {
      const Point from = window.camera.project(static_cast<double>(line.x0), static_cast<double>(line.y0));
      const Point to = window.camera.project(static_cast<double>(line.x1), static_cast<double>(line.y1));
      const double half = half_line_width(window.camera.scale * static_cast<double>(line.half_width));
      begin_group(look, " stroke-linecap=\"round\"" + colour_text("stroke", line.colour));
      file_ += fmt::format("<path stroke-width=\"{}\" d=\"{}\"/>\n", number(2.0 * half), path(from, to));
    }
    end_window(look);
  }

  void draw_areas(std::span<const Area> areas) override {
    for (const Area& area : areas) {
      std::string fill = colour_text("fill", area.colours.front());
      if (area.colours.size() > 1) fill = fmt::format(" fill=\"url(#{})\"", add_gradient(area.colours));
      file_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"{}/>\n", number(area.box.x),
                           number(area.box.y), number(area.box.width), number(area.box.height), fill);
    }
  }

  void draw_texts(std::span<const PlacedText> texts, double em) override {
    file_ +=
        fmt::format("<g font-family=\"DejaVu Sans, Verdana, sans-serif\" font-size=\"{}\">\n", number(em));
    for (const PlacedText& text : texts) {
      const TextLine line = set_text(measures_, text.text, em);
      const double base_line = base_line_of(text, em);
      file_ += "<text xml:space=\"preserve\">";
      for (const TextRun& run : text_runs(text.text)) {
        const double drop = run.subscript ? std::round(subscript_drop * em) : 0.0;
        file_ += fmt::format("<tspan x=\"{}\" y=\"{}\"", number(text.box.x + line.glyphs[run.first].x),
                             number(base_line + drop));
        if (run.subscript) file_ += fmt::format(" font-size=\"{}\"", number(subscript_size * em));
        file_ += ">" + xml_text(run.text) + "</tspan>";
      }
      file_ += "</text>\n";
    }
    file_ += "</g>\n";
  }

  std::string end() override { return std::move(file_) + "</svg>\n"; }

 private:
  static std::string path(const Point& from, const Point& to) {
    return fmt::format("M{} {}l{} {}", number(from.x), number(from.y), number(to.x - from.x),
                       number(to.y - from.y));
  }

  void begin_window(const Window& window) {
    const int name = ++names_;
    file_ += fmt::format("<clipPath id=\"c{}\"><polygon points=\"", name);
    for (const Point& corner : seen_corners(window)) file_ += number(corner.x) + "," + number(corner.y) + " ";
    file_ += fmt::format("\"/></clipPath>\n<g clip-path=\"url(#c{})\">\n", name);
  }

  /// Begins a group, unless the previous element has the same style.
  void begin_group(std::string& look, const std::string& next) {
    if (look == next) return;
    if (!look.empty()) file_ += "</g>\n";
    file_ += "<g" + next + ">\n";
    look = next;
  }

  void end_window(const std::string& look) { file_ += look.empty() ? "</g>\n" : "</g>\n</g>\n"; }

  void draw_hatching(const Hatching& lines) {
    file_ += fmt::format("<path stroke-width=\"{}\" d=\"", number(lines.width));
    for (const auto& [from, to] : lines.lines) file_ += path(from, to);
    file_ += "\"/>\n";
  }

  std::string add_gradient(const std::vector<Colour>& colours) {
    std::string name = fmt::format("g{}", ++names_);
    file_ += fmt::format("<linearGradient id=\"{}\">\n", name);
    const auto last = static_cast<double>(colours.size() - 1);
    for (std::size_t k = 0; k < colours.size(); ++k)
      file_ += fmt::format("<stop offset=\"{:.4g}\"{}/>\n", static_cast<double>(k) / last,
                           colour_text("stop-color", colours[k]));
    file_ += "</linearGradient>\n";
    return name;
  }

  double page_width_;
  PictureTexts texts_;
  Font measures_ = embedded_font();
  std::string file_;
  int names_ = 0;  ///< number of names assigned
};

}  // namespace

std::unique_ptr<DocumentTarget> make_svg_target(double page_width, const PictureTexts& texts) {
  return std::make_unique<SvgTarget>(page_width, texts);
}

}  // namespace talus::render
