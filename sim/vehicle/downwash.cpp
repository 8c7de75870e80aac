#include "sim/vehicle/downwash.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

namespace {

constexpr double kDecay = 6.2;  // speed in the middle / start, times distance / diameter

}  // namespace

double hover_induced_mps(const Airframe& airframe) {
  const double discs_m2 = 4 * EIGEN_PI * airframe.propeller_radius_m * airframe.propeller_radius_m;
  return std::sqrt(airframe.weight_n() / (2 * kAirDensity * discs_m2));
}

Jet::Jet(const Airframe& airframe)
    : start_mps_(2 * hover_induced_mps(airframe)),
      diameter_m_(2 * std::sqrt(2.0) * airframe.propeller_radius_m),
      // With this half width the bell of speeds carries the vehicle's weight as momentum.
      narrowest_m_(diameter_m_ * std::sqrt(0.5 * std::log(2.0))) {}

double Jet::speed_mps(double below_m, double aside_m) const {
  if (below_m <= 0) return 0;
  const double middle_mps = start_mps_ * std::min(1.0, kDecay * diameter_m_ / below_m);
  const double half_m = std::max(kHalfWidth * below_m, narrowest_m_);
  const double ratio = aside_m / half_m;
  return middle_mps * std::exp2(-ratio * ratio);
}

double Jet::reach_m(double speed_mps) const {
  return speed_mps > start_mps_ ? 0 : kDecay * diameter_m_ * start_mps_ / speed_mps;
}

}  // namespace throng::sim
