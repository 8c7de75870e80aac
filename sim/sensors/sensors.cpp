#include "sim/sensors/sensors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/compute/random.h"
#include "base/error.h"

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kSeaLevelPa = 101'325;
constexpr double kLapse = 2.25577e-5;  // 1/m
constexpr double kPressureExponent = 5.25588;
constexpr std::uint64_t kSensorsPerDrone = 8;

enum class Sensor : std::uint64_t { gyro, accelerometer, magnetometer, barometer, gps };

Random sensor_random(std::uint64_t seed, std::uint64_t drone, Sensor sensor) {
  return {seed, Stream::sensors, drone * kSensorsPerDrone + static_cast<std::uint64_t>(sensor)};
}

Vector3d normals(Random& random) {
  Vector3d v;
  for (double& value : v) value = random.normal(0, 1);
  return v;
}

/// A first-order Gauss-Markov process in three dimensions, driven by white noise of `walk`
/// (unit / (s sqrt(Hz))); exact for any step (Furrer et al. 2016, eq. 5 and 6).
class Wander {
 public:
  Wander(double walk, double correlation_s) : walk_(walk), correlation_s_(correlation_s) {}

  const Vector3d& advance(double dt_s, Random& random) {
    const double kept = std::exp(-dt_s / correlation_s_);
    const double sd = walk_ * std::sqrt(0.5 * correlation_s_ * (1 - kept * kept));
    value_ = kept * value_ + sd * normals(random);
    return value_;
  }

 private:
  double walk_;
  double correlation_s_;
  Vector3d value_ = Vector3d::Zero();
};

/// The walk that gives a process of this standard deviation.
double random_walk_step(double sd, double correlation_s) {
  return sd * std::sqrt(2 / correlation_s);
}

class InertialTriad {
 public:
  InertialTriad(const InertialNoise& noise, Random random)
      : noise_(noise), random_(random), wander_(noise.walk, noise.walk_s) {
    turn_on_ = noise.turn_on * normals(random_);
  }

  Vector3d read(const Vector3d& truth, double dt_s) {
    const Vector3d white = noise_.density.cwiseProduct(normals(random_)) / std::sqrt(dt_s);
    return truth + turn_on_ + wander_.advance(dt_s, random_) + white;
  }

 private:
  InertialNoise noise_;
  Random random_;
  Wander wander_;
  Vector3d turn_on_;
};

/// Fixes at a steady rate; each becomes known a delay after it was true.
class Gps {
 public:
  Gps(const SensorNoise& noise, Random random)
      : noise_(noise), random_(random), error_(normals(random_)) {}

  /// Sees one more sample of the truth; the newest fix that is known then.
  const GpsFix& read(const world::DroneSample& truth) {
    while (static_cast<double>(next_) / noise_.gps_hz <= truth.time_s + world::kTimeSlackS) {
      fixes_.push_back(fix(truth));
      ++next_;
    }
    while (known_ + 1 < fixes_.size() &&
           fixes_[known_ + 1].time_s + noise_.gps_delay_s <= truth.time_s) {
      ++known_;
    }
    return fixes_[known_];
  }

 private:
  GpsFix fix(const world::DroneSample& truth) {
    const Vector3d wander(noise_.gps_wander_m.x(), noise_.gps_wander_m.x(),
                          noise_.gps_wander_m.y());
    const Eigen::Vector2d& sd = noise_.gps_velocity_mps;
    const Vector3d speed(sd.x(), sd.x(), sd.y());
    // Starts anywhere, not at the truth: the receiver has been on for a while.
    const double kept = std::exp(-1 / (noise_.gps_hz * noise_.gps_wander_s));
    if (next_ > 0) error_ = kept * error_ + std::sqrt(1 - kept * kept) * normals(random_);
    GpsFix fix;
    fix.time_s = truth.time_s;
    fix.position =
        truth.position + wander.cwiseProduct(error_) + noise_.gps_white_m * normals(random_);
    fix.velocity = truth.velocity + speed.cwiseProduct(normals(random_));
    return fix;
  }

  SensorNoise noise_;
  Random random_;
  Vector3d error_;  ///< of the position, per standard deviation
  std::vector<GpsFix> fixes_;
  long next_ = 0;  ///< number of the next fix
  std::size_t known_ = 0;
};

