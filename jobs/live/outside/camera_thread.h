// Images of a flight's cameras, drawn by a thread of its own while somebody wants them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>

#include "jobs/live/flight.h"
#include "jobs/live/outside/control.h"
#include "skinning/population.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::live {

/// Receivers of images. All are called on the camera's thread.
struct ImageSinks {
  /// Whether images of a drone's camera are wanted.
  std::function<bool(std::size_t drone)> is_wanted;
  std::function<void(const Moment&, std::size_t drone, double time_s, const std::string& jpeg)>
      take;
  /// There will be no images: a problem of the machine.
  std::function<void(const std::string& problem)> fail;
};

/// Draws the cameras that are wanted in turn, at most 30 images a second.
class CameraThread {
 public:
  /// Everything but the sinks must outlive this object.
  CameraThread(const jobs::JobSpec& job, const world::Scenario& scenario,
               const skinning::Population& population, const Flight& flight, const Control& control,
               ImageSinks sinks);
  ~CameraThread() = default;
  CameraThread(const CameraThread&) = delete;
  CameraThread& operator=(const CameraThread&) = delete;

 private:
  void run(const std::stop_token& stop);
  void show(const std::stop_token& stop);

  const jobs::JobSpec& job_;
  const world::Scenario& scenario_;
  const skinning::Population& population_;
  const Flight& flight_;  ///< for what never changes
  const Control& control_;
  ImageSinks sinks_;
  std::jthread thread_;
};

}  // namespace throng::live
