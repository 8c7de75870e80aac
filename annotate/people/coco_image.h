// Images, categories and track ids of COCO files.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/people/person_facts.h"
#include "camera/camera.h"
#include "world/semantic_class.h"

namespace throng::annotate {

/// Record of an image. Members that hold JSON are inserted as they are.
struct CocoImage {
  std::int64_t id = 0;
  std::string file_name;  ///< relative to the image root, forward slashes
  std::string run;        ///< "run000"
  std::string camera_id;  ///< drone id
  std::int64_t frame_index = 0;
  double time_s = 0;
  camera::Camera camera;           ///< K, R, t are written with the image
  int run_index = 0;               ///< index of the run in the dataset; part of track ids
  std::string environment;         ///< a JSON object: light and weather; "" to omit
  std::string drawn;               ///< a JSON object: random values of run and frame; "" to omit
  std::string sensor;              ///< a JSON object: sensor and exposure; "" to omit
  std::string flight;              ///< a JSON object: the drone and its sensors; "" to omit
  std::string exits;               ///< a JSON array: exits in the image; "" to omit
  std::string density_file;        ///< path like file_name; "" if there is no density map
  std::int64_t density_count = 0;  ///< number of heads, the sum of the density map
  std::string hazards;             ///< a JSON array: hazards so far; "" to omit
  std::string zones;               ///< a JSON array: people visible in zones; "" to omit
  const PersonFacts* facts = nullptr;  ///< of the run's people; null to omit
  /// Ids of the run's drones by index; null if drones are not labeled.
  const std::vector<std::string>* drone_ids = nullptr;
  bool whole_masks = false;  ///< also write the amodal masks of people, drones and vehicles
};

inline constexpr int kPersonCategory = 1;

/// A category other than people.
struct ObjectCategory {
  int id = 0;
  std::string_view name;
  world::SemanticClass surface{};
};
inline constexpr std::array kObjectCategories = {
    ObjectCategory{2, "drone", world::SemanticClass::drone},
    ObjectCategory{3, "car", world::SemanticClass::car},
    ObjectCategory{4, "train", world::SemanticClass::train},
    ObjectCategory{5, "van", world::SemanticClass::van},
    ObjectCategory{6, "truck", world::SemanticClass::truck},
    ObjectCategory{7, "bus", world::SemanticClass::bus},
    ObjectCategory{8, "motorcycle", world::SemanticClass::motorcycle},
};
inline constexpr int kDroneCategory = kObjectCategories.front().id;

/// The categories other than people of a dataset with drones in view or with vehicles.
std::vector<ObjectCategory> object_categories(bool drones, bool vehicles);

/// Max number of agents in a run, so that ids are unique: annotation id = image id *
/// kMaxAgentsPerRun
/// + agent id + 1.
inline constexpr std::int64_t kMaxAgentsPerRun = 100'000;
/// The last agent ids are reserved: drone i has the id kFirstDroneNumber + i, and vehicle i the id
/// kFirstVehicleNumber + i.
inline constexpr std::int64_t kMaxDronesPerRun = 16;
inline constexpr std::int64_t kFirstDroneNumber = kMaxAgentsPerRun - kMaxDronesPerRun;
inline constexpr std::int64_t kMaxVehiclesPerRun = 4096;
inline constexpr std::int64_t kFirstVehicleNumber = kFirstDroneNumber - kMaxVehiclesPerRun;
/// Max image id, so that annotation ids are exact in programs that read numbers as doubles.
inline constexpr std::int64_t kMaxImageId = (std::int64_t{1} << 53) / kMaxAgentsPerRun - 1;
/// A person's track_id, equal in all frames and cameras of a run: agent id + 1 + run_index *
/// kTrackIdsPerRun.
inline constexpr std::int64_t kTrackIdsPerRun = 1'000'000;
constexpr std::int64_t track_id(std::int64_t run_index, std::uint32_t agent) {
  return agent + 1 + run_index * kTrackIdsPerRun;
}

}  // namespace throng::annotate
