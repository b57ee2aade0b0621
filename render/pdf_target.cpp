#include <cairo-ft.h>
#include <cairo-pdf.h>

#include <cmath>
#include <fmt/core.h>
#include <numbers>

#include "base/errors.h"
#include "render/document.h"
#include "render/embedded.h"

namespace talus::render {
namespace {

constexpr double points_per_m = 72.0 / 0.0254;

cairo_status_t append(void* file, const unsigned char* bytes, unsigned length) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), length);
  return CAIRO_STATUS_SUCCESS;
}

/// The embedded font for FreeType. Cairo keeps it as long as it needs it.
struct EmbeddedFace {
  FT_Library library = nullptr;
  FT_Face face = nullptr;

  EmbeddedFace() {
    if (FT_Init_FreeType(&library) != 0 ||
        FT_New_Memory_Face(library, embedded::font.data(), static_cast<FT_Long>(embedded::font.size()), 0,
                           &face) != 0)
      throw Error(ExitCode::internal, "the embedded font cannot be read");
  }
  ~EmbeddedFace() { FT_Done_FreeType(library); }  // also frees the face
  EmbeddedFace(const EmbeddedFace&) = delete;
  EmbeddedFace& operator=(const EmbeddedFace&) = delete;
};

class PdfTarget final : public DocumentTarget {
 public:
  PdfTarget(double page_width, const PictureTexts& texts) : page_width_(page_width), texts_(texts) {
    auto kept = std::make_unique<EmbeddedFace>();
    face_ = kept->face;
    font_ = cairo_ft_font_face_create_for_ft_face(face_, FT_LOAD_NO_HINTING);
    static const cairo_user_data_key_t key{};
    cairo_font_face_set_user_data(font_, &key, kept.release(),
                                  [](void* face) { delete static_cast<EmbeddedFace*>(face); });
  }
  ~PdfTarget() override {
    close();
    cairo_font_face_destroy(font_);
  }
  PdfTarget(const PdfTarget&) = delete;
  PdfTarget& operator=(const PdfTarget&) = delete;

  void begin(int width, int height, PixelFormat format) override {
    close();
    file_.clear();
    const double scale = page_width_ * points_per_m / width;
    surface_ = cairo_pdf_surface_create_for_stream(append, &file_, scale * width, scale * height);
    // Later versions compress the description, which simple programs search.
    cairo_pdf_surface_restrict_to_version(surface_, CAIRO_PDF_VERSION_1_4);
    describe();
    cairo_ = cairo_create(surface_);
    cairo_scale(cairo_, scale, scale);
    cairo_set_font_face(cairo_, font_);
    if (format == PixelFormat::transparent) return;
    cairo_set_source_rgb(cairo_, 1.0, 1.0, 1.0);
    cairo_paint(cairo_);
  }

  void draw_discs(std::span<const Disc> discs, const Window& window) override {
    begin_window(window);
    for (const Disc& disc : discs) draw_disc(disc, window.camera);
    cairo_restore(cairo_);
  }

  void draw_lines(std::span<const Line> lines, const Window& window) override {
    begin_window(window);
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
    for (const Line& line : lines) {
      const double half = window.camera.scale * static_cast<double>(line.half_width);
      set_colour(line.colour);
      cairo_set_line_width(cairo_, 2.0 * half_line_width(half));
      add_line(window.camera.project(static_cast<double>(line.x0), static_cast<double>(line.y0)),
               window.camera.project(static_cast<double>(line.x1), static_cast<double>(line.y1)));
      cairo_stroke(cairo_);
    }
    cairo_restore(cairo_);
  }

  void draw_areas(std::span<const Area> areas) override {
    for (const Area& area : areas) {
      const Box& box = area.box;
      cairo_pattern_t* pattern = cairo_pattern_create_linear(box.x, 0.0, box.right(), 0.0);
      const double last = std::max(1.0, static_cast<double>(area.colours.size() - 1));
      for (std::size_t k = 0; k < area.colours.size(); ++k) {
        const Colour& colour = area.colours[k];
        cairo_pattern_add_color_stop_rgba(pattern, static_cast<double>(k) / last, colour.red / 255.0,
                                          colour.green / 255.0, colour.blue / 255.0, colour.alpha / 255.0);
      }
      if (area.colours.size() == 1)
        set_colour(area.colours.front());
      else
        cairo_set_source(cairo_, pattern);
      cairo_rectangle(cairo_, box.x, box.y, box.width, box.height);
      cairo_fill(cairo_);
      cairo_pattern_destroy(pattern);
    }
  }

