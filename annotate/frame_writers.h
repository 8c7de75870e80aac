// Contributions of each kind of ground truth to a frame's output: files, or values of its COCO
// record. One table; those to a whole run's output are written by
// jobs/pipeline/frames/run_writers.h.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/people/actions.h"
#include "annotate/people/coco.h"
#include "annotate/people/exit_view.h"
#include "annotate/people/hazard_view.h"
#include "annotate/people/labels.h"
#include "render/frame.h"
#include "spec/annotate/count_areas.h"
#include "spec/annotate/ground_truth.h"

namespace throng::annotate {

/// A frame on its way into the dataset.
struct FrameOutput {
  const render::Frame& frame;
  FrameLabels& labels;
  CocoImage& record;  ///< run, camera and frame name the files; written after all kinds
  const ExitView* exits = nullptr;       ///< null where the records hold no exits
  const ActionFacts* actions = nullptr;  ///< null where the records hold none
  const HazardView* hazards = nullptr;   ///< at the frame's time; null where there are none
  const std::vector<CountZone>* zones = nullptr;  ///< to count people in; null where none are
  double density_sigma_px = 0;
  /// Adds a file of the dataset.
  std::function<void(const std::string& path, std::string_view bytes)> add;
  /// Assigns the time since the last call to a stage (base/compute/stage_clock.h).
  std::function<void(std::string_view stage)> lap;

  /// The frame's file of a kind.
  std::string ground_truth_file(GroundTruth kind) const;
};

struct FrameWriter {
  GroundTruth kind{};
  void (*write)(FrameOutput& output) = nullptr;
};

/// In the order of the kinds. Kinds that are not here have no part of their own in a frame.
std::span<const FrameWriter> frame_writers();

}  // namespace throng::annotate
