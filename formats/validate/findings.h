// Collects the findings of a dataset's checks.
#pragma once

#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "camera/camera.h"
#include "formats/dataset/dataset.h"
#include "formats/dataset/image_camera.h"
#include "formats/files/npy.h"
#include "formats/validate/finding.h"

namespace throng::formats {

class Findings {
 public:
  explicit Findings(Validation& validation) : validation_(&validation) {}

  void add(std::string rule, std::string file, std::string record, std::string what) {
    if (validation_->found++ >= kMaxFindings) return;
    validation_->findings.push_back(
        {std::move(rule), std::move(file), std::move(record), std::move(what)});
  }
  /// About an annotation of the COCO file.
  void add(std::string rule, const Person& person, std::string what) {
    add(std::move(rule), kCocoFile, "annotation " + std::to_string(person.id), std::move(what));
  }

 private:
  Validation* validation_;
};

/// People, drones and vehicles.
inline std::vector<Person> list_objects(const Image& image) {
  std::vector<Person> objects = image.people;
  objects.insert(objects.end(), image.objects.begin(), image.objects.end());
  return objects;
}

/// The value of a person, drone or vehicle in images of instances.
std::uint32_t instance_id(const Person& object);

/// One image's annotations by themselves: boxes, masks, visibility, keypoints.
void check_people(const Image& image, Findings& findings);

/// Positions of an image's people in the world, against their boxes.
void check_bodies(const Image& image, Findings& findings);

/// Everything below formats/, dataset.json and README.md, made again from the annotations and
/// compared byte by byte; of a dataset that this version of the program wrote.
void check_exports(const DatasetInfo& info, const nlohmann::json& manifest, Findings& findings);

/// Names and numbers of the COCO file's categories.
void check_categories(const DatasetInfo& info, Findings& findings);

/// R is a rotation, and the center is where R and t put it.
void check_camera(const Image& image, Findings& findings);

/// The run's calibration files against the image's lens.
void check_camera_files(const DatasetInfo& info, const Image& image, Findings& findings);

/// A density map against the heads of the records.
void check_density_is_heads(const Image& image, const std::string& path, const FloatMap& map,
                            double sigma_px, Findings& findings);

/// Depth where the ground shows against where the plane z = 0 is; of a plain image.
void check_ground_depth(const Image& image, const std::string& path,
                        const std::vector<std::uint32_t>& ids,
                        const std::vector<std::uint16_t>& centimeters, Findings& findings);

/// Boxes, tracks and ignored people in other formats' texts below formats/, as far as they have
/// them as lines of numbers: YOLO, MOT and VisDrone.
class FormatCheck {
 public:
  void add(const DatasetInfo& info, const Image& image, Findings& findings);
  void finish(Findings& findings);

 private:
  /// The first numbers of a format's lines of an image.
  static std::vector<std::vector<double>> label_values(const DatasetInfo& info,
                                                       const std::string& format,
                                                       const Image& image);
  static void compare(const std::string& file, const Image& image, std::istream& text,
                      const std::vector<std::vector<double>>& expected, Findings& findings);
  static void check_yolo(const DatasetInfo& info, const Image& image,
                         const std::filesystem::path& folder, bool with_drones, Findings& findings);

  std::map<std::string, std::ifstream> texts_;  ///< of sequences, read as far as their images
};

/// The corners of a person's upright box, m, in the camera's axes; 1 cm farther out than recorded,
/// since that is rounded.
Eigen::Matrix<double, 3, 8> corners_in_camera(const Image& image, const Person& person);

/// Whether the file alone says where objects appear: without a lens's distortion or a rolling
/// shutter.
bool is_plain(const Image& image);

/// Whether all rows show the same instant.
bool is_shot_at_once(const Image& image);

}  // namespace throng::formats
