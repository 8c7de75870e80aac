// Vector graphics of plans and plots: shapes in pixels, written as SVG, PNG or PDF by cairo and
// Pango.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace throng::drawing {

/// sRGB, 0 to 255, and opacity, 0 to 1.
struct Color {
  std::array<std::uint8_t, 3> rgb{};
  double opacity = 1;
};

inline constexpr Color kTransparent{{0, 0, 0}, 0};

/// Converts a hue in degrees, saturation and lightness (0 to 1) to a color (CSS Color Module,
/// hsl()).
Color from_hsl(double hue_deg, double saturation, double lightness);

/// An element of a drawing. Positions and widths are in pixels, +y down.
struct Shape {
  enum class Kind : std::uint8_t {
    polygon,  ///< closed
    line,     ///< open polyline
    circle,   ///< center at the first point
    text      ///< start of the baseline at the first point
  };
  Kind kind = Kind::polygon;
  std::vector<Eigen::Vector2d> points;
  Color fill = kTransparent;
  Color stroke = kTransparent;
  double width_px = 1;   ///< of the stroke
  double radius_px = 0;  ///< of a circle
  std::string text;      ///< UTF-8
  double font_px = 13;
  bool outlined = false;  ///< text with a white outline, legible on any color
  bool arrow = false;     ///< a line with an arrowhead at its end
};

/// Shapes on a white page; later shapes cover earlier ones.
struct Drawing {
  int width_px = 0;
  int height_px = 0;
  std::string title;  ///< title of the PDF document
  std::vector<Shape> shapes;
};

/// Returns an SVG document. Text is converted to outlines, so that it looks the same without the
/// font.
std::string to_svg(const Drawing& drawing);

/// Returns a PNG file with one pixel per unit.
std::string to_png(const Drawing& drawing);

/// Returns a PDF document of one page with one point per unit; its text is searchable.
std::string to_pdf(const Drawing& drawing);

/// Writes the drawing in the format of the file name's suffix: .svg, .png or .pdf. Throws
/// InputError for other suffixes, EnvironmentError if the file cannot be written.
void write_drawing(const Drawing& drawing, const std::filesystem::path& file);

}  // namespace throng::drawing
