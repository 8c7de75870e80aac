// When a key expires, as users write it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace throng::server {

/// The texts that parse_expiry() accepts, for messages.
inline constexpr const char* kExpiryRule =
    "a time to come: 2027-01-31 (from 00:00 UTC on), 2027-01-31T12:00:00Z or 30d, 12h, 2w from now";

/// The Unix time in milliseconds of a date, a time by RFC 3339, or a duration from now;
/// std::nullopt for any other text and for a time that has passed.
std::optional<std::int64_t> parse_expiry(const std::string& text);

}  // namespace throng::server
