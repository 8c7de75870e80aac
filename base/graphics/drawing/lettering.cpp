#include "base/graphics/drawing/lettering.h"

#include <pango/pangocairo.h>

#include <algorithm>
#include <memory>
#include <string>

namespace throng::drawing {

namespace {

/// Calls a C library's destructor.
template <auto destroy>
struct Release {
  void operator()(auto* object) const { destroy(object); }
};

}  // namespace

std::vector<std::uint8_t> draw_word(std::string_view word, int width, int height) {
  constexpr double kMarginPx = 2;
  constexpr double kDrawnPx = 100;  // any: the path is scaled
  const std::unique_ptr<cairo_surface_t, Release<cairo_surface_destroy>> surface(
      cairo_image_surface_create(CAIRO_FORMAT_A8, width, height));
  const std::unique_ptr<cairo_t, Release<cairo_destroy>> context(cairo_create(surface.get()));
  const std::unique_ptr<PangoLayout, Release<g_object_unref>> layout(
      pango_cairo_create_layout(context.get()));
  const std::unique_ptr<PangoFontDescription, Release<pango_font_description_free>> font(
      pango_font_description_from_string("Bebas Neue Bold"));
  pango_font_description_set_absolute_size(font.get(), kDrawnPx * PANGO_SCALE);
  pango_layout_set_font_description(layout.get(), font.get());
  pango_layout_set_text(layout.get(), word.data(), static_cast<int>(word.size()));
  PangoRectangle ink;
  pango_layout_get_pixel_extents(layout.get(), &ink, nullptr);
  const double scale = std::min((width - 2 * kMarginPx) / std::max(1, ink.width),
                                (height - 2 * kMarginPx) / std::max(1, ink.height));
  cairo_translate(context.get(), 0.5 * width, 0.5 * height);
  cairo_scale(context.get(), scale, scale);
  cairo_translate(context.get(), -ink.x - 0.5 * ink.width, -ink.y - 0.5 * ink.height);
  pango_cairo_layout_path(context.get(), layout.get());
  cairo_fill(context.get());
  cairo_surface_flush(surface.get());
  const unsigned char* const pixels = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  std::vector<std::uint8_t> image;
  for (int y = 0; y < height; ++y) {
    const unsigned char* const row = pixels + static_cast<std::ptrdiff_t>(y) * stride;
    image.insert(image.end(), row, row + width);
  }
  return image;
}

}  // namespace throng::drawing
