#include "jobs/pipeline/checks/view_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "camera/camera.h"
#include "jobs/pipeline/frames/gimbal.h"
#include "jobs/pipeline/runs/run_input.h"
#include "sim/planning/planned_paths.h"
#include "sim/sensors/gimbal.h"
#include "spec/job/plan.h"
#include "spec/job/spec.h"

namespace throng::jobs {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr int kCellsPerSide = 40;
constexpr std::int64_t kMaxFrames = 40;  // of a camera that are looked at
constexpr double kHeadM = 1.7;
constexpr double kSpeedFactor = 2;  // people in panic walk faster

/// A place on the ground, and from when on somebody may be there.
struct Cell {
  Vector2d place;
  double reached_s = 0;
  bool is_inside = false;
  bool is_person = false;  ///< somebody is here at the start
};

double reached_s(const Vector2d& place, const StartingCrowd& crowd, double half_cell_m) {
  if (crowd.has_arrivals) return 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Vector2d& person : crowd.places) {
    nearest_m = std::min(nearest_m, (person - place).norm());
  }
  return std::max(0.0, nearest_m - half_cell_m) / std::max(crowd.max_speed_mps * kSpeedFactor, 0.1);
}

std::vector<Cell> occupied_cells(const world::Scenario& scenario, const StartingCrowd& crowd) {
  world::Rectangle area = scenario.ground;
  area.extend(scenario.inside.bounds);
  const Vector2d size = (area.max - area.min) / kCellsPerSide;
  std::vector<Cell> cells;
  for (int y = 0; y < kCellsPerSide; ++y) {
    for (int x = 0; x < kCellsPerSide; ++x) {
      const Vector2d place = area.min + Vector2d((x + 0.5) * size.x(), (y + 0.5) * size.y());
      cells.push_back(
          {place, reached_s(place, crowd, 0.5 * size.norm()), scenario.inside.contains(place)});
    }
  }
  // The places where people are: cells are large.
  for (const Vector2d& person : crowd.places) cells.push_back({person, 0, false, true});
  return cells;
}

bool is_in_image(const camera::Camera& camera, const Vector3d& point) {
  const camera::Camera::Projection shown = camera.project(point);
  return shown.visible && shown.depth_m > 0 && shown.pixel.x() >= 0 && shown.pixel.y() >= 0 &&
         shown.pixel.x() <= camera.intrinsics.width - 1 &&
         shown.pixel.y() <= camera.intrinsics.height - 1;
}

void add_image(const camera::Camera& camera, double time_s, const std::vector<Cell>& cells,
               CameraView& view) {
  int inside = 0;
  int shown = 0;
  for (const Cell& cell : cells) {
    const Vector3d head(cell.place.x(), cell.place.y(), kHeadM);
    const bool is_shown =
        is_in_image(camera, head) || is_in_image(camera, {cell.place.x(), cell.place.y(), 0});
    inside += cell.is_inside ? 1 : 0;
    shown += cell.is_inside && is_shown ? 1 : 0;
    view.mean_people += is_shown && cell.is_person ? 1 : 0;  // summed up, until all images are in
    if (!is_shown || cell.reached_s > time_s) continue;
    const double distance_m = (head - camera.pose.center()).norm();
    view.max_person_px =
        std::max(view.max_person_px, camera.intrinsics.fy_px * kHeadM / std::max(distance_m, 1.0));
  }
  if (inside > 0) view.max_area_share = std::max(view.max_area_share, 1.0 * shown / inside);
}

std::vector<double> sample_times(const JobSpec& job) {
  const std::int64_t frames = job.frames_per_camera();
  const std::int64_t count = std::min(frames, kMaxFrames);
  std::vector<double> times;
  for (std::int64_t i = 0; i < count; ++i) {
    times.push_back(job.frame_time_s(count == 1 ? 0 : i * (frames - 1) / (count - 1)));
  }
  return times;
}

}  // namespace

std::vector<std::optional<CameraView>> views_of_run(const JobSpec& whole_job,
                                                    const world::Scenario& scenario,
                                                    const StartingCrowd& crowd, int run) {
  const JobSpec job = job_of_run(whole_job, run);
  const std::vector<double> times = sample_times(job);
  const sim::RunSpec spec = run_spec(whole_job, run);
  const auto poses = sim::planned_poses(scenario, spec, crowd.aimed_at, times);
  const std::vector<Cell> cells = occupied_cells(scenario, crowd);
  std::vector<std::optional<CameraView>> views;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    std::optional<CameraView>& view = views.emplace_back();
    if (poses[i].empty()) continue;
    view.emplace().drone = spec.drones[i].id;
    for (std::size_t k = 0; k < times.size(); ++k) {
      world::DroneSample drone;
      drone.position = poses[i][k].position;
      drone.orientation = Eigen::AngleAxisd(poses[i][k].yaw_rad, Vector3d::UnitZ());
      const sim::DroneMission& mission = spec.drones[i];
      const sim::ViewAngles angles =
          sim::ideal_view(drone.orientation, mission.camera, mission.guidance.setpoints, times[k]);
      add_image(camera_on(drone, mission.camera, angles), times[k], cells, *view);
    }
    view->mean_people /= static_cast<double>(times.size());
  }
  return views;
}

nlohmann::json to_json(const CameraView& view) {
  return {{"drone", view.drone},
          {"max_area_share", std::round(1000 * view.max_area_share) / 1000},
          {"max_person_px", std::round(view.max_person_px)}};
}

}  // namespace throng::jobs
