// Which bytes are text.
#pragma once

#include <cstddef>
#include <string_view>

namespace throng::crowd {

/// Position of the first byte that is no UTF-8 (RFC 3629); npos when there is none.
std::size_t find_no_utf8(std::string_view text);

}  // namespace throng::crowd
