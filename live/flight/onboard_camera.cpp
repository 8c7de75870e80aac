#include "live/flight/onboard_camera.h"

#include <utility>

#include "base/geometry/angle.h"
#include "base/graphics/images/jpeg_writer.h"
#include "jobs/pipeline/frames/gimbal.h"
#include "sim/sensors/gimbal.h"
#include "spec/job/environment.h"

namespace throng::live {

namespace {

constexpr int kJpegQuality = 70;

render::RenderOptions draft() {
  render::RenderOptions options;
  options.quality = render::Quality::draft;
  return options;
}

jobs::RunEnvironment flight_environment(const jobs::JobSpec& job) {
  const std::uint64_t seed = jobs::run_seed(job, 0);
  return jobs::environment_of_run(jobs::job_of_run(job, 0).environment, seed);
}

}  // namespace

OnboardCamera::Surroundings OnboardCamera::place_of(const jobs::JobSpec& whole_job,
                                                    world::Scenario scenario) {
  const jobs::JobSpec job = jobs::job_of_run(whole_job, 0);
  const std::uint64_t seed = jobs::run_seed(job, 0);
  world::thin_out(scenario, job.props_density, seed);
  return {std::move(scenario), flight_environment(whole_job).light, clothing(whole_job)};
}

double smoke_amount(const jobs::JobSpec& job) { return flight_environment(job).light.smoke; }

skinning::Styling clothing(const jobs::JobSpec& job) {
  return jobs::styling_in(jobs::job_of_run(job, 0), flight_environment(job).light.weather);
}

camera::CameraSpec shown_camera(const camera::CameraSpec& camera, const ImageSize& size) {
  camera::CameraSpec shown;
  shown.width = size.width;
  shown.height = size.height;
  shown.mount_m = camera.mount_m;
  if (camera.gimbal.is_rigid()) shown.gimbal.model = camera::GimbalModel::rigid;
  shown.hfov_deg = camera.pinhole_hfov_rad() / kDegree;
  shown.pitch_deg = camera.pitch_deg;
  shown.yaw_deg = camera.yaw_deg;
  return shown;
}

camera::Camera flown_camera(const Moment& moment, std::size_t drone,
                            const camera::CameraSpec& shown, const world::DroneSample& sample) {
  return jobs::camera_on(
      sample, shown,
      sim::ideal_view(sample.orientation, shown, moment.setpoints.at(drone), sample.time_s));
}

OnboardCamera::OnboardCamera(const jobs::JobSpec& job, world::Scenario scenario,
                             const skinning::Population& population,
                             const world::TraceHeader& header,
                             const std::vector<sim::PlannedDrone>& drones, const ImageSize& size)
    : OnboardCamera(place_of(job, std::move(scenario)), population, header, drones, size) {}

OnboardCamera::OnboardCamera(Surroundings place, const skinning::Population& population,
                             const world::TraceHeader& header,
                             const std::vector<sim::PlannedDrone>& drones, const ImageSize& size)
    : scenario_(std::move(place.scenario)),
      people_(header, header.seed, population, place.styling, scenario_.stands, scenario_.sitters),
      renderer_(scenario_, population, place.light, {}, draft()) {
  for (const sim::PlannedDrone& drone : drones) {
    cameras_.push_back(shown_camera(drone.mission.camera, size));
    shapes_.push_back(render::airframe_shape(drone.airframe));
  }
}

const std::vector<std::uint8_t>& OnboardCamera::draw(const Moment& moment, std::size_t drone,
                                                     double time_s) {
  render::Scene scene = people_.scene_at(moment, time_s);
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    const world::DroneSample sample = moment.flown.drone_at(i, time_s);
    scene.drones.push_back({static_cast<std::uint32_t>(i), sample.position, sample.velocity,
                            sample.orientation, shapes_[i]});
  }
  const camera::Camera view =
      flown_camera(moment, drone, cameras_.at(drone), moment.flown.drone_at(drone, time_s));
  renderer_.recycle(std::move(frame_));
  frame_ = renderer_.draw(scene, view, nullptr,
                          {.truth = false, .exposure_gain = renderer_.metered_gain(scene, view)});
  return frame_.rgb;
}

std::string OnboardCamera::image(const Moment& moment, std::size_t drone, double time_s) {
  const std::vector<std::uint8_t>& rgb = draw(moment, drone, time_s);
  return images::jpeg_bytes(rgb, frame_.width(), frame_.height(), kJpegQuality);
}

}  // namespace throng::live
