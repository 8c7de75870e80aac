// Percent-encoding in URLs (RFC 3986).
#pragma once

#include <string>
#include <string_view>

namespace throng {

/// Characters besides letters and digits that need no encoding in a URL.
inline constexpr std::string_view kUnreserved = "-._~";

/// Encodes all bytes except letters, digits and the characters of `kept`.
std::string percent_encoded(std::string_view text, std::string_view kept = kUnreserved);

}  // namespace throng
