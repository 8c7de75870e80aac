#include "base/files/deflate.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>

#include "base/error.h"

namespace throng {

namespace {

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
  }
};

}  // namespace

std::string_view deflated(std::span<const std::uint8_t> input, std::vector<std::uint8_t>& output) {
  constexpr int kFastest = 1;
  thread_local const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(kFastest));
  if (!compressor) throw EnvironmentError("not enough memory to compress");
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), input.size());
  output.resize(std::max(output.size(), bound));
  const std::size_t size = libdeflate_zlib_compress(compressor.get(), input.data(), input.size(),
                                                    output.data(), output.size());
  check(size > 0, "the room for what is compressed suffices");
  return {reinterpret_cast<const char*>(output.data()), size};
}

}  // namespace throng
