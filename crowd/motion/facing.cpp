#include "crowd/motion/facing.h"

#include <cmath>
#include <numbers>

#include "base/compute/random.h"
#include "base/geometry/angle.h"

namespace throng::crowd {

using Eigen::Vector2f;

namespace {

constexpr std::uint64_t kFacingPart = 0x666163696e67;  // apart from other draws of the stream

Random agent_random(std::uint64_t seed, std::size_t agent) {
  return {derive_seed(seed, Stream::crowd_generator, kFacingPart), Stream::crowd_generator, agent};
}

Vector2f unit(double angle_rad) {
  return {static_cast<float>(std::cos(angle_rad)), static_cast<float>(std::sin(angle_rad))};
}

Vector2f any_direction(std::uint64_t seed, std::size_t agent) {
  return unit(agent_random(seed, agent).uniform(-std::numbers::pi, std::numbers::pi));
}

AttributeSpec spread() {
  return optional(number("spread", "standard deviation in degrees", 0, 180), "10");
}

class AnyDirection : public Facing {
 public:
  explicit AnyDirection(std::uint64_t seed) : seed_(seed) {}
  Vector2f direction(std::size_t agent, const Vector2f& /*place*/) const override {
    return any_direction(seed_, agent);
  }

 private:
  std::uint64_t seed_;
};

class OneDirection : public Facing {
 public:
  OneDirection(std::uint64_t seed, double angle_rad, double spread_rad)
      : seed_(seed), angle_rad_(angle_rad), spread_rad_(spread_rad) {}
  Vector2f direction(std::size_t agent, const Vector2f& /*place*/) const override {
    return unit(agent_random(seed_, agent).normal(angle_rad_, spread_rad_));
  }

 private:
  std::uint64_t seed_;
  double angle_rad_;
  double spread_rad_;
};

class TowardsPoint : public Facing {
 public:
  TowardsPoint(std::uint64_t seed, Vector2f point, double spread_rad)
      : seed_(seed), point_(std::move(point)), spread_rad_(spread_rad) {}
  Vector2f direction(std::size_t agent, const Vector2f& place) const override {
    constexpr float kThere = 0.05F;  // m
    const Vector2f way = point_ - place;
    if (way.norm() < kThere) return any_direction(seed_, agent);
    return unit(agent_random(seed_, agent)
                    .normal(std::atan2(static_cast<double>(way.y()), static_cast<double>(way.x())),
                            spread_rad_));
  }

 private:
  std::uint64_t seed_;
  Vector2f point_;
  double spread_rad_;
};

std::unique_ptr<Facing> make_any(const Element& element, const Attributes&,
                                 FacingContext& context) {
  element.require_no_children();
  return std::make_unique<AnyDirection>(context.seed);
}

std::unique_ptr<Facing> make_direction(const Element& element, const Attributes& attributes,
                                       FacingContext& context) {
  element.require_no_children();
  return std::make_unique<OneDirection>(context.seed, kDegree * attributes.number("angle"),
                                        kDegree * attributes.number("spread"));
}

std::unique_ptr<Facing> make_towards(const Element& element, const Attributes& attributes,
                                     FacingContext& context) {
  element.require_no_children();
  return std::make_unique<TowardsPoint>(context.seed,
                                        Vector2f(attributes.real("x"), attributes.real("y")),
                                        kDegree * attributes.number("spread"));
}

}  // namespace

const FacingRegistry& facing_registry() {
  static const FacingRegistry kRegistry({{
      {"random", "any direction, by the run's seed", {}, make_any},
      {"direction",
       "one direction",
       {number("angle", "in degrees, counter-clockwise from +x", -360, 360), spread()},
       make_direction},
      {"towards",
       "a point that all look at",
       {number("x", "in m"), number("y", "in m"), spread()},
       make_towards},
  }});
  return kRegistry;
}

std::unique_ptr<Facing> any_facing(std::uint64_t seed) {
  return std::make_unique<AnyDirection>(seed);
}

}  // namespace throng::crowd
