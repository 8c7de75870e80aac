#include "places/scenarios/blueprint/planting.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"
#include "base/geometry/polygon.h"

namespace throng::scenarios {

using Eigen::Vector2d;
using nlohmann::json;

void Planting::area(const Vector2d& min, const Vector2d& max, const char* material, bool kerb) {
  add_area(min, max, material, kerb, blueprint_);
}

void Planting::pave(const char* material, const char* beside_walls, double beside_m) {
  constexpr double kPavementM = 2.5;  // along the street
  const Vector2d depth = Vector2d::Constant(frame_.depth_m + kApproachM);
  const Vector2d low = frame_.min - depth;
  const Vector2d high = frame_.max + depth;
  area(low, {high.x(), low.y() + kPavementM}, "pavers");
  area({low.x(), high.y() - kPavementM}, high, "pavers");
  area(low, {low.x() + kPavementM, high.y()}, "pavers");
  area({high.x() - kPavementM, low.y()}, high, "pavers");
  for (const Gate& gate : frame_.gates) {
    const auto [from, to] = gate_ends(frame_, gate);
    const bool is_across = gate.side == Side::south || gate.side == Side::north;
    const Vector2d out = is_across ? Vector2d(0, depth.y()) : Vector2d(depth.x(), 0);
    const Vector2d wider = is_across ? Vector2d(0.4, 0) : Vector2d(0, 0.4);
    const bool is_low = gate.side == Side::south || gate.side == Side::west;
    const Vector2d low_end = is_low ? Vector2d(from - out) : from;
    const Vector2d high_end = is_low ? to : Vector2d(to + out);
    area(low_end - wider, high_end + wider, beside_walls);
  }
  area(frame_.min, frame_.max, beside_walls);
  const Vector2d beside = Vector2d::Constant(beside_m);
  if ((frame_.size() - 2 * beside).minCoeff() > 2) {
    area(frame_.min + beside, frame_.max - beside, material, true);
  }
}

void Planting::add_strips(const char* material, double width_m, double apart_m) {
  const Vector2d half = Vector2d::Constant(0.5 * width_m);
  for (int axis = 0; axis < 2; ++axis) {
    const double length_m = frame_.size()[axis];
    const int count = std::max(1, static_cast<int>(length_m / apart_m));
    for (int i = 1; i < count; ++i) {
      const double at = frame_.min[axis] + length_m * i / count;
      Vector2d low = frame_.min;
      Vector2d high = frame_.max;
      low[axis] = at - half[axis];
      high[axis] = at + half[axis];
      area(low, high, material);
    }
  }
}

bool Planting::is_near_gate(const Vector2d& at, double closer_than_m) const {
  return std::any_of(frame_.gates.begin(), frame_.gates.end(), [&](const Gate& gate) {
    const auto [from, to] = gate_ends(frame_, gate);
    return geometry::distance_to_segment(from, to, at) < closer_than_m;
  });
}

bool Planting::put(const char* kind, const Vector2d& at, double yaw_deg) {
  constexpr double kClearOfGatesM = 5;
  constexpr double kApartM = 2.4;
  constexpr double kBesideFountainM = 5;
  if (is_near_gate(at, kClearOfGatesM)) return false;
  for (const json& other : blueprint_["props"]) {
    const Vector2d there(other["position"][0].get<double>(), other["position"][1].get<double>());
    const double apart_m = other["kind"] == "fountain" ? kBesideFountainM : kApartM;
    if ((there - at).norm() < apart_m) return false;
  }
  blueprint_["props"].push_back({{"kind", kind},
                                 {"position", point_json(at)},
                                 {"yaw_deg", yaw_deg},
                                 {"look", random_.below(1000)}});
  return true;
}

void Planting::add_row(const Vector2d& from, const Vector2d& to, double apart_m,
                       const std::vector<const char*>& kinds, double probability) {
  const double length_m = (to - from).norm();
  const Vector2d along = (to - from) / std::max(length_m, 1e-9);
  const double yaw_deg = std::round(std::atan2(along.y(), along.x()) / kDegree);
  std::size_t next = 0;
  for (double at_m = 0.5 * apart_m; at_m < length_m; at_m += apart_m) {
    const char* kind = kinds[next++ % kinds.size()];
    if (random_.uniform() < probability) put(kind, from + at_m * along, yaw_deg);
  }
}

void Planting::add_corner_lawns(double size_m) {
  constexpr double kFromWallM = 0.95;
  constexpr double kBushesApartM = 2.5;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const Vector2d corner =
          0.5 * (frame_.min + frame_.max) + 0.5 * frame_.size().cwiseProduct(Vector2d(x, y));
      const Vector2d inwards(-x, -y);
      const Vector2d end = corner + size_m * inwards;
      if (is_near_gate(corner, size_m + 2) || random_.uniform() < 0.15) continue;
      area(corner.cwiseMin(end), corner.cwiseMax(end), "grass", true);
      put("tree", corner + 0.55 * size_m * inwards);
      for (double along = kFromWallM; along < size_m - 0.8; along += kBushesApartM) {
        if (random_.uniform() < 0.8) put("bush", corner + Vector2d(-x * along, -y * kFromWallM));
        if (random_.uniform() < 0.8) put("bush", corner + Vector2d(-x * kFromWallM, -y * along));
      }
    }
  }
}

}  // namespace throng::scenarios
