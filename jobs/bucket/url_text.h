// Encoding of keys and queries in URLs and signatures.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace throng::bucket {

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// Percent-encodes a key, except for unreserved characters (RFC 3986) and slashes.
std::string encoded_path(std::string_view key);

/// "?name=value&..." sorted by name; "" for no pairs. libcurl 7.88 signs the query as it is, so it
/// must be in the canonical form of Signature Version 4: sorted, all reserved characters encoded,
/// and
/// "=" after a name without a value.
std::string query_text(Pairs query);

}  // namespace throng::bucket
