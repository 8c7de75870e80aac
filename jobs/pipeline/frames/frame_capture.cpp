#include "jobs/pipeline/frames/frame_capture.h"
#include "jobs/pipeline/frames/sensor_record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/compute/random.h"
#include "base/error.h"
#include "base/geometry/angle.h"
#include "jobs/pipeline/frames/flight_record.h"
#include "jobs/pipeline/frames/frame_draw.h"
#include "jobs/pipeline/frames/gimbal.h"
#include "render/lens/processing.h"
#include "render/lens/sensor.h"
#include "render/scenery/metering.h"
#include "render/truth/flow_targets.h"
#include "sim/recording/gimbal_setpoints.h"
#include "spec/sim/airframe.h"

namespace throng::jobs {

namespace {

std::size_t drone_index(const world::Trace& trace, const std::string& id) {
  const auto& ids = trace.header.drone_ids;
  const auto found = std::find(ids.begin(), ids.end(), id);
  check(found != ids.end(), "a trace holds the drones of its job");
  return static_cast<std::size_t>(found - ids.begin());
}

render::AirframeShape airframe_shape(const sim::DroneMission& mission) {
  const std::optional<sim::Airframe> airframe = sim::find_airframe(mission);
  check(airframe.has_value(), "airframes are checked when a job is read");
  return render::airframe_shape(*airframe);
}

}  // namespace

FrameCapture::FrameCapture(const JobSpec& job, std::uint64_t run_seed,
                           const world::Scenario& scenario, const world::Trace& trace,
                           const skinning::Population& population, render::Renderer& renderer,
                           StageClock* clock)
    : job_(&job),
      run_seed_(run_seed),
      trace_(&trace),
      clock_(clock),
      animator_(trace, population, job.styling, scenario.stands, scenario.sitters),
      lens_(renderer, population),
      looks_ahead_(annotate::holds(job.outputs.annotations, annotate::GroundTruth::flow_occlusion)),
      ahead_(job.drones.size()) {
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    cameras_.push_back(camera_of_run(job.drones[i].camera, run_seed, camera_pointer(i)));
    drones_.push_back(drone_index(trace, job.drones[i].mission.id));
    shapes_.push_back(airframe_shape(job.drones[i].mission));
    const std::vector<world::DroneSample>& samples = trace.drones[drones_[i]];
    gimbals_.emplace_back(samples, cameras_[i], run_seed, i, setpoints(i));
    sensors_.push_back(record_sensors(job, run_seed, samples, i));
  }
}

render::ShutterMoment FrameCapture::moment_at(std::size_t drone, std::int64_t frame,
                                              std::int64_t index, double time_s) {
  if (clock_ != nullptr) clock_->lap("light and rows");
  std::shared_ptr<const render::Scene> scene = scene_;
  if (!scene || scene->index != index || scene->time_s != time_s) {
    render::Scene now = animator_.scene_at(time_s, index);
    now.drones = drones_at(time_s);
    scene = std::make_shared<const render::Scene>(std::move(now));
    // The moments around a frame's own time are needed by one camera only.
    if (time_s == job_->frame_time_s(index)) scene_ = scene;
  }
  if (clock_ != nullptr) clock_->lap("scene");
  const world::DroneSample sample = trace_->drone_at(drones_[drone], time_s);
  return {std::move(scene), camera_on(sample, cameras_[drone], view_at(drone, frame, sample))};
}

std::vector<render::DroneInstance> FrameCapture::drones_at(double time_s) const {
  std::vector<render::DroneInstance> drones;
  for (std::size_t i = 0; i < drones_.size(); ++i) {
    const world::DroneSample sample = trace_->drone_at(drones_[i], time_s);
    drones.push_back({static_cast<std::uint32_t>(drones_[i]), sample.position, sample.velocity,
                      sample.orientation, shapes_[i]});
  }
  return drones;
}

sim::ViewAngles FrameCapture::view_at(std::size_t drone, std::int64_t frame,
                                      const world::DroneSample& sample) const {
  const camera::CameraSpec& camera = cameras_[drone];
  sim::ViewAngles view = gimbals_[drone].view_at(sample.time_s);
  if (camera.gimbal.model != camera::GimbalModel::second_order) {
    view = sim::ideal_view(sample.orientation, camera, setpoints(drone), sample.time_s);
  }
  const camera::FrameOffsets draw = offsets_at(drone, frame);
  view.yaw += draw.yaw_deg * kDegree;
  view.pitch += draw.pitch_deg * kDegree;
  return view;
}

const std::vector<sim::PilotSample>& FrameCapture::setpoints(std::size_t drone) const {
  return job_->drones[drone].mission.guidance.setpoints;
}

