#include "render/ground/ground_tone.h"

#include <array>
#include <cstdint>

#include "base/compute/random.h"

namespace throng::render {

float ground_tone_at(const Eigen::Vector2d& point) {
  constexpr std::array<std::array<double, 2>, 3> kOctaves = {{{23, 0.19}, {9, 0.14}, {4, 0.10}}};
  const auto corner = [](double x, double y, std::uint64_t octave) {
    constexpr double kOffset = 1 << 24;  // indices are not negative
    const auto column = static_cast<std::uint64_t>(x + kOffset);
    const auto row = static_cast<std::uint64_t>(y + kOffset);
    return Random(octave, Stream::environment, column << 32U | row).uniform(-1, 1);
  };
  double tone = 1;
  for (std::uint64_t octave = 0; octave < kOctaves.size(); ++octave) {
    const auto [size_m, strength] = kOctaves[octave];
    const Eigen::Array2d at = point.array() / size_m;
    const Eigen::Array2d cell = at.floor();
    const Eigen::Array2d t = at - cell;
    const Eigen::Array2d f = t * t * (3 - 2 * t);
    const auto row = [&](double y) {
      return (1 - f.x()) * corner(cell.x(), y, octave) + f.x() * corner(cell.x() + 1, y, octave);
    };
    tone += strength * ((1 - f.y()) * row(cell.y()) + f.y() * row(cell.y() + 1));
  }
  return static_cast<float>(tone);
}

}  // namespace throng::render
