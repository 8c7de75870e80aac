// Fast compression to zlib streams.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace throng {

/// Compresses `input` to one zlib stream (RFC 1950) with libdeflate at level 1; equal inputs give
/// equal bytes, which was not always true for the faster ISA-L. The result is a view of `output`,
/// which may be reused to avoid allocations.
std::string_view deflated(std::span<const std::uint8_t> input, std::vector<std::uint8_t>& output);

}  // namespace throng
