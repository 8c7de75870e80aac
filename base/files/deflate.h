// Fast compression that any reader of zlib streams understands.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace throng {

/// One zlib stream (RFC 1950) of `input`, by libdeflate at its level 1. Equal inputs give equal
/// bytes; ISA-L, four times as fast, did not always. The result lies in `output`, whose capacity
/// grows as needed and may be reused.
std::string_view deflated(std::span<const std::uint8_t> input, std::vector<std::uint8_t>& output);

}  // namespace throng
