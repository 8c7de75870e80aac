// Renders a scenario and its people with OpenGL through EGL, without a window.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/compute/stage_clock.h"
#include "camera/camera.h"
#include "render/frame.h"
#include "render/pixel_weights.h"
#include "render/props/vehicles.h"
#include "render/scene.h"
#include "skinning/population.h"
#include "spec/render/environment.h"
#include "spec/render/quality.h"
#include "world/scenario.h"

namespace throng::render {

struct SkinPoint;

/// The GL device for rendering: "auto" (an NVIDIA GPU if there is one, else software), "gpu",
/// "software".
struct DeviceChoice {
  std::string name = "auto";
};

/// The largest width and height of an image that the device renders, at each sample of color. Makes
/// a context: expensive. Throws EnvironmentError when it cannot.
int max_image_px(const DeviceChoice& device = {});

/// Ground truth to render beside the scene itself.
struct RenderOptions {
  Quality quality = Quality::standard;
  bool normals = false;         ///< fill Frame::normal
  bool flow = false;            ///< fill Frame::flow
  bool flow_backward = false;   ///< fill Frame::flow_backward
  bool flow_depth = false;      ///< with flow: fill Frame::flow_depth_m
  bool scene_flow = false;      ///< with flow_depth: fill Frame::scene_flow_m
  bool parts = false;           ///< fill Frame::part
  bool hazard_opacity = false;  ///< fill Frame::hazard_opacity
  bool semantic = false;        ///< fill Frame::surface
  bool whole_masks = false;     ///< fill PersonInView::whole_mask
  bool vehicles = false;        ///< have vehicles among Frame::objects
  /// How edges are smoothed: by several samples a pixel, or afterwards. Nothing: as QualitySettings
  /// determines, so this is for tests and comparisons.
  std::optional<bool> multisample = std::nullopt;
  /// Receives the profile, if given; rendering is then waited for at the end of every stage.
  StageClock* clock = nullptr;
};

/// Options of a draw.
struct DrawChoice {
  const PixelWeights* weights = nullptr;  ///< what people's areas are counted in; nothing: pixels
  bool truth = true;  ///< else people's areas are 0 and there are no normals, flow or parts
  const NeighborFrame* previous = nullptr;  ///< serves the backward flow only
  double exposure_gain = 1;                 ///< all light on the film is multiplied by it
};

/// Owns a GL context, and the scenario's and population's buffers in it. Use from one thread.
/// The scenario and population must outlive it.
class Renderer {
 public:
  /// Throws EnvironmentError naming the missing libraries or driver when no context can be made.
  Renderer(const world::Scenario& scenario, const skinning::Population& population,
           const Environment& environment = {}, const DeviceChoice& device = {},
           const RenderOptions& options = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Color, id, depth and the people's ground truth, all from one draw of one instant. The camera
  /// is a pinhole; Lens (render/lens/lens.h) renders all cameras. `next` serves the flow only.
  Frame draw(const Scene& scene, const camera::Camera& camera, const NeighborFrame* next = nullptr,
             const DrawChoice& choice = {});

  /// The gain of the camera's automatic exposure for this view: that by which a small image of the
  /// place, without people, has the lightness that a camera gives an image in this light
  /// (render/lens/metering.h). Any lens.
  double metered_gain(const Scene& scene, const camera::Camera& camera);

  /// The vehicles that Frame::objects has, as far as the camera sees them; none unless asked for.
  std::span<const Vehicle> vehicles() const;

  /// Places on a character's head, as boxes of heads of people drawn at this level are taken from.
  std::span<const SkinPoint> head_points(std::uint32_t character, std::size_t level) const;

  /// On level ground in the open.
  double illuminance_lux() const;

  /// Takes the buffers of a frame that is not needed any more for one to come.
  void recycle(Frame&& frame);

  /// GL vendor, renderer and version, for manifests.
  std::string device_description() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace throng::render
