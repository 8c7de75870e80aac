#include "skinning/image.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <type_traits>

#include "base/error.h"
#include "base/files.h"
#include "base/srgb.h"

namespace throng::skinning {

Image decode_png(std::string_view bytes, const std::string& what) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) {
    throw InputError({what, "", header.message, "a PNG image"});
  }
  header.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(header.width), static_cast<int>(header.height));
  if (png_image_finish_read(&header, nullptr, image.rgba.data(), 0, nullptr) == 0) {
    throw InputError({what, "", header.message, "a complete PNG image"});
  }
  return image;
}

std::string encode_png(const Image& image) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGBA;
  header.flags = PNG_IMAGE_FLAG_FAST;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(header), '\0');
  png_alloc_size_t size = bytes.size();
  const int written =
      png_image_write_to_memory(&header, bytes.data(), &size, 0, image.rgba.data(), 0, nullptr);
  check(written != 0, "an RGBA image can be written as PNG");
  bytes.resize(size);
  return bytes;
}

Image read_png(const std::filesystem::path& path) {
  return decode_png(read_file(path), path.string());
}

Image decode_image(std::string_view bytes, const std::string& what) {
  const bool jpeg = bytes.substr(0, 3) == "\xFF\xD8\xFF";
  if (!jpeg) {
    if (bytes.substr(1, 3) == "PNG") return decode_png(bytes, what);
    throw InputError({what, "", "another kind of image", "PNG or JPEG: convert it"});
  }
  using Handle = std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)>;
  const Handle handle(tjInitDecompress(), &tjDestroy);
  if (!handle) throw EnvironmentError("cannot start the JPEG decompressor: out of memory");
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0;
  int height = 0;
  int sampling = 0;
  int colors = 0;
  if (tjDecompressHeader3(handle.get(), data, bytes.size(), &width, &height, &sampling, &colors) !=
      0) {
    throw InputError({what, "", tjGetErrorStr2(handle.get()), "a JPEG image"});
  }
  Image image(width, height);
  if (tjDecompress2(handle.get(), data, bytes.size(), image.rgba.data(), width, 0, height,
                    TJPF_RGBA, TJFLAG_ACCURATEDCT) != 0) {
    throw InputError({what, "", tjGetErrorStr2(handle.get()), "a complete JPEG image"});
  }
  return image;
}

Image read_image(const std::filesystem::path& path) {
  return decode_image(read_file(path), path.string());
}

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
            color[channel] += weight * linear_of_srgb(from[channel]);
          }
          weight_sum += weight;
          alpha_sum += from[3];
        }
      }
      std::uint8_t* to = small.pixel(x, y);
      for (int channel = 0; channel < 3; ++channel) {
        to[channel] = srgb_of_linear(color[channel] / weight_sum);
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
