// Motion blur (motion while the shutter is open) and rolling shutter (motion while the rows are
// read one after the other).
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "render/frame/frame.h"
#include "render/lens/lens.h"
#include "spec/camera/camera_spec.h"

namespace throng::render {

/// The world and the camera at one time.
struct ShutterMoment {
  std::shared_ptr<const Scene> scene;
  camera::Camera camera;
};
using MomentAt = std::function<ShutterMoment(double time_s)>;

/// Times (s) of the neighboring frames of a camera, for optical flow.
struct NeighborTimes {
  std::optional<double> next_s = std::nullopt;
  std::optional<double> previous_s = std::nullopt;
};

/// A frame and the data of its exposure.
struct Exposed {
  Frame frame;
  int samples = 1;             ///< number of moments over which each row's light is averaged
  int strips = 1;              ///< number of strips of rows that were rendered at different times
  double blur_px = 0;          ///< max motion in the image during the exposure
  double gain = 1;             ///< gain of all light
  double illuminance_lux = 0;  ///< on horizontal ground under open sky
};

/// Max motion in the image (px) between two moments: of the ground (z = 0) due to the camera's
/// motion, and of people.
double image_motion_px(const ShutterMoment& from, const ShutterMoment& to);

/// Renders a frame with as many moments as its motion requires: one if nothing moves by a quarter
/// of a pixel, else one per pixel of blur up to 15; in strips of rows during whose readout nothing
/// moves by more than half a pixel, 32 at most. Colors are averaged in linear light. Ids, depth,
/// boxes and areas are those of the middle of each strip's exposure; a person's box is the union
/// over the strips, the position is that of the strip with the largest part of the person. The
/// frame's camera and people's actions are those at `time_s`.
///
/// `neighbors` has the times of the next and the previous frame if flow is requested; flow leads
/// from each row's time by the same interval. The gain is that of the camera's metering at `time_s`
/// (render/scenery/metering.h), or 1 if `is_metered` is false.
Exposed expose(Lens& lens, const MomentAt& moment_at, double time_s,
               const camera::Exposure& exposure, const NeighborTimes& neighbors = {},
               bool is_metered = false);

/// Gives `frame` the odd rows' colors of the other field, a frame of the same size.
void interlace(const Frame& field, Frame& frame);

}  // namespace throng::render
