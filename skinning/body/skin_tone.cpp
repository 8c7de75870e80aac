#include "skinning/body/skin_tone.h"

#include <algorithm>
#include <cmath>

namespace throng::skinning {

namespace {

struct Patch {
  double red;
  double green;
  double blue;
};
constexpr Patch kDark = {115, 82, 68};
constexpr Patch kLight = {194, 150, 130};
constexpr double kMargin = 1.08;

double median(const Image& image, std::size_t channel) {
  std::vector<std::uint8_t> values;
  values.reserve(image.rgba.size() / 4);
  for (std::size_t at = channel; at < image.rgba.size(); at += 4) values.push_back(image.rgba[at]);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return std::max<double>(*middle, 1);
}

void scale(Image& image, std::size_t channel, double factor) {
  for (std::size_t at = channel; at < image.rgba.size(); at += 4) {
    image.rgba[at] =
        static_cast<std::uint8_t>(std::min(std::lround(image.rgba[at] * factor), 255L));
  }
}

}  // namespace

void tone_skin(Image& image) {
  if (image.rgba.empty()) return;
  const double red = median(image, 0);
  const double green = median(image, 1);
  const double blue = median(image, 2);
  const double light = std::clamp((red - kDark.red) / (kLight.red - kDark.red), 0.0, 1.0);
  const auto max_ratio = [&](double dark_ratio, double light_ratio) {
    return kMargin * std::lerp(dark_ratio, light_ratio, light);
  };
  const double more_green =
      std::max(1.0, red / green / max_ratio(kDark.red / kDark.green, kLight.red / kLight.green));
  const double more_blue =
      std::max(1.0, more_green * green / blue /
                        max_ratio(kDark.green / kDark.blue, kLight.green / kLight.blue));
  scale(image, 1, more_green);
  scale(image, 2, more_blue);
}

}  // namespace throng::skinning
