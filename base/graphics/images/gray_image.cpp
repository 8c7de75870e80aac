#include "base/graphics/images/gray_image.h"

#include <fmt/core.h>
#include <libexif/exif-data.h>

#include <csetjmp>
#include <memory>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/images/jpeg_file.h"
#include "base/graphics/images/png_file.h"

namespace throng::images {

namespace {

[[noreturn]] void refuse(const std::string& what, std::string found) {
  throw InputError(Problem{what, "", std::move(found), "a JPEG or PNG image"});
}

// Orientation of TIFF and EXIF, 1 to 8; 1 if the file does not say.
int exif_orientation(std::string_view jpeg) {
  const std::unique_ptr<ExifData, decltype(&exif_data_unref)> data(
      exif_data_new_from_data(reinterpret_cast<const unsigned char*>(jpeg.data()),
                              static_cast<unsigned int>(jpeg.size())),
      &exif_data_unref);
  if (!data) return 1;
  const ExifEntry* entry = exif_content_get_entry(data->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
  if (entry == nullptr || entry->format != EXIF_FORMAT_SHORT || entry->size < 2) return 1;
  const int value = exif_get_short(entry->data, exif_data_get_byte_order(data.get()));
  return value >= 1 && value <= 8 ? value : 1;
}

// The image as a viewer shows it: `orientation` says where the stored first row and column belong.
GrayImage upright(GrayImage stored, int orientation) {
  if (orientation == 1) return stored;
  const bool is_turned = orientation >= 5;
  GrayImage image{is_turned ? stored.height : stored.width,
                  is_turned ? stored.width : stored.height,
                  std::vector<std::uint8_t>(stored.pixels.size())};
  const bool from_right =
      orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_bottom =
      orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int column = is_turned ? y : x;
      const int row = is_turned ? x : y;
      const int from_x = from_right ? stored.width - 1 - column : column;
      const int from_y = from_bottom ? stored.height - 1 - row : row;
      image.pixels[static_cast<std::size_t>(y) * image.width + x] =
          stored.pixels[static_cast<std::size_t>(from_y) * stored.width + from_x];
    }
  }
  return image;
}

GrayImage gray_of_jpeg(std::string_view bytes, const std::string& what) {
  const JpegFile jpeg(bytes, what);
  return upright({jpeg.width(), jpeg.height(), jpeg.decode(TJPF_GRAY, /*strict=*/false)},
                 exif_orientation(bytes));
}

// libpng makes 8 bits of gray from whatever the file holds, with Rec. 601's weights.
void ask_for_gray(png_structp png, png_infop info) {
  constexpr int kDiscardedSilently = 1;
  const int color_type = png_get_color_type(png, info);
  png_set_strip_16(png);
  png_set_strip_alpha(png);
  if (color_type == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
  if (color_type == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png, info) < 8) {
    png_set_expand_gray_1_2_4_to_8(png);
  }
  if ((color_type & PNG_COLOR_MASK_COLOR) != 0) {
    png_set_rgb_to_gray(png, kDiscardedSilently, 0.299, 0.587);
  }
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
}

// Nothing with a destructor may be made between setjmp and longjmp.
bool read_rows(png_structp png, png_infop info, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: how libpng fails
  ask_for_gray(png, info);
  png_read_image(png, rows);
  return true;
}

GrayImage gray_of_png(std::string_view bytes, const std::string& what) {
  PngFile file(bytes);
  const PngSize size = read_png_header(file, what);
  GrayImage image{static_cast<int>(size.width), static_cast<int>(size.height), {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  std::vector<png_bytep> rows(static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) {
    rows[y] = image.pixels.data() + static_cast<std::size_t>(y) * image.width;
  }
  if (!read_rows(file.png, file.info, rows.data())) {
    refuse(what, "a damaged PNG: " + file.source.message);
  }
  return image;
}

[[noreturn]] void refuse_kind(std::string_view bytes, const std::string& what) {
  refuse(what, fmt::format("{} bytes of another kind", bytes.size()));
}

}  // namespace

GrayImage decode_gray_image(std::string_view bytes, const std::string& what) {
  if (is_jpeg(bytes)) return gray_of_jpeg(bytes, what);
  if (is_png(bytes)) return gray_of_png(bytes, what);
  refuse_kind(bytes, what);
}

std::int64_t pixels_of_image(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  if (is_jpeg(bytes)) {
    const JpegFile jpeg(bytes, file.string());
    return static_cast<std::int64_t>(jpeg.width()) * jpeg.height();
  }
  if (!is_png(bytes)) refuse_kind(bytes, file.string());
  PngFile png(bytes);
  const PngSize size = read_png_header(png, file.string());
  return static_cast<std::int64_t>(size.width) * size.height;
}

GrayImage read_gray_image(const std::filesystem::path& file) {
  return decode_gray_image(read_file(file), file.string());
}

}  // namespace throng::images
