#include "sim/vehicle/wind.h"

#include <algorithm>
#include <cmath>

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kGridHz = 60;
constexpr double kFeetPerMeter = 1 / 0.3048;
constexpr double kMinAirspeedMps = 0.5;  // in air that stands still its eddies still pass

// The low-altitude model of MIL-F-8785C (1980), 3.7.3.4 figures 7 and 8, holds from 10 to 1000 ft.
struct DrydenScales {
  Vector3d sd_mps;
  Vector3d length_m;
};

DrydenScales dryden_scales(double wind_at_20_ft_mps, double height_m) {
  const double height_ft = std::clamp(height_m * kFeetPerMeter, 10.0, 1000.0);
  const double shape = 0.177 + 0.000823 * height_ft;
  const double vertical_mps = 0.1 * wind_at_20_ft_mps;
  const double horizontal_mps = vertical_mps / std::pow(shape, 0.4);
  const double horizontal_m = height_ft / std::pow(shape, 1.2) / kFeetPerMeter;
  return {{horizontal_mps, horizontal_mps, vertical_mps},
          {horizontal_m, horizontal_m, height_ft / kFeetPerMeter}};
}

// Moves a process of variance 1 on by one step and keeps it at variance 1.
double lagged(double value, double kept, double normal) {
  return kept * value + std::sqrt(1 - kept * kept) * normal;
}

Vector3d turned(const Vector3d& v, double yaw_rad) {
  return {std::cos(yaw_rad) * v.x() - std::sin(yaw_rad) * v.y(),
          std::sin(yaw_rad) * v.x() + std::cos(yaw_rad) * v.y(), v.z()};
}

}  // namespace

Gusts::Gusts(const WindSpec& spec, std::uint64_t seed, std::uint64_t vehicle)
    : spec_(spec),
      wind_at_20_ft_mps_(spec.mean_at(20 / kFeetPerMeter).norm()),
      random_(seed, Stream::wind, vehicle) {
  // Turbulence has no beginning: the filters start in their stationary state. Of the second lag,
  // given the first, the mean is half the first and the variance a quarter.
  for (int axis = 0; axis < 3; ++axis) {
    first_[axis] = random_.normal(0, 1);
    second_[axis] = 0.5 * first_[axis] + 0.5 * random_.normal(0, 1);
  }
  before_ = after_ = Vector3d::Zero();
  grid_ = -1;
}

Vector3d Gusts::at(double time_s, double height_m, double airspeed_mps) {
  const bool calm = spec_.gusts == GustModel::dryden && wind_at_20_ft_mps_ == 0;
  if (calm || spec_.gusts == GustModel::none) return Vector3d::Zero();
  const double place = time_s * kGridHz;
  while (static_cast<double>(grid_) <= place) {
    before_ = after_;
    after_ = next_point(height_m, airspeed_mps);
    if (++grid_ == 0) before_ = after_;
  }
  const double share = std::clamp(place - static_cast<double>(grid_ - 1), 0.0, 1.0);
  return before_ + share * (after_ - before_);
}

Vector3d Gusts::next_point(double height_m, double airspeed_mps) {
  const Vector3d gust =
      spec_.gusts == GustModel::ou ? ou_point() : dryden_point(height_m, airspeed_mps);
  return turned(gust, spec_.direction_rad);
}

Vector3d Gusts::ou_point() {
  const double kept = std::exp(-1 / (kGridHz * spec_.gust_time_s));
  for (double& value : first_) value = lagged(value, kept, random_.normal(0, 1));
  return spec_.gust_mps * first_;
}

// Forming filters of white noise (MIL-HDBK-1797): along the wind 1 / (1 + T s), else
// (1 + sqrt(3) T s) / (1 + T s)^2 = (sqrt(3) + (1 - sqrt(3)) / (1 + T s)) / (1 + T s), with
// T = length / airspeed. With a first lag of variance 1, the latter has variance 2.
Vector3d Gusts::dryden_point(double height_m, double airspeed_mps) {
  const DrydenScales scales = dryden_scales(wind_at_20_ft_mps_, height_m);
  const double speed_mps = std::max(airspeed_mps, kMinAirspeedMps);
  Vector3d gust;
  for (int axis = 0; axis < 3; ++axis) {
    const double kept = std::exp(-speed_mps / (kGridHz * scales.length_m[axis]));
    const double last = first_[axis];
    first_[axis] = lagged(last, kept, random_.normal(0, 1));
    second_[axis] = kept * second_[axis] + (1 - kept) * 0.5 * (last + first_[axis]);
    const double root = std::sqrt(3.0);
    const double unit = axis == 0
                            ? first_[axis]
                            : (root * first_[axis] + (1 - root) * second_[axis]) / std::sqrt(2.0);
    gust[axis] = spec_.intensity * scales.sd_mps[axis] * unit;
  }
  return gust;
}

}  // namespace throng::sim
