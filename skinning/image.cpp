#include "skinning/image.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/compute/srgb.h"

namespace throng::skinning {

Image resized(const Image& image, int size) {
  if (image.width == size && image.height == size) return image;
  Image small(size, size);
  for (int y = 0; y < size; ++y) {
    const int top = y * image.height / size;
    const int bottom = std::max(top + 1, (y + 1) * image.height / size);
    for (int x = 0; x < size; ++x) {
      const int left = x * image.width / size;
      const int right = std::max(left + 1, (x + 1) * image.width / size);
      std::array<float, 3> color{};
      float weight_sum = 0;
      float alpha_sum = 0;
      for (int from_y = top; from_y < bottom; ++from_y) {
        for (int from_x = left; from_x < right; ++from_x) {
          const std::uint8_t* from = image.pixel(from_x, from_y);
          const float weight = static_cast<float>(from[3]) + 1e-3F;
          for (int channel = 0; channel < 3; ++channel) {
            color[channel] += weight * linear_from_srgb(from[channel]);
          }
          weight_sum += weight;
          alpha_sum += from[3];
        }
      }
      std::uint8_t* to = small.pixel(x, y);
      for (int channel = 0; channel < 3; ++channel) {
        to[channel] = srgb_from_linear(color[channel] / weight_sum);
      }
      const auto count = static_cast<float>((bottom - top) * (right - left));
      to[3] = static_cast<std::uint8_t>(std::lround(alpha_sum / count));
    }
  }
  return small;
}

void fill_from_nearest(Image& image, Mask covered, int channels) {
  std::vector<int> front;
  for (int at = 0; at < static_cast<int>(covered.size()); ++at) {
    if (covered[at] != 0) front.push_back(at);
  }
  constexpr std::array<std::array<int, 2>, 4> kNeighbors = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  std::vector<int> next;
  while (!front.empty()) {
    next.clear();
    for (const int at : front) {
      const int x = at % image.width;
      const int y = at / image.width;
      const std::uint8_t* from = image.pixel(x, y);
      for (const auto [dx, dy] : kNeighbors) {
        const int to_x = x + dx;
        const int to_y = y + dy;
        if (to_x < 0 || to_y < 0 || to_x >= image.width || to_y >= image.height) continue;
        const int to = to_y * image.width + to_x;
        if (covered[to] != 0) continue;
        covered[to] = 1;
        std::copy_n(from, channels, image.pixel(to_x, to_y));
        next.push_back(to);
      }
    }
    front.swap(next);
  }
}

}  // namespace throng::skinning
