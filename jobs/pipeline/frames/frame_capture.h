// Renders the images of a run: any frame of any camera of the job.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/compute/stage_clock.h"
#include "render/animator.h"
#include "render/lens/exposure.h"
#include "render/lens/lens.h"
#include "sim/sensors/gimbal.h"
#include "sim/sensors/sensors.h"
#include "spec/job/spec.h"
#include "world/trace.h"

namespace throng::jobs {

/// An image with the metadata of its record.
struct CapturedFrame {
  render::Frame frame;
  std::string sensor;    ///< a JSON object: sensor noise, exposure and shutter
  std::string flight;    ///< a JSON object: true state of the drone and its sensor readings
  nlohmann::json drawn;  ///< an object: random values sampled for this frame alone
};

/// Images do not depend on the order of the calls. Use from the renderer's thread.
class FrameCapture {
 public:
  /// All arguments passed by reference must outlive this object. `clock` may be null.
  FrameCapture(const JobSpec& job, std::uint64_t run_seed, const world::Scenario& scenario,
               const world::Trace& trace, const skinning::Population& population,
               render::Renderer& renderer, StageClock* clock);

  /// Renders a frame of a drone; `drone` is its index in the job. Ask for a drone's frames in
  /// rising order: if the occlusion of optical flow is requested, the next frame is rendered as
  /// well and cached.
  CapturedFrame take(std::size_t drone, std::int64_t frame);

  /// Takes back an image that is no longer needed, to reuse its memory.
  void recycle(CapturedFrame&& captured);

 private:
  CapturedFrame capture(std::size_t drone, std::int64_t frame);
  /// The times of the frames to which this frame's optical flow leads.
  render::NeighborTimes neighbors_of(std::int64_t frame) const;
  /// A camera's view at a time near that of one of its frames, in the scene with this index.
  render::ShutterMoment moment_at(std::size_t drone, std::int64_t frame, std::int64_t index,
                                  double time_s);
  sim::ViewAngles view_at(std::size_t drone, std::int64_t frame,
                          const world::DroneSample& sample) const;
  /// All drones of the run.
  std::vector<render::DroneInstance> drones_at(double time_s) const;
  std::string flight_at(std::size_t drone, std::int64_t frame) const;
  const std::vector<sim::PilotSample>& setpoints(std::size_t drone) const;
  /// Offsets of a frame's camera, whose pitch depends on where the gimbal points.
  camera::FrameOffsets offsets_at(std::size_t drone, std::int64_t frame) const;

  const JobSpec* job_;
  std::uint64_t run_seed_;
  const world::Trace* trace_;
  StageClock* clock_;  ///< measures the stages; may be null
  render::Animator animator_;
  render::Lens lens_;
  std::vector<camera::CameraSpec> cameras_;          ///< this run's
  std::vector<sim::GimbalLog> gimbals_;              ///< one per camera
  std::vector<sim::SensorLog> sensors_;              ///< one per camera, of its drone
  std::vector<std::size_t> drones_;                  ///< index in the trace
  std::vector<render::AirframeShape> shapes_;        ///< of the drones
  std::shared_ptr<const render::Scene> scene_;       ///< of the last frame
  bool looks_ahead_ = false;                         ///< renders the next frame, too, for occlusion
  std::vector<std::optional<CapturedFrame>> ahead_;  ///< each drone's next frame, if rendered
};

}  // namespace throng::jobs
