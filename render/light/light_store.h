// Baked light as files that the processes of a job share: each is named after all that it depends
// on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace throng::render {

/// Bytes of all files in a folder; beyond it the oldest go.
inline constexpr std::uint64_t kMaxLightBytes = std::uint64_t{64} << 20U;

/// Returns the values of the file KEY.light in the folder, `count` of them, as half floats hold
/// them. Makes and writes them if there is no such file or it is damaged; of several processes one
/// makes them while the others wait. With an empty folder they are made and not kept. Throws
/// EnvironmentError naming the file if it cannot be written.
std::vector<float> load_or_make(const std::filesystem::path& folder, const std::string& key,
                                std::size_t count, const std::function<std::vector<float>()>& make);

}  // namespace throng::render
