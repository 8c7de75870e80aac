#include "render/people/corner_colors.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace throng::render {

namespace {

using Colors = std::vector<Eigen::Array4f>;

/// How closely colors are sought.
struct Effort {
  int cuts;    ///< of a triangle's sides: so many looks at the image, squared
  int rounds;  ///< The first gives each corner the mean around it.
};

/// The error's slowest part falls by a quarter in each round: the matrix of linear elements,
/// divided by its row sums, has eigenvalues from 1/4 to 1 (Wathen 1987, table 1). Many triangles
/// are small triangles, whose means are nearly right.
Effort effort_for(std::size_t triangles) {
  constexpr std::size_t kMany = 1000;
  return triangles > kMany ? Effort{1, 3} : Effort{3, 8};
}

/// A look at the image: the shares that the triangle's corners have in it.
struct Look {
  Eigen::Array3f shares;
};

/// The middles of the triangles that equal cuts of the sides make.
std::vector<Look> looks(int cuts) {
  std::vector<Look> looks;
  for (int i = 0; i < cuts; ++i) {
    for (int j = 0; i + j < cuts; ++j) {
      const auto add = [&](float third) {
        const float a = (static_cast<float>(i) + third) / static_cast<float>(cuts);
        const float b = (static_cast<float>(j) + third) / static_cast<float>(cuts);
        looks.push_back({{a, b, 1 - a - b}});
      };
      add(1.0F / 3);
      if (i + j + 1 < cuts) add(2.0F / 3);
    }
  }
  return looks;
}

Eigen::Array4f texel_at(const skinning::Texture& image, int size, const Eigen::Array2f& uv) {
  const Eigen::Array2i at =
      (uv * static_cast<float>(size)).floor().cast<int>().max(0).min(size - 1);
  const auto first = 4 * (static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(size) +
                          static_cast<std::size_t>(at.x()));
  Eigen::Array4f texel;
  for (int c = 0; c < 4; ++c) texel[c] = image.rgba[first + static_cast<std::size_t>(c)];
  return texel;
}

Eigen::Array2f mixed(const TexturedTriangle& triangle, const Eigen::Array3f& shares) {
  Eigen::Array2f uv = Eigen::Array2f::Zero();
  for (std::size_t k = 0; k < 3; ++k) {
    uv +=
        shares[static_cast<Eigen::Index>(k)] * Eigen::Array2f(triangle.uv[k][0], triangle.uv[k][1]);
  }
  return uv;
}

}  // namespace

std::vector<Rgba> corner_colors(const skinning::Texture& image, int size,
                                std::span<const TexturedTriangle> triangles, std::size_t count) {
  const Effort effort = effort_for(triangles.size());
  const std::vector<Look> all_looks = looks(effort.cuts);
  Colors seen;
  seen.reserve(triangles.size() * all_looks.size());
  std::vector<float> weights(count, 0);
  for (const TexturedTriangle& triangle : triangles) {
    for (const std::uint32_t corner : triangle.corners) {
      check(corner < count, "a triangle's corners have colors");
      weights[corner] += triangle.weight / 3;
    }
    for (const Look& look : all_looks) {
      seen.push_back(texel_at(image, size, mixed(triangle, look.shares)));
    }
  }
  Colors colors(count, Eigen::Array4f::Zero());
  const float share = 1 / static_cast<float>(all_looks.size());
  for (int round = 0; round < effort.rounds; ++round) {
    Colors change(count, Eigen::Array4f::Zero());
    auto wanted = seen.begin();
    for (const TexturedTriangle& triangle : triangles) {
      const auto& [a, b, c] = triangle.corners;
      for (const Look& look : all_looks) {
        const Eigen::Array3f& s = look.shares;
        const Eigen::Array4f off =
            *wanted++ - (s[0] * colors[a] + s[1] * colors[b] + s[2] * colors[c]);
        change[a] += (triangle.weight * share * s[0]) * off;
        change[b] += (triangle.weight * share * s[1]) * off;
        change[c] += (triangle.weight * share * s[2]) * off;
      }
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (weights[i] > 0) colors[i] += change[i] / weights[i];
    }
  }
  std::vector<Rgba> bytes(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      bytes[i][c] = static_cast<std::uint8_t>(
          std::lround(std::clamp(colors[i][static_cast<Eigen::Index>(c)], 0.0F, 255.0F)));
    }
  }
  return bytes;
}

}  // namespace throng::render
