#include "base/deflate.h"

#include <isa-l/igzip_lib.h>

#include <algorithm>

#include "base/error.h"

namespace throng {

std::string_view deflated(std::span<const std::uint8_t> input, std::vector<std::uint8_t>& output) {
  thread_local std::vector<std::uint8_t> work(ISAL_DEF_LVL1_DEFAULT);
  output.resize(std::max(output.size(), input.size() + input.size() / 8 + 1024));
  // isal_deflate_stateless_init() leaves hist_bits, on which the bytes depend, as it finds it.
  isal_zstream stream{};
  isal_deflate_stateless_init(&stream);
  stream.level = 1;
  stream.level_buf = work.data();
  stream.level_buf_size = static_cast<std::uint32_t>(work.size());
  stream.gzip_flag = IGZIP_ZLIB;
  stream.end_of_stream = 1;
  stream.flush = NO_FLUSH;
  // ISA-L's interface takes what it only reads as if it could change it.
  stream.next_in = const_cast<std::uint8_t*>(input.data());  // NOLINT(*-const-cast)
  stream.avail_in = static_cast<std::uint32_t>(input.size());
  stream.next_out = output.data();
  stream.avail_out = static_cast<std::uint32_t>(output.size());
  check(isal_deflate_stateless(&stream) == COMP_OK, "the room for what is compressed suffices");
  return {reinterpret_cast<const char*>(output.data()), stream.total_out};
}

}  // namespace throng
