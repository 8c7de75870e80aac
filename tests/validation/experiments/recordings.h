// Recordings that tests make themselves: people who walk at a constant velocity.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "validation/experiments/walks.h"

namespace throng::validation {

/// One person: first seen at `from_s`, at `place`, for `duration_s`.
struct Straight {
  double from_s = 0;
  Eigen::Vector2d place;
  Eigen::Vector2d velocity_mps;
  double duration_s = 0;
};

inline Walk straight_walk(const Straight& person, double dt_s, std::size_t stream = 0) {
  Walk walk;
  walk.first_step = static_cast<std::size_t>(std::lround(person.from_s / dt_s));
  walk.stream = stream;
  const auto steps = static_cast<std::size_t>(std::lround(person.duration_s / dt_s));
  for (std::size_t i = 0; i <= steps; ++i) {
    walk.places.emplace_back(person.place + dt_s * static_cast<double>(i) * person.velocity_mps);
  }
  return walk;
}

/// The text of a trajectory file in meters with 10 frames per second.
inline std::string recording_text(const std::vector<Straight>& people) {
  constexpr double kDtS = 0.1;
  std::string text = "# framerate: 10\n# ID\tFR\tx/m\ty/m\n";
  for (std::size_t id = 0; id < people.size(); ++id) {
    const Walk walk = straight_walk(people[id], kDtS);
    for (std::size_t i = 0; i < walk.places.size(); ++i) {
      text += std::to_string(id + 1) + "\t" + std::to_string(walk.first_step + i) + "\t" +
              std::to_string(walk.places[i].x()) + "\t" + std::to_string(walk.places[i].y()) + "\n";
    }
  }
  return text;
}

/// A corridor from x = 0 to 20 m, 2 m wide, with a line at x = 10 m.
inline Recording corridor() {
  Recording recording;
  recording.walkable = {{0, 0}, {20, 0}, {20, 2}, {0, 2}};
  recording.goals = {{Eigen::Vector2d(18, 0.2), Eigen::Vector2d(19.5, 1.8)}};
  recording.area = {Eigen::Vector2d(8, 0), Eigen::Vector2d(12, 2)};
  recording.line = {{10, 0}, {10, 2}};
  return recording;
}

inline double value(const Measures& measures, const std::string& name) {
  for (const Quantity& quantity : measures.quantities) {
    if (quantity.name == name) return quantity.value;
  }
  ADD_FAILURE() << "no quantity " << name;
  return std::nan("");
}

}  // namespace throng::validation
