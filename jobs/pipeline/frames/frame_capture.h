// Takes a run's images: each camera of the job at any of its frames.
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

struct CapturedFrame {
  render::Frame frame;
  std::string sensor;    ///< a JSON object: what sensor and shutter did
  std::string flight;    ///< a JSON object: the drone then, and what its sensors say
  nlohmann::json drawn;  ///< an object: the samples of this frame alone
};

/// Everything given must outlive it. Images do not depend on which were taken before.
class FrameCapture {
 public:
  FrameCapture(const JobSpec& job, std::uint64_t run_seed, const world::Trace& trace,
               const skinning::Population& population, render::Renderer& renderer,
               StageClock* clock);

  /// Frames of a drone are best taken one after another: where flow's occlusion is asked for, the
  /// next one is captured as well, and kept.
  CapturedFrame take(std::size_t drone, std::int64_t frame);

  /// Takes an image that is not needed any more, for its memory.
  void recycle(CapturedFrame&& captured);

 private:
  CapturedFrame capture(std::size_t drone, std::int64_t frame);
  /// The times of the frames that this frame's flow leads to.
  render::NeighborTimes neighbors_of(std::int64_t frame) const;
  /// A camera's view at a time around that of one of its frames, in the scene of this index.
  render::ShutterMoment moment_at(std::size_t drone, std::int64_t frame, std::int64_t index,
                                  double time_s);
  sim::ViewAngles view_at(std::size_t drone, std::int64_t frame,
                          const world::DroneSample& sample) const;
  /// All drones of the run.
  std::vector<render::DroneInstance> drones_at(double time_s) const;
  std::string flight_at(std::size_t drone, std::int64_t frame) const;

  const JobSpec* job_;
  std::uint64_t run_seed_;
  const world::Trace* trace_;
  StageClock* clock_;  ///< of how long stages take; may be null
  render::Animator animator_;
  render::Lens lens_;
  std::vector<camera::CameraSpec> cameras_;          ///< this run's
  std::vector<sim::GimbalLog> gimbals_;              ///< one per camera
  std::vector<sim::SensorLog> sensors_;              ///< one per camera: its drone's
  std::vector<std::size_t> drones_;                  ///< index in the trace
  std::vector<render::AirframeShape> shapes_;        ///< of the drones
  std::shared_ptr<const render::Scene> scene_;       ///< of the frame that was taken last
  bool looks_ahead_ = false;                         ///< has the next frame captured, for occlusion
  std::vector<std::optional<CapturedFrame>> ahead_;  ///< each drone's next frame, if it is captured
};

}  // namespace throng::jobs
