// Random text for keys and tokens, from the system's entropy and not from base/compute/random.h,
// whose values can be reproduced.
#pragma once

#include <cstddef>
#include <string>

namespace throng::server {

/// A random text of lower-case letters and digits with 5 random bits per character.
std::string random_text(std::size_t length);

}  // namespace throng::server
