#include "jobs/live/outside/camera_thread.h"

#include <chrono>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "jobs/live/onboard_camera.h"

namespace throng::live {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kMinPause(33);
constexpr std::chrono::milliseconds kStill(500);  // between images of a world that rests
constexpr std::chrono::milliseconds kNap(5);

/// The last image of a drone.
struct Last {
  double time_s = -1;
  Clock::time_point drawn;
};

}  // namespace

CameraThread::CameraThread(const jobs::JobSpec& job, const world::Scenario& scenario,
                           const skinning::Population& population, const Flight& flight,
                           const Control& control, ImageSinks sinks)
    : job_(job),
      scenario_(scenario),
      population_(population),
      flight_(flight),
      control_(control),
      sinks_(std::move(sinks)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void CameraThread::run(const std::stop_token& stop) {
  try {
    show(stop);
  } catch (const std::exception& error) {
    sinks_.fail(error.what());
  }
}

void CameraThread::show(const std::stop_token& stop) {
  std::optional<OnboardCamera> camera;  // made when it is first wanted
  std::vector<Last> last(flight_.drones().size());
  std::size_t next = 0;
  while (!stop.stop_requested()) {
    bool has_drawn = false;
    const auto begun = Clock::now();
    for (std::size_t i = 0; i < last.size() && !has_drawn; ++i) {
      const std::size_t drone = (next + i) % last.size();
      if (!sinks_.is_wanted(drone)) continue;
      const Control::Shown shown = control_.shown();
      if (shown.time_s == last[drone].time_s && begun - last[drone].drawn < kStill) continue;
      if (!camera) {
        camera.emplace(job_, scenario_, population_, flight_.header(), flight_.drones());
      }
      sinks_.take(*shown.moment, drone, shown.time_s,
                  camera->image(*shown.moment, drone, shown.time_s));
      last[drone] = {shown.time_s, begun};
      next = drone + 1;
      has_drawn = true;
    }
    std::this_thread::sleep_until(has_drawn ? begun + kMinPause : begun + kNap);
  }
}

}  // namespace throng::live
