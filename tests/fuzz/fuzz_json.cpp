// Any text as JSON: what is taken is what nlohmann's parser reads, and is not deep.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "base/json/json_text.h"
#include "base/text/utf8.h"

namespace {

using nlohmann::json;

std::size_t nesting_depth(const json& value) {
  std::size_t deepest = 0;
  if (!value.is_structured()) return 0;
  for (const json& child : value) deepest = std::max(deepest, nesting_depth(child));
  return deepest + 1;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const throng::JsonLimits limits = {.max_depth = 8,
                                     .max_bytes = 7000,
                                     .max_values = 100,
                                     .max_object_keys = 20,
                                     .max_key_bytes = 50,
                                     .max_number_chars = 40};
  try {
    const json value = throng::parse_json(text, "", limits);
    if (nesting_depth(value) > limits.max_depth || value != json::parse(text)) std::abort();
    if (throng::parse_own_json(text, "x") != value) std::abort();
  } catch (const throng::InputError& error) {
    if (error.problems().size() != 1 || error.problems().front().found.size() > 500) std::abort();
    if (!throng::parse_json_or_discard(text, limits).is_discarded()) std::abort();
    // The rest is beyond the limits, holds a key twice, or has a number that no double can hold.
    const throng::Problem& problem = error.problems().front();
    const bool is_malformed =
        problem.where.starts_with("line ") || problem.expected.starts_with("valid JSON");
    if (!throng::is_utf8(problem.found)) std::abort();
    // The library takes a zero byte for the end and ignores the rest.
    const bool is_whole = text.find('\0') == std::string::npos;
    if (is_malformed && is_whole && !json::parse(text, nullptr, false).is_discarded()) std::abort();
  }
  return 0;
}
