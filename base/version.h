// Name and version of the program, written into all output files.
#pragma once

#include <string_view>

namespace throng {

inline constexpr std::string_view kVersion = THRONG_VERSION;
inline constexpr std::string_view kGenerator = "throng " THRONG_VERSION;

}  // namespace throng
