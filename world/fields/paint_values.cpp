#include "world/fields/paint_values.h"

#include <fmt/core.h>

#include "base/compute/srgb.h"

namespace throng::world {

fields::Values paints() {
  return fields::raw({{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}},
                     "a color such as \"#a05030\"");
}

Paint paint_from_hex(const std::string& text) {
  Paint paint;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto byte = std::stoi(text.substr(1 + 2 * i, 2), nullptr, 16);
    paint[static_cast<Eigen::Index>(i)] = linear_from_srgb(static_cast<std::uint8_t>(byte));
  }
  return paint;
}

std::string hex_from_paint(const Paint& paint) {
  return fmt::format("#{:02x}{:02x}{:02x}", srgb_from_linear(paint[0]), srgb_from_linear(paint[1]),
                     srgb_from_linear(paint[2]));
}

}  // namespace throng::world
