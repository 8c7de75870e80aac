#include "images/gray_image.h"

#include <fmt/core.h>
#include <libexif/exif-data.h>
#include <png.h>
#include <turbojpeg.h>

#include <csetjmp>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

#include "base/error.h"
#include "base/files.h"

namespace throng::images {

namespace {

// The largest image that is read, in pixels: what a small file may unpack to is limited.
// Backs of medium format have 151 million.
constexpr std::int64_t kMaxPixels = 160'000'000;

[[noreturn]] void refuse(const std::string& what, std::string found) {
  throw InputError(Problem{what, "", std::move(found), "a JPEG or PNG image"});
}

void check_size(const std::string& what, std::int64_t width, std::int64_t height) {
  if (width * height <= kMaxPixels) return;
  throw InputError(Problem{what, "", fmt::format("{} x {} pixels", width, height),
                           fmt::format("at most {} pixels", kMaxPixels)});
}

// Orientation of TIFF and EXIF, 1 to 8; 1 if the file does not say.
int orientation_of(std::string_view jpeg) {
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

using JpegHandle = std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)>;

const unsigned char* data_of(std::string_view bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

JpegHandle new_decompressor() {
  JpegHandle handle(tjInitDecompress(), &tjDestroy);
  if (!handle) throw EnvironmentError("cannot start the JPEG decompressor: out of memory");
  return handle;
}

// Sets the size of the image.
void read_jpeg_header(tjhandle handle, std::string_view bytes, const std::string& what,
                      GrayImage& image) {
  int sampling = 0;
  int colors = 0;
  if (tjDecompressHeader3(handle, data_of(bytes), bytes.size(), &image.width, &image.height,
                          &sampling, &colors) != 0) {
    refuse(what, fmt::format("a damaged JPEG: {}", tjGetErrorStr2(handle)));
  }
  check_size(what, image.width, image.height);
}

GrayImage decode_jpeg(std::string_view bytes, const std::string& what) {
  const JpegHandle handle = new_decompressor();
  const unsigned char* data = data_of(bytes);
  GrayImage image;
  read_jpeg_header(handle.get(), bytes, what, image);
  image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
  if (tjDecompress2(handle.get(), data, bytes.size(), image.pixels.data(), image.width, 0,
                    image.height, TJPF_GRAY, TJFLAG_ACCURATEDCT) != 0 &&
      tjGetErrorCode(handle.get()) != TJERR_WARNING) {
    refuse(what, fmt::format("a damaged JPEG: {}", tjGetErrorStr2(handle.get())));
  }
  return upright(std::move(image), orientation_of(bytes));
}

// The bytes that libpng reads from, and what it says when it fails.
struct PngSource {
  std::string_view bytes;
  std::string message;
};

void take_bytes(png_structp png, png_bytep to, png_size_t count) {
  auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
  if (count > source->bytes.size()) png_error(png, "cut off");
  std::memcpy(to, source->bytes.data(), count);
  source->bytes.remove_prefix(count);
}

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  static_cast<PngSource*>(png_get_error_ptr(png))->message = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

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
bool read_header(png_structp png, png_infop info, GrayImage& image) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: how libpng fails
  png_read_info(png, info);
  image.width = static_cast<int>(png_get_image_width(png, info));
  image.height = static_cast<int>(png_get_image_height(png, info));
  return true;
}

bool read_rows(png_structp png, png_infop info, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: how libpng fails
  ask_for_gray(png, info);
  png_read_image(png, rows);
  return true;
}

// libpng's objects for one file.
struct PngFile {
  explicit PngFile(std::string_view bytes) : source{bytes, ""} {
    png_set_read_fn(png, &source, take_bytes);
  }
  ~PngFile() { png_destroy_read_struct(&png, &info, nullptr); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  PngSource source;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, fail, ignore_warning);
  png_infop info = png_create_info_struct(png);
};

// The image's size, without pixels.
GrayImage header_of(PngFile& file, const std::string& what) {
  GrayImage image;
  if (!read_header(file.png, file.info, image)) {
    refuse(what, "a damaged PNG: " + file.source.message);
  }
  check_size(what, image.width, image.height);
  return image;
}

GrayImage decode_png(std::string_view bytes, const std::string& what) {
  PngFile file(bytes);
  GrayImage image = header_of(file, what);
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

// The first bytes tell the format.
bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }
bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG"); }

[[noreturn]] void refuse_kind(std::string_view bytes, const std::string& what) {
  refuse(what, fmt::format("{} bytes of another kind", bytes.size()));
}

}  // namespace

GrayImage decode_gray_image(std::string_view bytes, const std::string& what) {
  if (is_jpeg(bytes)) return decode_jpeg(bytes, what);
  if (is_png(bytes)) return decode_png(bytes, what);
  refuse_kind(bytes, what);
}

std::int64_t pixels_of_image(const std::filesystem::path& file) {
  const std::string bytes = read_file(file);
  GrayImage image;
  if (is_jpeg(bytes)) {
    read_jpeg_header(new_decompressor().get(), bytes, file.string(), image);
  } else if (is_png(bytes)) {
    PngFile png(bytes);
    image = header_of(png, file.string());
  } else {
    refuse_kind(bytes, file.string());
  }
  return static_cast<std::int64_t>(image.width) * image.height;
}

GrayImage read_gray_image(const std::filesystem::path& file) {
  return decode_gray_image(read_file(file), file.string());
}

}  // namespace throng::images
