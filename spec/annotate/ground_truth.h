// The kinds of ground truth that a dataset may hold, in one table. It defines the words of
// outputs.annotations in the job schema, the buffers that the renderer fills, the paths of the
// files, their description in dataset.json, the files that `throng validate` expects and those that
// a download selects.
// The code that writes and checks a kind is registered under the same enumerator:
// annotate/frame_writers.cpp, jobs/pipeline/frames/run_writers.cpp,
// checks/ground_truth_checks.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace throng::annotate {

/// The version of the labels, which grows when the meaning of one changes (docs/formats_coco.md).
/// It is `info.version` of COCO files and stands in `schema_versions` of dataset.json.
inline constexpr const char* kLabelVersion = "4";

/// The kinds in the order of the table that ground_truth_kinds() returns.
enum class GroundTruth : std::uint8_t {
  coco,
  keypoints,
  skeletons,
  actions,
  amodal,
  vehicles,
  difficulty,
  heads,
  occluders,
  density,
  exits,
  hazards,
  fields,
  counts,
  trajectories,
  events,
  depth,
  instances,
  parts,
  normals,
  flow,
  flow_backward,
  flow_occlusion,
  scene_flow,
  hazard_opacity,
  semantic,
  sensors,
};

/// The unit of data that a kind describes; the job schema lists the kinds in these groups.
enum class Extent : std::uint8_t {
  scene,  ///< a frame's people, or the whole run
  pixel,  ///< a raster for each frame
  drone,  ///< a table for each drone and run
};

/// Buffers that the renderer fills in addition to color, ids and depth (render::RenderOptions).
struct RenderNeeds {
  bool normals = false;
  bool flow = false;
  bool flow_backward = false;
  bool flow_depth = false;
  bool scene_flow = false;
  bool hazard_opacity = false;
  bool parts = false;
  bool whole_masks = false;
  bool bone_turns = false;
  bool vehicles = false;
  bool semantic = false;
};

/// A row of the table.
struct GroundTruthKind {
  GroundTruth kind{};
  std::string_view name = {};  ///< its word in outputs.annotations
  std::string_view help = {};  ///< in parentheses after the name in the job schema, or ""
  Extent extent = Extent::scene;
  /// Path of its file relative to the dataset; RUN, CAMERA and FRAME stand for a run's name, a
  /// drone's id and a frame's number with six digits.
  std::string_view file = {};
  std::string_view content = {};  ///< description of the file's content in dataset.json, or ""
  bool is_default = false;        ///< written by jobs that do not name kinds
  RenderNeeds needs = {};
  bool in_coco = false;  ///< part of the COCO records; has no effect without the kind coco
};

/// All kinds, in the order of the enumerators.
std::span<const GroundTruthKind> ground_truth_kinds();

const GroundTruthKind& ground_truth_kind(GroundTruth kind);

/// Whether a kind has a file per camera or is the COCO file, so that it exists only with images.
bool needs_images(const GroundTruthKind& kind);

/// Returns the kind of this name, or null if there is none.
const GroundTruthKind* find_kind(std::string_view name);

/// Whether `names`, a job's outputs.annotations, contain the kind.
bool holds(std::span<const std::string> names, GroundTruth kind);

/// Returns the buffers that `names`, a job's outputs.annotations, need. All names must be kinds.
RenderNeeds render_needs(std::span<const std::string> names);

/// The default of a job's outputs.annotations.
std::vector<std::string> default_ground_truth();

/// The help of outputs.annotations: one sentence that lists and describes all kinds.
std::string ground_truth_help();

/// The top-level folder of the dataset that holds the kind's files, for example "density".
std::string_view ground_truth_folder(const GroundTruthKind& kind);

/// Path of the kind's file relative to the dataset. Arguments that its pattern does not contain are
/// ignored.
std::string ground_truth_file(GroundTruth kind, std::string_view run, std::string_view camera = "",
                              std::int64_t frame = 0);

}  // namespace throng::annotate
