// The drones' cameras during a live flight: the renderer of jobs at draft quality, through a
// pinhole camera, without effects of sensor and shutter.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "live/flight/people_in_motion.h"
#include "live/loop/moment.h"
#include "render/renderer.h"
#include "skinning/population.h"
#include "spec/camera/camera_spec.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::live {

/// Size of images in pixels.
struct ImageSize {
  int width = 640;
  int height = 360;
};

/// The camera that replaces a job's camera during a flight: the same direction, mount and
/// horizontal field of view.
camera::CameraSpec shown_camera(const camera::CameraSpec& camera, const ImageSize& size = {});

/// A drone's camera (shown_camera()) at one of the drone's samples within the moment's step.
camera::Camera flown_camera(const Moment& moment, std::size_t drone,
                            const camera::CameraSpec& shown, const world::DroneSample& sample);

/// Amount of smoke from the hazards of a job's first run, 0 to 1.
double smoke_amount(const jobs::JobSpec& job);

/// Clothing of people in a job's first run.
skinning::Styling clothing(const jobs::JobSpec& job);

/// Owns a GL context: use from the thread that created it.
class OnboardCamera {
 public:
  /// The cameras of the job's first run. The population must outlive this object. Throws
  /// EnvironmentError and InputError.
  OnboardCamera(const jobs::JobSpec& job, world::Scenario scenario,
                const skinning::Population& population, const world::TraceHeader& header,
                const std::vector<sim::PlannedDrone>& drones, const ImageSize& size = {});

  /// Renders the view of a drone's camera at a time within the moment's step: RGB, rows from the
  /// top. Valid until the next image.
  const std::vector<std::uint8_t>& draw(const Moment& moment, std::size_t drone, double time_s);
  /// The same as a JPEG file.
  std::string image(const Moment& moment, std::size_t drone, double time_s);

 private:
  /// Scenario, light and clothing of the run.
  struct Surroundings {
    world::Scenario scenario;
    render::Environment light;
    skinning::Styling styling;
  };
  static Surroundings place_of(const jobs::JobSpec& whole_job, world::Scenario scenario);
  OnboardCamera(Surroundings place, const skinning::Population& population,
                const world::TraceHeader& header, const std::vector<sim::PlannedDrone>& drones,
                const ImageSize& size);

  world::Scenario scenario_;
  PosedPeople people_;
  render::Renderer renderer_;
  std::vector<camera::CameraSpec> cameras_;  ///< per drone
  std::vector<render::AirframeShape> shapes_;
  render::Frame frame_;
};

}  // namespace throng::live
