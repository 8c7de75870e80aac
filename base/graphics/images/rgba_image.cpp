#include "base/graphics/images/rgba_image.h"

#include <png.h>

#include <memory>

#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/images/jpeg_file.h"
#include "base/graphics/images/png_file.h"

namespace throng::images {

RgbaImage decode_png(std::string_view bytes, const std::string& what) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&header, bytes.data(), bytes.size()) == 0) {
    throw InputError({what, "", header.message, "a PNG image"});
  }
  const std::unique_ptr<png_image, decltype(&png_image_free)> freed_at_end(&header,
                                                                           &png_image_free);
  check_size(what, header.width, header.height);
  header.format = PNG_FORMAT_RGBA;
  RgbaImage image(static_cast<int>(header.width), static_cast<int>(header.height));
  if (png_image_finish_read(&header, nullptr, image.rgba.data(), 0, nullptr) == 0) {
    throw InputError({what, "", header.message, "a complete PNG image"});
  }
  return image;
}

std::string encode_png(const RgbaImage& image) {
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

RgbaImage read_png(const std::filesystem::path& path) {
  return decode_png(read_file(path), path.string());
}

RgbaImage decode_image(std::string_view bytes, const std::string& what) {
  if (is_png(bytes)) return decode_png(bytes, what);
  if (!is_jpeg(bytes)) {
    throw InputError({what, "", "another kind of image", "PNG or JPEG: convert it"});
  }
  const JpegFile jpeg(bytes, what);
  RgbaImage image;
  image.width = jpeg.width();
  image.height = jpeg.height();
  image.rgba = jpeg.decode(TJPF_RGBA, /*strict=*/true);
  return image;
}

RgbaImage read_image(const std::filesystem::path& path) {
  return decode_image(read_file(path), path.string());
}

}  // namespace throng::images
