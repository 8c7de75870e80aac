#include "base/files/gunzip.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>

#include "base/error.h"

namespace throng {

namespace {

constexpr std::size_t kMaxContent = std::size_t{1} << 30U;

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* decompressor) const {
    libdeflate_free_decompressor(decompressor);
  }
};

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string gunzipped(std::string_view bytes, const std::string& name) {
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  if (!decompressor) throw EnvironmentError("not enough memory to decompress");
  std::string content;
  std::size_t room = 8 * bytes.size() + 4096;
  while (!bytes.empty()) {
    const std::size_t size = content.size();
    content.resize(std::min(size + room, kMaxContent));
    std::size_t consumed = 0;
    std::size_t produced = 0;
    const libdeflate_result result = libdeflate_gzip_decompress_ex(
        decompressor.get(), bytes.data(), bytes.size(), content.data() + size,
        content.size() - size, &consumed, &produced);
    if (result == LIBDEFLATE_SUCCESS) {
      content.resize(size + produced);
      bytes.remove_prefix(consumed);
      continue;
    }
    if (result != LIBDEFLATE_INSUFFICIENT_SPACE) {
      throw InputError({name, "", "a damaged gzip file", "a whole one; copy it again"});
    }
    if (content.size() == kMaxContent) {
      throw InputError({name, "", "a gzip file of more than 1 GiB", "less; decompress it first"});
    }
    content.resize(size);
    room *= 4;
  }
  return content;
}

}  // namespace throng
