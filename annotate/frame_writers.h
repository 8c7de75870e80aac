// Table of the kinds of ground truth that write files or members of the COCO record per frame.
// jobs/pipeline/frames/run_writers.h has those that write per run.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/exits/exit_view.h"
#include "annotate/people/actions.h"
#include "annotate/people/coco.h"
#include "annotate/people/hazard_view.h"
#include "annotate/people/labels.h"
#include "render/frame/frame.h"
#include "spec/annotate/count_areas.h"
#include "spec/annotate/ground_truth.h"

namespace throng::annotate {

/// A frame, its labels, and the destination of its files.
struct FrameOutput {
  const render::Frame& frame;
  FrameLabels& labels;
  /// The file of the image. Difficulty is measured on it, because users have no other image.
  std::string_view jpeg;
  CocoImage& record;  ///< its run, camera and frame name the files; written after all kinds
  const ExitView* exits = nullptr;                ///< null if records have no exits
  const ActionFacts* actions = nullptr;           ///< null if records have no actions
  const HazardView* hazards = nullptr;            ///< at the frame's time; null without hazards
  const std::vector<CountZone>* zones = nullptr;  ///< counting zones; null without zones
  double density_sigma_px = 0;                    ///< kernel width of the density map
  /// Adds a file of the dataset.
  std::function<void(const std::string& path, std::string_view bytes)> add;
  /// Assigns the time since the last call to a stage (base/compute/stage_clock.h).
  std::function<void(std::string_view stage)> lap;

  /// Path in the dataset of the frame's file of a kind.
  std::string ground_truth_file(GroundTruth kind) const;
};

/// A row of the table: the function that writes a kind.
struct FrameWriter {
  GroundTruth kind{};
  void (*write)(FrameOutput& output) = nullptr;
};

/// The table, in the order of the kinds; other kinds write nothing per frame.
std::span<const FrameWriter> frame_writers();

}  // namespace throng::annotate
