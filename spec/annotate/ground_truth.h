// The kinds of ground truth that a dataset may hold: one table, from which follow the words of
// outputs.annotations in the job schema, what the renderer is asked for, where files lie, what
// dataset.json says of them, which files `throng validate` expects and which a download selects.
// The code that writes and checks a kind is registered under the same enumerator:
// annotate/frame_writers.cpp, jobs/pipeline/frames/run_writers.cpp,
// formats/validate/ground_truth_checks.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace throng::annotate {

/// Raised whenever the meaning of a label changes (docs/formats_coco.md): `info.version` of COCO
/// files, and `schema_versions` of dataset.json.
inline constexpr const char* kLabelVersion = "2";

/// In the order of the table.
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

/// The unit that a kind is made for; the job schema lists the kinds in these groups.
enum class Extent : std::uint8_t {
  scene,  ///< a frame's people, or the whole run
  pixel,  ///< a raster for each frame
  drone,  ///< a table for each drone and run
};

/// Buffers that the renderer fills beside color, ids and depth (render::RenderOptions).
struct RenderNeeds {
  bool normals = false;
  bool flow = false;
  bool flow_backward = false;
  bool flow_depth = false;
  bool scene_flow = false;
  bool hazard_opacity = false;
  bool parts = false;
  bool whole_masks = false;
  bool vehicles = false;
  bool semantic = false;
};

struct GroundTruthKind {
  GroundTruth kind{};
  std::string_view name = {};  ///< in outputs.annotations
  std::string_view help = {};  ///< in parentheses after the name in the job schema, or ""
  Extent extent = Extent::scene;
  /// The file that holds it, below the dataset: RUN, CAMERA and FRAME stand for a run's name, a
  /// drone's id and a frame's number of six digits.
  std::string_view file = {};
  std::string_view content = {};  ///< what stands in the file, for dataset.json, or ""
  bool is_default = false;        ///< of a job that does not say
  RenderNeeds needs = {};
  bool in_coco = false;  ///< part of the COCO records: of no effect without the kind coco
};

/// All kinds, in the order of the enumerators.
std::span<const GroundTruthKind> ground_truth_kinds();

const GroundTruthKind& ground_truth_kind(GroundTruth kind);

/// Whether a kind comes from images or lies beside them, for each camera.
bool needs_images(const GroundTruthKind& kind);

/// Null if there is no kind of this name.
const GroundTruthKind* find_kind(std::string_view name);

/// Whether a job's outputs.annotations hold the kind.
bool holds(std::span<const std::string> names, GroundTruth kind);

/// Buffers that a job's outputs.annotations need.
RenderNeeds render_needs(std::span<const std::string> names);

/// outputs.annotations of a job that does not say.
std::vector<std::string> default_ground_truth();

/// The kinds and what they are, in one sentence: the help of outputs.annotations.
std::string ground_truth_help();

/// The folder at the dataset's top that holds the kind's files: "density".
std::string_view ground_truth_folder(const GroundTruthKind& kind);

/// The kind's file of a run, a camera and a frame, as far as its pattern names them.
std::string ground_truth_file(GroundTruth kind, std::string_view run, std::string_view camera = "",
                              std::int64_t frame = 0);

}  // namespace throng::annotate
