// Secrets for callers: never repeated, unlike what base/compute/random.h makes.
#pragma once

#include <cstddef>
#include <string>

namespace throng::server {

/// Small letters and digits, of 5 random bits each.
std::string random_text(std::size_t length);

}  // namespace throng::server
