#include "annotate/people/color_name.h"

#include <cmath>

#include "annotate/people/cielab.h"

namespace throng::annotate {

namespace {

/// Reds and what lies beside them, towards orange and towards purple: hue angles below 50 degrees.
std::string_view reddish_name(double lightness, double chroma, double hue_deg) {
  if (hue_deg < 18) return lightness >= 50 ? "pink" : hue_deg < 5 && chroma > 25 ? "purple" : "red";
  if (lightness >= 65) return chroma < 14 ? "beige" : "pink";
  return chroma < 28 ? "brown" : "red";
}

/// Oranges, browns and yellows: hue angles from 50 to 112 degrees.
std::string_view yellowish_name(double lightness, double chroma, double hue_deg) {
  if (hue_deg < 84) {
    if (chroma >= 45 && lightness >= 55) return "orange";
    return lightness >= 68 ? "beige" : "brown";
  }
  if (chroma >= 38 && lightness >= 60) return "yellow";
  if (lightness >= 68) return "beige";
  return chroma < 30 && hue_deg < 100 ? "brown" : "green";
}

}  // namespace

std::string_view color_name(const std::uint8_t* rgb) {
  const Eigen::Vector3f lab = cielab_of_srgb(rgb);
  const double lightness = lab[0];
  const double chroma = std::hypot(lab[1], lab[2]);
  const double full_turn = 360;
  double hue_deg = std::atan2(lab[2], lab[1]) * full_turn / (2 * std::acos(-1.0));
  if (hue_deg < 0) hue_deg += full_turn;
  // The darker a color is, the less of it is seen.
  const double gray_chroma = lightness < 25 ? 12 : 9;
  if (lightness < 10 && chroma < 20) return "black";
  if (chroma < gray_chroma) {
    return lightness < 25 ? "black" : lightness >= 86 ? "white" : "gray";
  }
  if (hue_deg < 50) return reddish_name(lightness, chroma, hue_deg);
  if (hue_deg < 112) return yellowish_name(lightness, chroma, hue_deg);
  if (hue_deg < 205) return "green";
  if (hue_deg < 309) return "blue";
  if (hue_deg < 335) return "purple";
  return lightness >= 50 ? "pink" : "purple";
}

}  // namespace throng::annotate