camera::FrameOffsets FrameCapture::offsets_at(std::size_t drone, std::int64_t frame) const {
  camera::CameraSpec camera = cameras_.at(drone);
  const camera::GimbalAngles angles =
      sim::gimbal_at(setpoints(drone), camera.gimbal_angles(), job_->frame_time_s(frame));
  camera.pitch_deg = angles.pitch_deg;
  return draw_of_frame(camera, run_seed_, drone, frame);
}

std::string FrameCapture::flight_at(std::size_t drone, std::int64_t frame) const {
  const double time_s = job_->frame_time_s(frame);
  const world::DroneSample sample = trace_->drone_at(drones_[drone], time_s);
  const sim::ViewAngles view = view_at(drone, frame, sample);
  return flight_record({sample, view, camera_on(sample, cameras_[drone], view),
                        sensors_[drone].at(time_s), gimbals_[drone].reading_at(time_s)},
                       sensors_[drone].noise())
      .dump();
}

CapturedFrame FrameCapture::take(std::size_t drone, std::int64_t frame) {
  if (!looks_ahead_) return capture(drone, frame);
  std::optional<CapturedFrame>& ahead = ahead_.at(drone);
  CapturedFrame now =
      ahead && ahead->frame.index == frame ? std::move(*ahead) : capture(drone, frame);
  ahead.reset();
  if (frame + 1 < job_->frames_per_camera()) {
    ahead = capture(drone, frame + 1);
    now.frame.flow_target = render::flow_targets(now.frame, ahead->frame);
  } else {
    now.frame.flow_target = render::unknown_flow_targets(now.frame);
  }
  return now;
}

CapturedFrame FrameCapture::capture(std::size_t drone, std::int64_t frame) {
  if (clock_ != nullptr) clock_->skip();
  const camera::FrameOffsets draw = offsets_at(drone, frame);
  camera::CameraSpec camera = camera_of_frame(cameras_[drone], draw);
  const double time_s = job_->frame_time_s(frame);
  const render::NeighborTimes neighbors = neighbors_of(frame);
  const render::MomentAt moment = [&](double at_s) {
    const auto is_beyond_half = [&](const std::optional<double>& other_s) {
      return other_s && std::abs(at_s - *other_s) < 0.5 * std::abs(time_s - *other_s);
    };
    const std::int64_t shown = is_beyond_half(neighbors.next_s)       ? frame + 1
                               : is_beyond_half(neighbors.previous_s) ? frame - 1
                                                                      : frame;
    return moment_at(drone, shown, frame, at_s);
  };
  render::Exposed exposed =
      render::expose(lens_, moment, time_s, camera.exposure, neighbors, camera.sensor.is_metered);
  if (camera.exposure.field_s > 0) {
    render::Exposed other = render::expose(lens_, moment, time_s - camera.exposure.field_s,
                                           camera.exposure, {}, camera.sensor.is_metered);
    render::interlace(other.frame, exposed.frame);
    lens_.recycle(std::move(other.frame));
  }
  if (!camera.sensor.iso) {
    camera.sensor.iso =
        std::max(camera.sensor.min_iso, render::metered_iso(exposed.illuminance_lux, exposed.gain));
  }
  constexpr unsigned kFrameBits = 40;
  const std::uint64_t index =
      (static_cast<std::uint64_t>(drone) << kFrameBits) + static_cast<std::uint64_t>(frame);
  render::apply_optics(camera.processing, exposed.frame);
  render::apply_sensor(camera.sensor, derive_seed(run_seed_, Stream::camera_noise, index),
                       exposed.frame);
  render::apply_processing(camera.processing, camera.sensor, exposed.frame);
  if (clock_ != nullptr) clock_->lap("light and rows");
  CapturedFrame captured;
  captured.sensor = sensor_record(camera, exposed, job_->outputs.image_quality).dump();
  captured.flight = flight_at(drone, frame);
  captured.drawn = to_json(cameras_[drone], draw);
  captured.frame = std::move(exposed.frame);
  return captured;
}

render::NeighborTimes FrameCapture::neighbors_of(std::int64_t frame) const {
  const annotate::RenderNeeds needs = annotate::render_needs(job_->outputs.annotations);
  render::NeighborTimes times;
  if (needs.flow && frame + 1 < job_->frames_per_camera()) {
    times.next_s = job_->frame_time_s(frame + 1);
  }
  if (needs.flow_backward && frame > 0) times.previous_s = job_->frame_time_s(frame - 1);
  return times;
}

void FrameCapture::recycle(CapturedFrame&& captured) { lens_.recycle(std::move(captured.frame)); }

}  // namespace throng::jobs
