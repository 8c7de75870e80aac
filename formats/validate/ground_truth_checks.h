// The checks of `throng validate` for each kind of ground truth: one table. Checks of the COCO
// records, and of several kinds or images against each other, are in formats/validate/shot.h and
// formats/validate/findings.h.
#pragma once

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "formats/dataset/dataset.h"
#include "formats/validate/findings.h"
#include "formats/validate/pixels.h"
#include "spec/annotate/ground_truth.h"

namespace throng::formats {

/// Checks one kind of ground truth of one dataset, image by image in the order of the COCO file.
class GroundTruthCheck {
 public:
  GroundTruthCheck() = default;
  virtual ~GroundTruthCheck() = default;
  GroundTruthCheck(const GroundTruthCheck&) = delete;
  GroundTruthCheck& operator=(const GroundTruthCheck&) = delete;
  /// Every image.
  virtual void add(const DatasetInfo& /*info*/, const Image& /*image*/, Findings& /*findings*/) {}
  /// Every image whose records have no faults, after add().
  virtual void add_pixels(const DatasetInfo& /*info*/, const Image& /*image*/,
                          const Pixels& /*pixels*/, Findings& /*findings*/) {}
  virtual void finish(const DatasetInfo& /*info*/, Findings& /*findings*/) {}
};

struct GroundTruthChecker {
  annotate::GroundTruth kind{};
  std::unique_ptr<GroundTruthCheck> (*make)() = nullptr;
};

/// In the order of the kinds. Kinds that are not here are part of the COCO records.
std::span<const GroundTruthChecker> ground_truth_checkers();

/// The checks of all kinds that a dataset has, and whether their files are there.
class GroundTruthChecks {
 public:
  explicit GroundTruthChecks(const DatasetInfo& info);
  void add(const DatasetInfo& info, const Image& image, Findings& findings);
  void add_pixels(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                  Findings& findings);
  void finish(const DatasetInfo& info, Findings& findings);

 private:
  std::vector<std::unique_ptr<GroundTruthCheck>> checks_;
  std::set<std::string> files_;  ///< of runs, that were looked for
};

// Checks of one kind's values per pixel, for the table.
void check_density(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                   Findings& findings);
/// Masks against the image of instances, pixel by pixel.
void check_instances(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                     Findings& findings);
/// Depth inside the masks against where the people are, and that of the ground.
void check_depth(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                 Findings& findings);
/// Parts are where people are.
void check_parts(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                 Findings& findings);
/// Normals have length 1.
void check_normal_lengths(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                          Findings& findings);
/// Flow is known or all 0.
void check_flow_values(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                       Findings& findings);
void check_flow_occlusion_values(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                                 Findings& findings);
void check_scene_flow_values(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                             Findings& findings);
/// Classes are those of the masks and of the instances.
void check_semantic(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                    Findings& findings);

}  // namespace throng::formats
