// Names and version of the trace file's layout, shared by its writer and its reader.
#pragma once

#include <cstddef>
#include <cstdint>

namespace throng::world {

inline constexpr const char* kTraceFormat = "throng trace";
/// Increases with each change that older readers would misread.
inline constexpr std::int32_t kTraceVersion = 3;
/// Fixed width in bytes of the texts of an event, including a final zero.
inline constexpr std::size_t kEventWordWidth = 32;

}  // namespace throng::world
