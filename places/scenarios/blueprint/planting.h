// Paving, lawns, planters, bushes, benches and rows of trees of a generated scenario.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/compute/random.h"
#include "places/scenarios/blueprint/frame.h"

namespace throng::scenarios {

/// Distance (m) from a frame's walls to the street around it.
constexpr double kApproachM = 12;

/// Adds what a place is paved and planted with to its blueprint. Objects keep clear of gates and of
/// each other, so that they block no way. It draws from random numbers of its own.
class Planting {
 public:
  /// `frame` has its gates; both must outlive this.
  Planting(const Frame& frame, Random random, nlohmann::json& blueprint)
      : frame_(frame), random_(random), blueprint_(blueprint) {}

  /// Paves the frame in two materials, the second along its walls, and paths from its gates to
  /// the street around it; the rest of the ground is another one's.
  void pave(const char* material, const char* beside_walls, double beside_m);

  /// Adds strips of another material across the frame, one each `apart_m`.
  void add_strips(const char* material, double width_m, double apart_m);

  /// Adds a prop unless it would stand near a gate or another placed prop.
  /// Returns whether it stands there.
  bool put(const char* kind, const Eigen::Vector2d& at, double yaw_deg = 0);

  /// Adds props along a line, one after the other of `kinds`; each with this probability.
  void add_row(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double apart_m,
               const std::vector<const char*>& kinds, double probability);

  /// Adds lawns of this size in the corners of the frame that are away from gates, with bushes
  /// along their walls and a tree.
  void add_corner_lawns(double size_m);

 private:
  void area(const Eigen::Vector2d& min, const Eigen::Vector2d& max, const char* material,
            bool kerb = false);
  bool is_near_gate(const Eigen::Vector2d& at, double closer_than_m) const;

  const Frame& frame_;
  Random random_;
  nlohmann::json& blueprint_;
};

}  // namespace throng::scenarios
