// Renumbering of ids when datasets are merged: the ids of a dataset follow those of the previous
// one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace throng::formats {

/// The content of a run's file in the folder `kind` with its track ids shifted; std::nullopt for
/// kinds without track ids. Throws InputError.
std::optional<std::string> with_shifted_tracks(const std::filesystem::path& file,
                                               const std::string& kind, std::int64_t shift);

/// The COCO file of one dataset.
struct CocoPart {
  std::filesystem::path file;
  std::int64_t track_shift = 0;
  std::function<std::string(const std::string&)> new_run;  ///< maps a run's name to the new one
};

/// Concatenates COCO files into one, record by record. Throws InputError.
void join_coco_files(const std::vector<CocoPart>& parts, const std::string& description,
                     const std::filesystem::path& output);

}  // namespace throng::formats
