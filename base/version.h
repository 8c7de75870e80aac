// The name and version that every file we write carries.
#pragma once

#include <string_view>

namespace throng {

inline constexpr std::string_view kVersion = THRONG_VERSION;
inline constexpr std::string_view kGenerator = "throng " THRONG_VERSION;

}  // namespace throng
