// Reader for finished datasets: images with their annotations, one by one, as input of all
// exporters. Memory does not grow with the number of images.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "annotate/people/coco.h"
#include "base/error.h"
#include "spec/annotate/ground_truth.h"
#include "spec/formats/options.h"
#include "spec/sim/sensor_noise.h"

namespace throng::formats {

/// A rectangle in box coordinates: pixel i covers [i, i + 1).
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

/// A person, vehicle or other drone in an image; docs/formats.md defines the values.
struct Person {
  nlohmann::json record;  ///< the annotation in the COCO file
  /// The entry of `tracks`, constant during the run; an empty object if there is none, never null.
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
  std::optional<Box> head_box;            ///< none without `heads`, or if no surface is in view
  std::optional<double> head_visibility;  ///< none in the same cases
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the ground
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();
  double heading_rad = 0;
  Eigen::Vector3d box_middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d box_size = Eigen::Vector3d::Zero();
  std::string state;
  std::vector<Keypoint> keypoints;  ///< 17, or none if the dataset has no keypoints
  std::size_t category = 0;         ///< index into DatasetInfo::class_names()
  /// Number of the person within the run, from 1, as in images of instances.
  std::int64_t number_in_run() const { return track_id % annotate::kTrackIdsPerRun; }
  bool is_ignored = false;  ///< fails the filters; to be written as an ignore region
};

/// A person in the camera's view without a visible pixel.
struct HiddenPerson {
  std::int64_t track_id = 0;
  Box amodal;
  std::int64_t number_in_run() const { return track_id % annotate::kTrackIdsPerRun; }
  bool is_ignored = false;
};

/// An image with its labels.
struct Image {
  nlohmann::json record;  ///< the image's record in the COCO file
  std::int64_t id = 0;
  std::string file;  ///< path relative to the dataset's root
  int width = 0;
  int height = 0;
  std::string run;
  std::string camera;
  std::int64_t frame = 0;  ///< from 0 in each run
  double time_s = 0;
  Split split = Split::train;
  std::vector<Person> people;
  std::vector<Person> objects;  ///< drones and vehicles; members of people only are unset
  std::vector<HiddenPerson> hidden;
  Eigen::Matrix3d camera_matrix = Eigen::Matrix3d::Identity();  ///< OpenCV's pixels
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();              ///< world to camera
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  /// Name of the sequence of one camera's images in one run: "run000-d1".
  std::string sequence() const { return run + "-" + camera; }
  /// A name that is unique in the dataset and valid for files: "run000-d1-000012".
  std::string stem() const;
  /// Id of the run's scenario in a dataset of several scenarios; else "".
  std::string scenario() const;
};

/// Properties of a dataset and options of an export.
struct DatasetInfo {
  std::filesystem::path root;
  std::string name;
  std::string generator;
  std::uint64_t seed = 0;  ///< of the job
  double rate_hz = 1;
  double from_s = 0;  ///< time of the first frame
  double density_sigma_px = 4;
  std::vector<double> field_cells_m;  ///< additional cell sizes of ground fields
  nlohmann::json count_areas = nlohmann::json::object();  ///< the job's outputs.counts
  std::string scenario;                                   ///< its id; "" for several scenarios
  /// Errors of the drones' sensors, by drone; those of datasets that were merged may be unknown.
  std::map<std::string, sim::SensorNoise> sensor_noise;
  std::int64_t frames_per_camera = 0;
  bool has_images = true;  ///< false: of a job without drones
  std::vector<std::string> runs;
  std::vector<std::string> annotations;  ///< kinds of ground truth that the dataset has
  std::vector<std::string> formats;      ///< exports below formats/
  std::vector<std::string> categories;   ///< names of people's classes to write
  /// Classes of drones in view and vehicles, if the dataset has them; they follow people's classes.
  std::vector<annotate::ObjectCategory> object_categories;
  ExportOptions options;

  bool has(annotate::GroundTruth kind) const;
  /// Names of people's classes, then of objects' classes.
  std::vector<std::string> class_names() const;
  /// The class of one of an image's objects: drone, car or train.
  world::SemanticClass surface_material(const Person& object) const;
  /// The splits that have runs.
  std::vector<Split> splits() const;
  Split split_of(const std::string& run) const;
};

/// All data of an image in one JSON object: its record, and in `annotations` the records of its
/// people and objects, merged with their tracks, with the class's name as `category` and `ignored`
/// for those that fail the filters.
nlohmann::json webdataset_sample(const Image& image, const DatasetInfo& info);

/// The splits, filters and classes of the dataset's job, with which its own formats were written.
/// Throws InputError naming `root` if the manifest is damaged.
ExportOptions export_options(const std::filesystem::path& root, const nlohmann::json& manifest);

/// Describes a dataset from its manifest. Runs that the options name and it does not have (a job's
/// runs may have failed) are ignored.
DatasetInfo describe_dataset(const std::filesystem::path& root, const nlohmann::json& manifest,
                             const ExportOptions& options);

/// Throws InputError if a dataset has images without COCO annotations.
void check_images_have_labels(const DatasetInfo& info);

/// Reads manifest.json. From then on, this process follows no links below `root`. Throws InputError
/// if `root` is not a finished dataset, contains a link, or names of files, runs or drones lead out
/// of it.
nlohmann::json read_manifest(const std::filesystem::path& root);

/// The error to throw if a value of the manifest could not be read because of `error`.
InputError bad_manifest(const std::filesystem::path& root, const nlohmann::json::exception& error);

/// Path of a dataset's COCO file, relative to its root.
inline constexpr const char* kCocoFile = "annotations/instances.json";

/// Reads the COCO file record by record. `info` must outlive it.
class DatasetReader {
 public:
  /// Throws InputError if the COCO file was not written by throng.
  explicit DatasetReader(const DatasetInfo& info);
  ~DatasetReader();
  DatasetReader(const DatasetReader&) = delete;
  DatasetReader& operator=(const DatasetReader&) = delete;

  /// Reads the next image in the file's order (run, frame, camera); returns false after the last
  /// one. Throws InputError that names file and line of a damaged record or a record of a missing
  /// image.
  bool next(Image& image);

 private:
  class Lines;
  class Tracks;
  /// They become paths of what is read and written.
  void check_names_of(const Image& image) const;
  const DatasetInfo* info_;
  std::unique_ptr<Tracks> tracks_;
  std::unique_ptr<Lines> images_;
  std::unique_ptr<Lines> annotations_;
  nlohmann::json waiting_;  ///< first annotation of the next image; null if there is none
};

}  // namespace throng::formats
