#include "base/graphics/images/raster.h"

#include <csetjmp>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "base/graphics/images/png_file.h"

namespace throng::images {

namespace fs = std::filesystem;

namespace {

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
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT: how libpng fails
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
  PngFile file(bytes);
  const PngSize size = read_png_header(file, path.string());
  Rows rows{size.width,
            size.height,
            png_get_bit_depth(file.png, file.info),
            png_get_channels(file.png, file.info),
            {}};
  if (!read_rows(file.png, file.info, rows)) {
    throw InputError({path.string(), "", "a damaged PNG: " + file.source.message, "a whole PNG"});
  }
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

}  // namespace throng::images
