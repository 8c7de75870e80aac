// Any job: it is refused, or is the same job again when it is written and read.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/error.h"
#include "spec/job/spec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  std::string written;
  try {
    written = to_json(throng::jobs::parse_job(text, "")).dump();
  } catch (const throng::InputError&) {
    return 0;
  }
  // An accepted job must be accepted again.
  if (to_json(throng::jobs::parse_job(written, "")).dump() != written) std::abort();
  return 0;
}
