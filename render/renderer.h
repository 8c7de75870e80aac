// Renders a scenario and its people by OpenGL through EGL, without a window.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/compute/stage_clock.h"
#include "camera/camera.h"
#include "render/frame/frame.h"
#include "render/frame/pixel_weights.h"
#include "render/props/scene.h"
#include "render/props/vehicles.h"
#include "skinning/population.h"
#include "spec/render/environment.h"
#include "spec/render/quality.h"
#include "world/scenario.h"

namespace throng::render {

struct SkinPoint;

/// The GL device for rendering: "auto", "gpu", "gpu:N" or "software" (render/gl/context.h).
struct DeviceChoice {
  std::string name = "auto";
};

/// Max width and height of an image on the device, in color samples. Creates a context, which is
/// expensive. Throws EnvironmentError if that fails.
int max_image_px(const DeviceChoice& device = {});

/// Quality, and the ground truth to be rendered in addition to color, ids and depth.
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
  bool bone_turns = false;      ///< fill PersonInView::bone_turns
  bool vehicles = false;        ///< include vehicles in Frame::objects
  /// Antialiasing by several samples per pixel (true) or by post-processing (false), for tests and
  /// comparisons. Default: by quality and device.
  std::optional<bool> multisample = std::nullopt;
  /// Holds baked light for the processes of a job (render/light/light_store.h); empty: none does.
  std::filesystem::path light_folder = {};
  /// Receives the profile, if not null; the renderer then waits for the device after every stage.
  StageClock* clock = nullptr;
};

/// Options of a draw.
struct DrawChoice {
  /// Weights of pixels in areas; null: 1. Of a strip of an image, whose weights are all 1, people
  /// are measured within the domain.
  const PixelWeights* weights = nullptr;
  int margin_px = 0;  ///< people up to so far beside the image are in Frame::people, too
  bool truth = true;  ///< false: areas are 0, and no normals, flow and parts
  const NeighborFrame* previous = nullptr;  ///< for the backward flow only
  double exposure_gain = 1;                 ///< factor on all light
  /// The whole image of which rows are drawn; null: the camera's. All rows have its shadows.
  const camera::Intrinsics* whole = nullptr;
};

/// Owns a GL context and the buffers of the scenario and the population in it. All calls must come
/// from one thread. The scenario and the population must outlive the renderer.
class Renderer {
 public:
  /// Throws EnvironmentError naming the missing libraries or driver if no context can be created.
  Renderer(const world::Scenario& scenario, const skinning::Population& population,
           const Environment& environment = {}, const DeviceChoice& device = {},
           const RenderOptions& options = {});
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Renders color, ids, depth and the requested ground truth at one time. The camera must be a
  /// pinhole; Lens (render/lens/lens.h) supports all cameras. `next` is used for flow only.
  Frame draw(const Scene& scene, const camera::Camera& camera, const NeighborFrame* next = nullptr,
             const DrawChoice& choice = {});

  /// The gain of the camera's automatic exposure for this view, from a small image of the scenario
  /// without people (render/scenery/metering.h). Supports any lens.
  double metered_gain(const Scene& scene, const camera::Camera& camera);

  /// The vehicles that may be in Frame::objects; empty unless RenderOptions::vehicles.
  std::span<const Vehicle> vehicles() const;

  /// The points of a character's head from which the head boxes of people at this level are
  /// computed.
  std::span<const SkinPoint> head_points(std::uint32_t character, std::size_t level) const;

  /// Illuminance on horizontal ground under open sky.
  double illuminance_lux() const;

  /// Reuses the memory of a frame that is no longer needed.
  void recycle(Frame&& frame);

  /// GL vendor, renderer and version, for manifests.
  std::string device_description() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace throng::render
