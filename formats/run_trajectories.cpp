#include "formats/run_trajectories.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "annotate/spec/ground_truth.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

std::vector<float> read_values(const fs::path& file, const std::string& shape, std::size_t count) {
  const std::string bytes = read_file(file);
  constexpr std::size_t kPreamble = 10;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const std::size_t start =
      bytes.size() < kPreamble ? bytes.size() : kPreamble + byte(8) + 256U * byte(9);
  if (start + count * sizeof(float) != bytes.size() ||
      bytes.find("'shape': " + shape) == std::string::npos ||
      bytes.find("'<f4'") == std::string::npos) {
    throw InputError({file.string(), "", "another shape or type", "float32 of shape " + shape});
  }
  std::vector<float> values(count);
  std::memcpy(values.data(), bytes.data() + start, count * sizeof(float));
  return values;
}

}  // namespace

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
  recorded.values = read_values(root / annotate::file_of(annotate::GroundTruth::trajectories, run),
                                fmt::format("({}, {}, {})", frames, people, kTrajectoryValues),
                                frames * people * kTrajectoryValues);
  return recorded;
}

}  // namespace throng::formats
