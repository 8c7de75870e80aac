// Table of the checks of `throng validate` for each kind of ground truth. Checks of the COCO
// records, and comparisons of kinds or images, are in checks/shot.h and
// checks/findings.h.
#pragma once

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "checks/findings.h"
#include "checks/pixels.h"
#include "formats/dataset/dataset.h"
#include "spec/annotate/ground_truth.h"

namespace throng::checks {

/// Checks one kind of ground truth of a dataset, image by image in the order of the COCO file.
class GroundTruthCheck {
 public:
  GroundTruthCheck() = default;
  virtual ~GroundTruthCheck() = default;
  GroundTruthCheck(const GroundTruthCheck&) = delete;
  GroundTruthCheck& operator=(const GroundTruthCheck&) = delete;
  /// Called for every image.
  virtual void add(const formats::DatasetInfo& /*info*/, const formats::Image& /*image*/,
                   Findings& /*findings*/) {}
  /// Called after add() for every image whose records have no findings.
  virtual void add_pixels(const formats::DatasetInfo& /*info*/, const formats::Image& /*image*/,
                          const Pixels& /*pixels*/, Findings& /*findings*/) {}
  /// Called after the last image.
  virtual void finish(const formats::DatasetInfo& /*info*/, Findings& /*findings*/) {}
};

/// A row of the table: the factory of a kind's check.
struct GroundTruthChecker {
  annotate::GroundTruth kind{};
  std::unique_ptr<GroundTruthCheck> (*make)() = nullptr;
};

/// The table, in the order of the kinds. The other kinds are part of the COCO records.
std::span<const GroundTruthChecker> ground_truth_checkers();

/// Runs the checks of all kinds that a dataset has, and checks that their files exist.
class GroundTruthChecks {
 public:
  explicit GroundTruthChecks(const formats::DatasetInfo& info);
  void add(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings);
  void add_pixels(const formats::DatasetInfo& info, const formats::Image& image,
                  const Pixels& pixels, Findings& findings);
  void finish(const formats::DatasetInfo& info, Findings& findings);

 private:
  std::vector<std::unique_ptr<GroundTruthCheck>> checks_;
  std::set<std::string> files_;  ///< files of runs that were checked for existence
};

// Checks of one kind's values per pixel, for the table.
void check_density(const formats::DatasetInfo& info, const formats::Image& image,
                   const Pixels& pixels, Findings& findings);
/// Compares masks with the image of instances, pixel by pixel.
void check_instances(const formats::DatasetInfo& info, const formats::Image& image,
                     const Pixels& pixels, Findings& findings);
/// Compares depth with the positions of people within their masks, and with the ground.
void check_depth(const formats::DatasetInfo& info, const formats::Image& image,
                 const Pixels& pixels, Findings& findings);
/// Checks that body parts are on people.
void check_parts(const formats::DatasetInfo& info, const formats::Image& image,
                 const Pixels& pixels, Findings& findings);
/// Checks that normals have length 1.
void check_normal_lengths(const formats::DatasetInfo& info, const formats::Image& image,
                          const Pixels& pixels, Findings& findings);
/// Checks that flow is either known or all 0.
void check_flow_values(const formats::DatasetInfo& info, const formats::Image& image,
                       const Pixels& pixels, Findings& findings);
void check_flow_occlusion_values(const formats::DatasetInfo& info, const formats::Image& image,
                                 const Pixels& pixels, Findings& findings);
void check_scene_flow_values(const formats::DatasetInfo& info, const formats::Image& image,
                             const Pixels& pixels, Findings& findings);
/// Compares semantic classes with masks and instances.
void check_semantic(const formats::DatasetInfo& info, const formats::Image& image,
                    const Pixels& pixels, Findings& findings);

}  // namespace throng::checks
