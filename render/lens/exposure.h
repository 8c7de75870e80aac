// Effects of time on an image: the world and the camera move while the shutter is open (motion
// blur) and while the rows are read one after the other (rolling shutter).
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "render/frame.h"
#include "render/lens/lens.h"
#include "spec/camera/camera_spec.h"

namespace throng::render {

/// The world and the camera at one time.
struct ShutterMoment {
  std::shared_ptr<const Scene> scene;
  camera::Camera camera;
};
using MomentAt = std::function<ShutterMoment(double time_s)>;

/// When a camera's other frames are taken that flow leads to (s).
struct NeighborTimes {
  std::optional<double> next_s = std::nullopt;
  std::optional<double> previous_s = std::nullopt;
};

/// How a frame was exposed.
struct Exposed {
  Frame frame;
  int samples = 1;             ///< moments that each row's light is averaged over
  int strips = 1;              ///< strips of rows that were each rendered at a time of their own
  double blur_px = 0;          ///< max motion in the image during the exposure
  double gain = 1;             ///< of all light
  double illuminance_lux = 0;  ///< on level ground in the open
};

/// How far (px) what is seen moves at most between two moments: the ground (z = 0), by the
/// camera's motion, and people, by theirs as well.
double image_motion_px(const ShutterMoment& from, const ShutterMoment& to);

/// Renders as many moments as the motion needs: one when nothing moves by a quarter of a pixel,
/// else one per pixel of blur up to 15, and strips in which the reading moves nothing by more than
/// half a pixel, 32 at most. Colors are averaged in linear light. Ids, depth, boxes and areas are
/// those of the middle of each strip's exposure; a person's box is the union over the strips of
/// what shows in each, their position that of the strip where most of them is. The frame's camera
/// is the one at `time_s`.
///
/// `neighbors` says when the next and the previous frame are taken, if flow is wanted: flow goes
/// from each row's time to as long after or before it. The gain of all light is that of the
/// camera's metering at `time_s` (render/lens/metering.h), or 1 if the image is not metered.
Exposed expose(Lens& lens, const MomentAt& moment_at, double time_s,
               const camera::Exposure& exposure, const NeighborTimes& neighbors = {},
               bool is_metered = false);

}  // namespace throng::render
