#include "live/engine/newest_step.h"

namespace throng::engine {

void NewestStep::begin(const world::TraceHeader& header) {
  RunRecorder::begin(header);
  drones_ = DroneRows::Zero(static_cast<Eigen::Index>(header.drone_ids.size()),
                            DroneRows::ColsAtCompileTime);
}

void NewestStep::step(const world::CrowdStep& step) {
  RunRecorder::step(step);
  people_ = step;  // into the arrays of the first step, which are as long
}

void NewestStep::drone(std::size_t drone, const world::DroneSample& sample) {
  RunRecorder::drone(drone, sample);
  const Eigen::Quaterniond& turn = sample.orientation;
  drones_.row(static_cast<Eigen::Index>(drone)) << sample.position.transpose(),
      sample.velocity.transpose(), turn.w(), turn.x(), turn.y(), turn.z(),
      sample.body_rates.transpose();
}

}  // namespace throng::engine
