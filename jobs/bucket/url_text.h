// Keys and queries as they stand in URLs, and are signed.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace throng::bucket {

using Pairs = std::vector<std::pair<std::string, std::string>>;

/// A key with all but unreserved characters (RFC 3986) and slashes encoded.
std::string encoded_path(std::string_view key);

/// "?name=value&..." with the names sorted, "" for no pairs. libcurl 7.88 signs a query as it is
/// written, so that it has to have the form of Signature Version 4: sorted, with everything encoded
/// that is reserved, and with "=" after a name that has no value.
std::string query_text(Pairs query);

}  // namespace throng::bucket
