// Percent-encoding in URLs (RFC 3986).
#pragma once

#include <string>
#include <string_view>

namespace throng {

/// Characters that stand for themselves anywhere in a URL, besides letters and digits.
inline constexpr std::string_view kUnreserved = "-._~";

/// The text with all bytes encoded but letters, digits and those in `kept`.
std::string percent_encoded(std::string_view text, std::string_view kept = kUnreserved);

}  // namespace throng