  void draw_texts(std::span<const PlacedText> texts, double em) override {
    set_colour(black);
    for (const PlacedText& text : texts) {
      const TextLine line = set_text(measures_, text.text, em);
      for (const TextRun& run : text_runs(text.text)) {
        const double y = base_line_of(text, em) + (run.subscript ? std::round(subscript_drop * em) : 0.0);
        cairo_set_font_size(cairo_, run.subscript ? subscript_size * em : em);
        show(run, line, text.box.x, y);
      }
    }
  }

  std::string end() override {
    cairo_show_page(cairo_);
    cairo_surface_finish(surface_);
    if (const cairo_status_t status = cairo_surface_status(surface_); status != CAIRO_STATUS_SUCCESS)
      throw Error(ExitCode::internal, "cairo reports \"{}\" while drawing", cairo_status_to_string(status));
    close();
    return std::move(file_);
  }

 private:
  void close() {
    if (cairo_) cairo_destroy(cairo_);
    if (surface_) cairo_surface_destroy(surface_);
    cairo_ = nullptr;
    surface_ = nullptr;
  }

  /// Writes the metadata, without the time, so that the same picture gives the same bytes.
  void describe() {
    for (const auto& [keyword, text] : texts_) {
      if (keyword == "Software")
        cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATOR, text.c_str());
      if (keyword == "Source")
        cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_TITLE, text.c_str());
    }
    cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_KEYWORDS, joined_texts(texts_).c_str());
    cairo_pdf_surface_set_metadata(surface_, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
  }

  void begin_window(const Window& window) {
    cairo_save(cairo_);
    for (const Point& corner : seen_corners(window)) cairo_line_to(cairo_, corner.x, corner.y);
    cairo_close_path(cairo_);
    cairo_clip(cairo_);
  }

  void set_colour(const Colour& colour) {
    cairo_set_source_rgba(cairo_, colour.red / 255.0, colour.green / 255.0, colour.blue / 255.0,
                          colour.alpha / 255.0);
  }

  void add_line(const Point& from, const Point& to) {
    cairo_move_to(cairo_, from.x, from.y);
    cairo_line_to(cairo_, to.x, to.y);
  }

  void draw_disc(const Disc& disc, const Camera& camera) {
    const Point centre = camera.project(static_cast<double>(disc.x), static_cast<double>(disc.y));
    const double radius = camera.scale * static_cast<double>(disc.radius), rim = rim_width(radius);
    const auto add_circle = [&](double size) {
      cairo_new_path(cairo_);
      cairo_arc(cairo_, centre.x, centre.y, size, 0.0, 2.0 * std::numbers::pi);
      cairo_close_path(cairo_);
    };
    // The rim is not a stroke, because viewers draw thin strokes too wide.
    add_circle(radius);
    set_colour(disc.rim);
    cairo_fill(cairo_);
    if (disc.fill == disc.rim) return;
    add_circle(radius - rim);
    set_colour(disc.fill);
    cairo_fill(cairo_);
    if (disc.hatched <= 0.5f) return;
    const Hatching lines = hatching(centre, radius);
    set_colour(disc.rim);
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(cairo_, lines.width);
    for (const auto& [from, to] : lines.lines) add_line(from, to);
    cairo_stroke(cairo_);
  }

  /// Draws a run as positioned glyphs, and as text that can be searched and copied.
  void show(const TextRun& run, const TextLine& line, double x, double y) {
    const std::span<const char32_t> codes = font_code_points();
    std::vector<cairo_glyph_t> glyphs;
    std::vector<cairo_text_cluster_t> clusters;
    for (std::size_t k = run.first; k < run.first + run.count; ++k) {
      const char32_t code = codes[line.glyphs[k].code];
      glyphs.push_back({FT_Get_Char_Index(face_, code), x + line.glyphs[k].x, y});
      clusters.push_back({code < 0x80 ? 1 : code < 0x800 ? 2 : 3, 1});
    }
    cairo_show_text_glyphs(cairo_, run.text.data(), static_cast<int>(run.text.size()), glyphs.data(),
                           static_cast<int>(glyphs.size()), clusters.data(),
                           static_cast<int>(clusters.size()), static_cast<cairo_text_cluster_flags_t>(0));
  }

  double page_width_;
  PictureTexts texts_;
  Font measures_ = embedded_font();
  FT_Face face_ = nullptr;
  cairo_font_face_t* font_ = nullptr;
  std::string file_;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* cairo_ = nullptr;
};

}  // namespace

std::unique_ptr<DocumentTarget> make_pdf_target(double page_width, const PictureTexts& texts) {
  return std::make_unique<PdfTarget>(page_width, texts);
}

}  // namespace talus::render