class Barometer {
 public:
  Barometer(const SensorNoise& noise, Random random)
      : noise_(noise),
        random_(random),
        weather_(random_walk_step(noise.weather_share, noise.weather_s), noise.weather_s) {
    if (noise.pressure_offset_pa > 0) offset_pa_ = random_.normal(0, noise.pressure_offset_pa);
  }

  double read(double height_m, double dt_s) {
    const double share = 1 + weather_.advance(dt_s, random_).x();
    return pressure_at(height_m) * share + offset_pa_ + random_.normal(0, noise_.pressure_pa);
  }

 private:
  SensorNoise noise_;
  Random random_;
  Wander weather_;
  double offset_pa_ = 0;
};

}  // namespace

double pressure_at(double height_m) {
  return kSeaLevelPa * std::pow(1 - kLapse * height_m, kPressureExponent);
}

double height_at(double pressure_pa) {
  return (1 - std::pow(pressure_pa / kSeaLevelPa, 1 / kPressureExponent)) / kLapse;
}

Vector3d magnetic_field(double latitude_rad) {
  constexpr double kEquatorUt = 30;
  return kEquatorUt * Vector3d(0, std::cos(latitude_rad), -2 * std::sin(latitude_rad));
}

struct DroneSensors::State {
  SensorNoise noise;
  Vector3d field;  ///< of the earth, µT, world
  InertialTriad gyro;
  InertialTriad accelerometer;
  Random magnetic;
  Barometer barometer;
  Gps gps;
  std::optional<double> last_s = {};  ///< time of the last sample
};

DroneSensors::DroneSensors(std::uint64_t seed, std::uint64_t drone, double latitude_rad,
                           const SensorNoise& noise)
    : state_(new State{
          noise, magnetic_field(latitude_rad),
          InertialTriad(noise.gyro, sensor_random(seed, drone, Sensor::gyro)),
          InertialTriad(noise.accelerometer, sensor_random(seed, drone, Sensor::accelerometer)),
          sensor_random(seed, drone, Sensor::magnetometer),
          Barometer(noise, sensor_random(seed, drone, Sensor::barometer)),
          Gps(noise, sensor_random(seed, drone, Sensor::gps))}) {}

DroneSensors::~DroneSensors() = default;
DroneSensors::DroneSensors(DroneSensors&&) noexcept = default;

const SensorNoise& DroneSensors::noise() const { return state_->noise; }

SensorReading DroneSensors::read(const world::DroneSample& truth) {
  constexpr double kUsualStepS = 1.0 / 60;
  State& state = *state_;
  const double dt_s = truth.time_s - state.last_s.value_or(truth.time_s - kUsualStepS);
  state.last_s = truth.time_s;
  SensorReading reading;
  reading.time_s = truth.time_s;
  reading.gyro = state.gyro.read(truth.body_rates, dt_s);
  reading.accelerometer = state.accelerometer.read(truth.specific_force, dt_s);
  reading.magnetometer = truth.orientation.conjugate() * state.field +
                         state.noise.field_share * state.field.norm() * normals(state.magnetic);
  reading.pressure_pa = state.barometer.read(truth.position.z(), dt_s);
  reading.height_m = height_at(reading.pressure_pa);
  reading.gps = state.gps.read(truth);
  return reading;
}

SensorLog::SensorLog(const std::vector<world::DroneSample>& truth, DroneSensors sensors)
    : noise_(sensors.noise()) {
  check(!truth.empty(), "a drone with sensors has flown");
  readings_.reserve(truth.size());
  for (const world::DroneSample& sample : truth) readings_.push_back(sensors.read(sample));
}

SensorLog::SensorLog(const std::vector<world::DroneSample>& truth, std::uint64_t seed,
                     std::uint64_t drone, double latitude_rad, const SensorNoise& noise)
    : SensorLog(truth, DroneSensors(seed, drone, latitude_rad, noise)) {}

const SensorReading& SensorLog::at(double time_s) const {
  const auto after =
      std::upper_bound(readings_.begin(), readings_.end(), time_s + world::kTimeSlackS,
                       [](double t, const SensorReading& reading) { return t < reading.time_s; });
  return after == readings_.begin() ? readings_.front() : *(after - 1);
}

}  // namespace throng::sim
