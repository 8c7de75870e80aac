// A finished dataset, read image by image with its annotations: what every exporter is fed.
// Memory does not grow with the number of images.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "annotate/people/coco.h"
#include "base/error.h"
#include "spec/annotate/ground_truth.h"
#include "spec/formats/options.h"

namespace throng::formats {

/// x, y, width and height in box coordinates: pixel i covers [i, i + 1).
struct Box {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
};

/// One of COCO's keypoints: box coordinates and COCO's visibility (0, 1, 2).
struct Keypoint {
  double x = 0;
  double y = 0;
  int visibility = 0;
};

/// Somebody in an image, another drone or a vehicle; docs/formats.md says what the values mean.
struct Person {
  nlohmann::json record;  ///< the annotation as it stands in the COCO file
  /// That of `tracks`: what stays the same all run long. Empty if it has none; never null.
  std::shared_ptr<const nlohmann::json> track;
  std::int64_t id = 0;
  std::int64_t track_id = 0;
  Box box;           ///< of the visible mask
  Box amodal;        ///< of the whole body
  std::string mask;  ///< COCO's compressed run lengths
  double area = 0;   ///< visible pixels
  double visibility = 0;
  double truncation = 0;
  std::optional<Eigen::Vector2d> head;    ///< box coordinates
  std::optional<Box> head_box;            ///< none without `heads`, or where the camera sees none
  std::optional<double> head_visibility;  ///< the same
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the ground
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double heading_rad = 0;
  Eigen::Vector3d box_middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();
  std::string state;
  std::vector<Keypoint> keypoints;  ///< 17, or none if the dataset has none
  std::size_t category = 0;         ///< index into DatasetInfo::class_names()
  /// What track_id says of the person within its run, from 1: also in images of instances.
  std::int64_t number_in_run() const { return track_id % annotate::kTrackIdsPerRun; }
  bool is_ignored = false;  ///< fails the filters: to be written as an ignore region
};

/// Somebody in the camera's view of whom nothing is visible.
struct HiddenPerson {
  std::int64_t track_id = 0;
  Box amodal;
  std::int64_t number_in_run() const { return track_id % annotate::kTrackIdsPerRun; }
  bool is_ignored = false;
};

struct Image {
  nlohmann::json record;
  std::int64_t id = 0;
  std::string file;  ///< below the dataset's root
  int width = 0;
  int height = 0;
  std::string run;
  std::string camera;
  std::int64_t frame = 0;  ///< from 0 in each run
  double time_s = 0;
  Split split = Split::train;
  std::vector<Person> people;
  std::vector<Person> objects;  ///< drones and vehicles: what people have in common with them
  std::vector<HiddenPerson> hidden;
  Eigen::Matrix3d camera_matrix = Eigen::Matrix3d::Identity();  ///< OpenCV's pixels
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();              ///< world to camera
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  /// "run000-d1": one camera's images of one run, in order.
  std::string sequence() const { return run + "-" + camera; }
  /// "run000-d1-000012": unique over the dataset, fit for a file's name.
  std::string stem() const;
  /// Id of the run's scenario, in a dataset of several; else "".
  std::string scenario() const;
};

struct DatasetInfo {
  std::filesystem::path root;
  std::string name;
  std::string generator;
  std::uint64_t seed = 0;  ///< of the job
  double rate_hz = 1;
  double from_s = 0;  ///< time of the first frame
  double density_sigma_px = 4;
  std::vector<double> field_cells_m;  ///< of the grids of fields beside the usual one
  nlohmann::json count_areas = nlohmann::json::object();  ///< the job's outputs.counts
  std::string scenario;                                   ///< its id; "" of a dataset of several
  std::int64_t frames_per_camera = 0;
  std::vector<std::string> runs;
  std::vector<std::string> annotations;  ///< kinds of ground truth that the dataset has
  std::vector<std::string> formats;      ///< that it has below formats/
  std::vector<std::string> categories;   ///< names of people's classes to write
  /// Those of drones, if they may see each other, and vehicles, if the dataset has them: classes
  /// after people's.
  std::vector<annotate::ObjectCategory> object_categories;
  ExportOptions options;

  bool has(annotate::GroundTruth kind) const;
  /// People's classes, then those of objects.
  std::vector<std::string> class_names() const;
  /// Drone, car or train, of one of an image's objects.
  world::SemanticClass surface_material(const Person& object) const;
  /// The splits that have runs.
  std::vector<Split> splits() const;
  Split split_of(const std::string& run) const;
};

/// The image's record with `annotations`, its people's and objects' records with what their tracks
/// say, in which `category` names their class and `ignored` is true of who fails the filters:
/// everything about an image in one object.
nlohmann::json webdataset_sample(const Image& image, const DatasetInfo& info);

/// The splits, filters and classes that the dataset's other formats were written with.
ExportOptions export_options(const nlohmann::json& manifest);

/// Describes a dataset by its manifest. Throws InputError when it has no COCO annotations, or when
/// the options name runs that it does not have.
DatasetInfo describe_dataset(const std::filesystem::path& root, const nlohmann::json& manifest,
                             const ExportOptions& options);

/// Reads manifest.json. Throws InputError when `root` is not a finished dataset.
nlohmann::json read_manifest(const std::filesystem::path& root);

/// The error to throw where reading a value of the manifest threw `error`.
InputError bad_manifest(const std::filesystem::path& root, const nlohmann::json::exception& error);

/// Path of a dataset's COCO file, below its root.
inline constexpr const char* kCocoFile = "annotations/instances.json";

class DatasetReader {
 public:
  /// Throws InputError when the COCO file is not one that throng wrote.
  explicit DatasetReader(const DatasetInfo& info);
  ~DatasetReader();
  DatasetReader(const DatasetReader&) = delete;
  DatasetReader& operator=(const DatasetReader&) = delete;

  /// The next image, in the file's order: by run, frame, camera. False after the last. Throws
  /// InputError naming file and line of a damaged record, or one whose image is not there.
  bool next(Image& image);

 private:
  class Lines;
  class Tracks;
  const DatasetInfo* info_;
  std::unique_ptr<Tracks> tracks_;
  std::unique_ptr<Lines> images_;
  std::unique_ptr<Lines> annotations_;
  nlohmann::json waiting_;  ///< the annotation after those of the last image; null: none
};

}  // namespace throng::formats
