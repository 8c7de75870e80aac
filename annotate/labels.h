// Labels of the visible people in one frame, from its id buffer: boxes, masks, visibility.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "render/frame.h"

namespace throng::annotate {

/// Integer pixel bounds: covers [x, x + width) x [y, y + height).
struct PixelBox {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Runs of a mask in COCO's order: down the columns, first run counts zeros.
using RunLengths = std::vector<std::uint32_t>;

/// One of COCO's keypoints in the image.
struct Keypoint {
  double x = 0;  ///< box coordinates, rounded to kPixelDecimals; 0 when not labeled
  double y = 0;
  /// COCO's: 0 not labeled (outside the image), 1 hidden, by others or by the own body, 2 visible.
  int visibility = 0;
};

struct PersonLabel {
  std::uint32_t agent = 0;
  PixelBox box;               ///< tight bounds of the visible mask
  RunLengths mask;            ///< visible mask
  std::uint64_t area_px = 0;  ///< visible pixels
  double visibility = 0;      ///< area_px / amodal area, in (0, 1]
  /// Amodal box, 3-D position, ...; its amodal area is raised to area_px if below.
  render::PersonInView person;
  std::vector<Keypoint> keypoints;  ///< as skinning::kKeypointNames; empty unless asked for
};

/// Somebody in view of whom no pixel is visible.
struct HiddenPerson {
  std::uint32_t agent = 0;
  Eigen::AlignedBox2d amodal_box;  ///< box coordinates; reaches into the image
};

/// Another drone in the image.
struct DroneLabel {
  PixelBox box;               ///< tight bounds of the visible mask
  RunLengths mask;            ///< visible mask
  std::uint64_t area_px = 0;  ///< visible pixels
  double visibility = 0;      ///< area_px / amodal area, in (0, 1]
  render::DroneInView drone;
};

struct FrameLabels {
  std::int64_t frame_index = 0;
  double time_s = 0;
  std::vector<PersonLabel> people;   ///< visible ones (at least one pixel), by agent id
  std::vector<HiddenPerson> hidden;  ///< the others whose amodal box reaches into the image
  std::vector<DroneLabel> drones;    ///< other drones, as far as a pixel shows them
};

/// One pass over the id buffer. Everybody who shows there must be in Frame::people (else check()).
FrameLabels label_people(const render::Frame& frame);

/// A mask's runs in COCO's order in an image of this size, which it lies in.
RunLengths run_lengths(const render::PixelMask& mask, int width, int height);

/// COCO's compressed counts string (see docs/formats.md).
std::string coco_counts(const RunLengths& runs);

}  // namespace throng::annotate
