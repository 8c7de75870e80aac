// The camera of a drone during a live flight: the job's renderer at draft quality, through a
// pinhole of 640 x 360, without the sensor's and shutter's effects.
#pragma once

#include <string>
#include <vector>

#include "jobs/live/flight.h"
#include "jobs/live/people_in_motion.h"
#include "render/renderer.h"
#include "skinning/population.h"
#include "spec/camera/camera_spec.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::live {

inline constexpr int kImageWidth = 640;
inline constexpr int kImageHeight = 360;

/// The camera that is shown in place of a job's: its direction and field of view.
camera::CameraSpec shown_camera(const camera::CameraSpec& camera);

/// Owns a GL context: use from the thread that made it.
/// How much smoke rises from the dangers of a job's first run, 0 to 1.
double smoke_amount(const jobs::JobSpec& job);

class OnboardCamera {
 public:
  /// The camera of the job's first run. Throws EnvironmentError and InputError.
  OnboardCamera(const jobs::JobSpec& job, world::Scenario scenario,
                const world::TraceHeader& header, const std::vector<sim::PlannedDrone>& drones);

  /// A JPEG of what a drone's camera sees at a time of the moment's step.
  std::string image(const Moment& moment, std::size_t drone, double time_s);

 private:
  /// As the run has it.
  struct Surroundings {
    world::Scenario scenario;
    render::Environment light;
    skinning::Styling styling;
  };
  static Surroundings place_of(const jobs::JobSpec& whole_job, world::Scenario scenario);
  OnboardCamera(Surroundings place, const world::TraceHeader& header,
                const std::vector<sim::PlannedDrone>& drones);

  world::Scenario scenario_;
  skinning::Population population_;
  PeopleInMotion people_;
  render::Renderer renderer_;
  std::vector<camera::CameraSpec> cameras_;  ///< per drone
  std::vector<render::AirframeShape> shapes_;
};

}  // namespace throng::live
