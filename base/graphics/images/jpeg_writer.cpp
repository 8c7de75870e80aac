#include "base/graphics/images/jpeg_writer.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <memory>
#include <type_traits>

#include "base/error.h"

namespace throng::images {

namespace {

// One compressor per thread: setting one up costs more than a small image.
tjhandle compressor() {
  using Handle = std::unique_ptr<std::remove_pointer_t<tjhandle>, decltype(&tjDestroy)>;
  thread_local const Handle handle(tjInitCompress(), &tjDestroy);
  if (!handle) throw EnvironmentError("cannot start the JPEG compressor: out of memory");
  return handle.get();
}

}  // namespace

std::string jpeg_bytes(const std::vector<std::uint8_t>& rgb, int width, int height, int quality) {
  check(rgb.size() == 3U * static_cast<std::size_t>(width) * height, "three bytes per pixel");
  thread_local std::vector<unsigned char> buffer;
  unsigned long size = tjBufSize(width, height, TJSAMP_420);
  buffer.resize(std::max<std::size_t>(buffer.size(), size));
  unsigned char* destination = buffer.data();
  // The accurate transform gives the same bytes with and without SIMD.
  if (tjCompress2(compressor(), rgb.data(), width, 0, height, TJPF_RGB, &destination, &size,
                  TJSAMP_420, quality, TJFLAG_NOREALLOC | TJFLAG_ACCURATEDCT) != 0) {
    throw EnvironmentError(
        fmt::format("cannot compress an image as JPEG: {}", tjGetErrorStr2(compressor())));
  }
  return {reinterpret_cast<const char*>(buffer.data()), size};
}

}  // namespace throng::images
