// COCO instances JSON, streamed: records are written as they come and never rewritten, so memory
// does not grow with the number of frames.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/people/labels.h"
#include "annotate/people/person_facts.h"
#include "camera/camera.h"
#include "world/semantic_class.h"

namespace throng::annotate {

struct CocoImage {
  std::int64_t id = 0;
  std::string file_name;  ///< relative to the image root, forward slashes
  std::string run;        ///< "run000"
  std::string camera_id;  ///< drone id
  std::int64_t frame_index = 0;
  double time_s = 0;
  camera::Camera camera;           ///< K, R, t are written with the image
  int run_index = 0;               ///< number of the run in the dataset: keeps track ids apart
  std::string environment;         ///< a JSON object: light and weather; "" when not known
  std::string drawn;               ///< a JSON object: the samples of the run; "" without any
  std::string sensor;              ///< a JSON object: sensor and exposure; "" when not known
  std::string flight;              ///< a JSON object: the drone and its sensors; "" when not known
  std::string exits;               ///< a JSON array: exits in the image; "" when not known
  std::string density_file;        ///< like file_name; "" when the frame has no density map
  std::int64_t density_count = 0;  ///< heads that the density map sums to
  std::string hazards;             ///< JSON, or ""
  std::string zones;               ///< a JSON array: people visible in zones, or ""
  const PersonFacts* facts = nullptr;  ///< of the run's people; null when not known
  /// Ids of the run's drones, by number; null when there are none to be seen.
  const std::vector<std::string>* drone_ids = nullptr;
  bool whole_masks = false;  ///< write the whole masks of people, drones and vehicles, too
};

inline constexpr int kPersonCategory = 1;

/// A category of what is no person.
struct ObjectCategory {
  int id = 0;
  std::string_view name;
  world::SemanticClass surface{};
};
inline constexpr std::array kObjectCategories = {
    ObjectCategory{2, "drone", world::SemanticClass::drone},
    ObjectCategory{3, "car", world::SemanticClass::car},
    ObjectCategory{4, "train", world::SemanticClass::train},
};
inline constexpr int kDroneCategory = kObjectCategories.front().id;

/// The categories beside people's of a dataset where drones may see each other, or that has
/// vehicles.
std::vector<ObjectCategory> object_categories(bool drones, bool vehicles);

/// Agents that one run may have, so that ids stay unique: annotation id = image id *
/// kMaxAgentsPerRun + agent id + 1.
inline constexpr std::int64_t kMaxAgentsPerRun = 100'000;
/// The last of these numbers are drones': drone i is counted as agent kFirstDroneNumber + i. Those
/// before are vehicles', counted in the same way.
inline constexpr std::int64_t kMaxDronesPerRun = 16;
inline constexpr std::int64_t kFirstDroneNumber = kMaxAgentsPerRun - kMaxDronesPerRun;
inline constexpr std::int64_t kMaxVehiclesPerRun = 4096;
inline constexpr std::int64_t kFirstVehicleNumber = kFirstDroneNumber - kMaxVehiclesPerRun;
/// Ids are exact in readers whose numbers are doubles (JavaScript).
inline constexpr std::int64_t kMaxImageId = (std::int64_t{1} << 53) / kMaxAgentsPerRun - 1;
/// A person's track_id, equal in all frames and cameras of a run: agent id + 1 + run_index *
/// kTrackIdsPerRun.
inline constexpr std::int64_t kTrackIdsPerRun = 1'000'000;
constexpr std::int64_t track_id(std::int64_t run_index, std::uint32_t agent) {
  return agent + 1 + run_index * kTrackIdsPerRun;
}

/// Writes the records of one shard of frames: `images.jsonl`, `annotations.jsonl` and, of who is in
/// them, `tracks.jsonl` in a folder, one JSON object per line, and `coco_shard.json`, which counts
/// them and says that the shard is whole. Ids depend on image and agent only, never on how frames
/// are sharded.
class CocoShardWriter {
 public:
  /// Creates the folder; replaces the files of an earlier attempt. Throws EnvironmentError.
  explicit CocoShardWriter(const std::filesystem::path& folder);
  ~CocoShardWriter();
  CocoShardWriter(const CocoShardWriter&) = delete;
  CocoShardWriter& operator=(const CocoShardWriter&) = delete;
  /// Image ids are unique over the dataset and at most kMaxImageId. Throws EnvironmentError when
  /// the disk refuses.
  void add(const CocoImage& image, const FrameLabels& labels);
  /// Flushes, closes and declares the shard whole; throws EnvironmentError when the disk refused.
  void finish();

 private:
  class Files;
  std::unique_ptr<Files> files_;
};

struct CocoCategories {
  bool keypoints = false;  ///< that of people names theirs
  bool drones = false;     ///< there is one of drones
  bool vehicles = false;   ///< there are those of vehicles
  bool skeletons = false;  ///< that of people names joints and bones
};

/// Everything of the COCO file before its records: `info`, `licenses` and `categories`.
/// `description` becomes info.description. With "}" it is a JSON object.
std::string coco_head(const std::string& description, const CocoCategories& categories);

/// One linear pass over shard folders, in the given order, which is by run, into one COCO file
/// (written beside and renamed). `description` becomes info.description. Throws EnvironmentError
/// naming file and line when a shard is unfinished, truncated or damaged, or when the disk refuses.
void merge_coco(const std::vector<std::filesystem::path>& shard_folders,
                const std::filesystem::path& output, const std::string& description,
                const CocoCategories& categories = {});

}  // namespace throng::annotate
