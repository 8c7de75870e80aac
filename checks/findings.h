// Collection of findings, and checks of single images.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "camera/camera.h"
#include "checks/finding.h"
#include "formats/dataset/dataset.h"
#include "formats/dataset/image_camera.h"
#include "formats/files/npy.h"

namespace throng::checks {

/// Adds findings to a validation, at most kMaxFindings; further ones are only counted.
class Findings {
 public:
  explicit Findings(Validation& validation) : validation_(&validation) {}

  void add(std::string rule, std::string file, std::string record, std::string what) {
    if (validation_->found++ >= kMaxFindings) return;
    validation_->findings.push_back(
        {std::move(rule), std::move(file), std::move(record), std::move(what)});
  }
  /// Adds a finding about an annotation of the COCO file.
  void add(std::string rule, const formats::Person& person, std::string what) {
    add(std::move(rule), formats::kCocoFile, "annotation " + std::to_string(person.id),
        std::move(what));
  }

 private:
  Validation* validation_;
};

/// People, drones and vehicles of an image.
inline std::vector<formats::Person> list_objects(const formats::Image& image) {
  std::vector<formats::Person> objects = image.people;
  objects.insert(objects.end(), image.objects.begin(), image.objects.end());
  return objects;
}

/// The value of a person, drone or vehicle in images of instances.
std::uint32_t instance_id(const formats::Person& object);

/// Checks each annotation of an image by itself: boxes, masks, visibility, keypoints.
void check_people(const formats::Image& image, Findings& findings);

/// Compares the positions of an image's people in the world with their boxes.
void check_bodies(const formats::Image& image, Findings& findings);

/// Recreates all files below formats/, dataset.json and README.md from the annotations and compares
/// them byte by byte, for datasets written by this version of the program.
void check_exports(const formats::DatasetInfo& info, const nlohmann::json& manifest,
                   Findings& findings);

/// The version of the definitions by which the COCO file was labeled; 0 if it does not say.
int label_version(const formats::DatasetInfo& info);

/// Checks names and ids of the COCO file's categories.
void check_categories(const formats::DatasetInfo& info, Findings& findings);

/// Checks that R is a rotation and that the camera's center agrees with R and t.
void check_camera(const formats::Image& image, Findings& findings);

/// Compares the run's calibration files with the image's lens.
void check_camera_files(const formats::DatasetInfo& info, const formats::Image& image,
                        Findings& findings);

/// Compares a density map with the heads of the records.
void check_density_is_heads(const formats::Image& image, const std::string& path,
                            const formats::FloatMap& map, double sigma_px, Findings& findings);

/// Compares the depth of ground pixels with the plane z = 0, in an image for which is_plain()
/// holds.
void check_ground_depth(const formats::Image& image, const std::string& path,
                        const std::vector<std::uint32_t>& ids,
                        const std::vector<std::uint16_t>& centimeters, Findings& findings);

/// Checks boxes, tracks and ignore regions in the exports YOLO, MOT and VisDrone, which consist of
/// lines of numbers.
class FormatCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings);
  void finish(Findings& findings);

 private:
  /// The first numbers of a format's lines of an image.
  static std::vector<std::vector<double>> label_values(const formats::DatasetInfo& info,
                                                       const std::string& format,
                                                       const formats::Image& image);
  static void compare(const std::string& file, const formats::Image& image, std::istream& text,
                      const std::vector<std::vector<double>>& expected, Findings& findings);
  static void check_yolo(const formats::DatasetInfo& info, const formats::Image& image,
                         const std::filesystem::path& folder, bool with_drones, Findings& findings);

  std::map<std::string, std::ifstream> texts_;  ///< by sequence, read up to the current image
};

/// The corners of a person's upright box in the camera frame (m), enlarged by 1 cm because the
/// recorded box is rounded.
Eigen::Matrix<double, 3, 8> corners_in_camera(const formats::Image& image,
                                              const formats::Person& person);

/// Whether the image has neither lens distortion nor a rolling shutter, so that K, R and t
/// determine all projections.
bool is_plain(const formats::Image& image);

/// Whether the lens does not distort.
bool is_pinhole(const formats::Image& image);

/// Whether all rows were exposed at the same time.
bool is_shot_at_once(const formats::Image& image);

/// Max distance (px) between where rows of a rolling shutter show a body and where the camera of
/// the image's time sees it; 0 without a rolling shutter, nothing if the image does not tell.
std::optional<double> shutter_slack_px(const formats::Image& image);

}  // namespace throng::checks
