#include "formats/dataset/run_trajectories.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "formats/files/npy.h"
#include "spec/annotate/ground_truth.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

RunTrajectories read_run_trajectories(const fs::path& root, const std::string& run) {
  const std::string description = "trajectories/" + run + ".json";
  const json record = parse_own_json(read_file(root / description), description);
  RunTrajectories recorded{record.at("times_s").get<std::vector<double>>(),
                           record.at("track_ids").get<std::vector<std::int64_t>>(),
                           record.at("states").get<std::vector<std::string>>(),
                           {}};
  const std::size_t frames = recorded.times_s.size();
  const std::size_t people = recorded.tracks.size();
  if (!std::is_sorted(recorded.tracks.begin(), recorded.tracks.end())) {
    throw InputError({description, "/track_ids", "another order", "ascending ids"});
  }
  recorded.values =
      read_npy(root / annotate::ground_truth_file(annotate::GroundTruth::trajectories, run),
               {frames, people, kTrajectoryValues});
  return recorded;
}

}  // namespace throng::formats
