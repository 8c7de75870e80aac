#include "base/graphics/drawing/drawing.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/core.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <regex>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"

namespace throng::drawing {

using Eigen::Vector2d;

namespace {

constexpr double kArrowheadPx = 10;
constexpr double kTextOutlinePx = 3;
constexpr Color kWhite{{255, 255, 255}};

/// Calls a C library's destructor.
template <auto destroy>
struct Destroy {
  void operator()(auto* object) const { destroy(object); }
};

using SurfacePointer = std::unique_ptr<cairo_surface_t, Destroy<cairo_surface_destroy>>;
using ContextPointer = std::unique_ptr<cairo_t, Destroy<cairo_destroy>>;
using LayoutPointer = std::unique_ptr<PangoLayout, Destroy<g_object_unref>>;
using TextPointer = std::unique_ptr<char, Destroy<g_free>>;
using FontPointer = std::unique_ptr<PangoFontDescription, Destroy<pango_font_description_free>>;

/// The three corners of the arrowhead at a line's end.
std::array<Vector2d, 3> arrowhead(const Shape& line) {
  const Vector2d tip = line.points.back();
  const Vector2d along = (tip - line.points[line.points.size() - 2]).normalized();
  const Vector2d across(-along.y(), along.x());
  const double size = kArrowheadPx + line.width_px;
  return {tip, tip - size * along + 0.5 * size * across, tip - size * along - 0.5 * size * across};
}

/// Draws shapes on a surface of any format.
class Painter {
 public:
  explicit Painter(cairo_surface_t* surface)
      : context_(cairo_create(surface)), layout_(pango_cairo_create_layout(context_.get())) {
    set_color(kWhite);
    cairo_paint(context_.get());
    cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  }

  void draw(const Shape& shape) {
    if (shape.points.empty()) return;
    switch (shape.kind) {
      case Shape::Kind::text:
        write(shape);
        break;
      case Shape::Kind::circle:
        cairo_new_path(context_.get());
        cairo_arc(context_.get(), shape.points.front().x(), shape.points.front().y(),
                  shape.radius_px, 0, 2 * std::numbers::pi);
        paint(shape);
        break;
      case Shape::Kind::polygon:
        trace(shape.points);
        cairo_close_path(context_.get());
        paint(shape);
        break;
      case Shape::Kind::line:
        trace(shape.points);
        paint(shape);
        if (!shape.arrow || shape.points.size() < 2) break;
        trace(arrowhead(shape));
        set_color(shape.stroke);
        cairo_fill(context_.get());
        break;
    }
  }

 private:
  void set_color(const Color& color) {
    constexpr double kMax = 255;
    cairo_set_source_rgba(context_.get(), color.rgb[0] / kMax, color.rgb[1] / kMax,
                          color.rgb[2] / kMax, color.opacity);
  }

  void trace(const auto& points) {
    cairo_new_path(context_.get());
    for (const Vector2d& point : points) cairo_line_to(context_.get(), point.x(), point.y());
  }

  void paint(const Shape& shape) {
    if (shape.fill.opacity > 0) {
      set_color(shape.fill);
      cairo_fill_preserve(context_.get());
    }
    if (shape.stroke.opacity > 0) {
      set_color(shape.stroke);
      cairo_set_line_width(context_.get(), shape.width_px);
      cairo_stroke_preserve(context_.get());
    }
    cairo_new_path(context_.get());
  }

  void write(const Shape& shape) {
    const FontPointer font(pango_font_description_from_string("sans-serif"));
    pango_font_description_set_absolute_size(font.get(), shape.font_px * PANGO_SCALE);
    pango_layout_set_font_description(layout_.get(), font.get());
    const TextPointer text(
        g_utf8_make_valid(shape.text.data(), static_cast<gssize>(shape.text.size())));
    pango_layout_set_text(layout_.get(), text.get(), -1);
    const double baseline = pango_units_to_double(pango_layout_get_baseline(layout_.get()));
    const Vector2d at = shape.points.front() - Vector2d(0, baseline);
    cairo_move_to(context_.get(), at.x(), at.y());
    if (shape.outlined) {
      pango_cairo_layout_path(context_.get(), layout_.get());
      set_color(kWhite);
      cairo_set_line_width(context_.get(), kTextOutlinePx);
      cairo_stroke(context_.get());
      cairo_move_to(context_.get(), at.x(), at.y());
    }
    set_color(shape.fill);
    pango_cairo_show_layout(context_.get(), layout_.get());
    cairo_new_path(context_.get());
  }

  ContextPointer context_;
  LayoutPointer layout_;
};

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void draw_all(const Drawing& drawing, cairo_surface_t* surface) {
  Painter painter(surface);
  for (const Shape& shape : drawing.shapes) painter.draw(shape);
}

/// The bytes of a document that a surface writes as it ends.
template <typename Make>
std::string document(const Drawing& drawing, const Make& make) {
  std::string bytes;
  {
    const SurfacePointer surface(make(append, &bytes, drawing.width_px, drawing.height_px));
    draw_all(drawing, surface.get());
    cairo_surface_finish(surface.get());
    check(cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS, "a drawing is written");
  }
  return bytes;
}

}  // namespace

Color from_hsl(double hue_deg, double saturation, double lightness) {
  const double reach = saturation * std::min(lightness, 1 - lightness);
  const auto channel = [&](double offset) {
    constexpr double kSectorDeg = 30;
    constexpr double kSectors = 12;
    constexpr double kMax = 255;
    const double k = std::fmod(offset + hue_deg / kSectorDeg, kSectors);
    const double value = lightness - reach * std::clamp(std::min(k - 3, 9 - k), -1.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(kMax * value));
  };
  return {{channel(0), channel(8), channel(4)}};
}

std::string to_svg(const Drawing& drawing) {
  const std::string svg = document(drawing, [](auto... arguments) {
    cairo_surface_t* surface = cairo_svg_surface_create_for_stream(arguments...);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    return surface;
  });
  // cairo numbers the surfaces of a process; equal drawings have equal bytes.
  static const std::regex kId("id=\"surface[0-9]+\"");
  return std::regex_replace(svg, kId, "id=\"drawing\"");
}

std::string to_pdf(const Drawing& drawing) {
  return document(drawing, [&](auto... arguments) {
    cairo_surface_t* surface = cairo_pdf_surface_create_for_stream(arguments...);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, drawing.title.c_str());
    // Equal drawings have equal bytes.
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "2000-01-01T00:00:00Z");
    return surface;
  });
}

std::string to_png(const Drawing& drawing) {
  const SurfacePointer surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, drawing.width_px, drawing.height_px));
  draw_all(drawing, surface.get());
  std::string bytes;
  check(cairo_surface_write_to_png_stream(surface.get(), append, &bytes) == CAIRO_STATUS_SUCCESS,
        "a drawing is written");
  return bytes;
}

void write_drawing(const Drawing& drawing, const std::filesystem::path& file) {
  using Format = std::string (*)(const Drawing&);
  constexpr std::array<std::pair<std::string_view, Format>, 3> kFormats = {
      {{".svg", to_svg}, {".png", to_png}, {".pdf", to_pdf}}};
  const std::string suffix = file.extension().string();
  for (const auto& [known, format] : kFormats) {
    if (suffix == known) return write_file_atomically(file, format(drawing));
  }
  throw InputError({file.string(), "",
                    suffix.empty() ? "no suffix" : fmt::format("the suffix \"{}\"", suffix),
                    "a file name that ends with .svg, .png or .pdf"});
}

}  // namespace throng::drawing
