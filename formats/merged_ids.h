// Ids of datasets that become one: those of the second go on where those of the first end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace throng::formats {

/// The text of a run's file in the folder `kind` with its track ids shifted; nothing for files
/// without track ids, which stay what they are. Throws InputError.
std::optional<std::string> with_shifted_tracks(const std::filesystem::path& file,
                                               const std::string& kind, std::int64_t shift);

/// A COCO file of the datasets.
struct CocoPart {
  std::filesystem::path file;
  std::int64_t track_shift = 0;
  std::function<std::string(const std::string&)> new_run;  ///< name in the result of a run
};

/// Writes one COCO file of several, record by record. Throws InputError.
void join_coco_files(const std::vector<CocoPart>& parts, const std::string& description,
                     const std::filesystem::path& output);

}  // namespace throng::formats
