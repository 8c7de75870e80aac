#include "formats/raster.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/files.h"

namespace throng::formats {

namespace fs = std::filesystem;

namespace {

/// The bytes that libpng reads from.
struct Source {
  const std::string* bytes;
  std::size_t at;
};

void take(png_structp png, png_bytep to, png_size_t count) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (count > source->bytes->size() - source->at) png_error(png, "cut off");
  std::memcpy(to, source->bytes->data() + source->at, count);
  source->at += count;
}

[[noreturn]] void refuse(png_structp png, png_const_charp message) {
  auto* text = static_cast<std::string*>(png_get_error_ptr(png));
  *text = message;
  png_longjmp(png, 1);
}

void be_quiet(png_structp /*png*/, png_const_charp /*message*/) {}

/// Rows as they lie in the file: big-endian where samples have 16 bits.
struct Rows {
  png_uint_32 width = 0;
  png_uint_32 height = 0;
  int bits = 0;
  int channels = 0;
  std::vector<png_byte> bytes;
};

// Nothing with a destructor may be made between setjmp and longjmp.
bool read_rows(png_structp png, png_infop info, Rows& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: libpng's way to fail
  png_read_info(png, info);
  rows.width = png_get_image_width(png, info);
  rows.height = png_get_image_height(png, info);
  rows.bits = png_get_bit_depth(png, info);
  rows.channels = png_get_channels(png, info);
  const png_size_t row_bytes = png_get_rowbytes(png, info);
  rows.bytes.resize(row_bytes * rows.height);
  for (png_uint_32 y = 0; y < rows.height; ++y) {
    png_read_row(png, rows.bytes.data() + y * row_bytes, nullptr);
  }
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

Raster read_raster(const fs::path& path) {
  if (!fs::is_regular_file(path)) throw InputError({path.string(), "", "no such file", "a PNG"});
  const std::string bytes = read_file(path);
  std::string message;
  Source source{&bytes, 0};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, refuse, be_quiet);
  png_infop info = png_create_info_struct(png);
  png_set_read_fn(png, &source, take);
  Rows rows;
  const bool is_read = read_rows(png, info, rows);
  png_destroy_read_struct(&png, &info, nullptr);
  if (!is_read) throw InputError({path.string(), "", "a damaged PNG: " + message, "a whole PNG"});
  if ((rows.bits != 8 && rows.bits != 16) || (rows.channels != 1 && rows.channels != 3)) {
    throw InputError({path.string(), "", "another kind of PNG", "gray or RGB of 8 or 16 bits"});
  }
  Raster raster{
      static_cast<int>(rows.width), static_cast<int>(rows.height), rows.channels, rows.bits, {}};
  const std::size_t step = rows.bits == 16 ? 2 : 1;
  raster.samples.resize(rows.bytes.size() / step);
  for (std::size_t i = 0; i < raster.samples.size(); ++i) {
    const png_byte* sample = rows.bytes.data() + i * step;
    raster.samples[i] =
        static_cast<std::uint16_t>(step == 2 ? sample[0] << 8 | sample[1] : sample[0]);
  }
  return raster;
}

std::vector<std::uint32_t> read_instances(const fs::path& path) {
  const Raster raster = read_raster(path);
  if (raster.bits != 8 || raster.channels != 3) {
    throw InputError({path.string(), "", "another kind of PNG", "8-bit RGB"});
  }
  std::vector<std::uint32_t> ids(raster.samples.size() / 3);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint16_t* rgb = raster.samples.data() + 3 * i;
    ids[i] = static_cast<std::uint32_t>(rgb[0]) | static_cast<std::uint32_t>(rgb[1]) << 8 |
             static_cast<std::uint32_t>(rgb[2]) << 16;
  }
  return ids;
}

fs::path raster_path(const fs::path& root, const char* kind, const std::string& image_file) {
  const std::size_t slash = image_file.find('/');
  const std::string rest = slash == std::string::npos ? image_file : image_file.substr(slash + 1);
  return (root / kind / rest).replace_extension(".png");
}

}  // namespace throng::formats
