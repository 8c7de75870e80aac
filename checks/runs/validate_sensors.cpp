// The tables of drones' sensors against themselves and against the images' flight records.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "base/files/files.h"
#include "base/json/json_text.h"
#include "checks/flight_checks.h"
#include "formats/files/csv_table.h"
#include "formats/files/json_vectors.h"
#include "spec/annotate/table_columns.h"

namespace throng::checks {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using nlohmann::json;

namespace {

constexpr std::size_t kColumns = annotate::column_count(annotate::kSensorColumns);
/// The index of a column of sensors/RUN/DRONE.csv.
consteval std::size_t column(std::string_view name) {
  return annotate::column_index(annotate::kSensorColumns, name);
}
// First columns of the values.
constexpr std::size_t kTime = column("time_s");
constexpr std::size_t kPosition = column("true_x_m");
constexpr std::size_t kVelocity = column("true_vx_mps");
constexpr std::size_t kOrientation = column("true_qw");
constexpr std::size_t kRates = column("true_wx_rad_s");
constexpr std::size_t kForce = column("true_fx_mps2");
constexpr std::size_t kAir = column("air_vx_mps");
constexpr std::size_t kEnergy = column("energy_j");
constexpr std::size_t kGyro = column("gyro_x_rad_s");
constexpr std::size_t kAccelerometer = column("accelerometer_x_mps2");
constexpr std::size_t kMagnetometer = column("magnetometer_x_ut");
constexpr std::size_t kPressure = column("pressure_pa");
constexpr std::size_t kHeight = column("height_m");
constexpr std::size_t kGpsTime = column("gps_time_s");
constexpr std::size_t kGpsPosition = column("gps_x_m");
constexpr std::size_t kGpsVelocity = column("gps_vx_mps");

using Row = std::vector<double>;

Vector3d at(const Row& row, std::size_t first) {
  return {row[first], row[first + 1], row[first + 2]};
}

Quaterniond read_orientation(const Row& row) {
  return {row[kOrientation], row[kOrientation + 1], row[kOrientation + 2], row[kOrientation + 3]};
}

SensorSample sample_of_row(const Row& row) {
  return {at(row, kPosition),
          at(row, kVelocity),
          read_orientation(row),
          at(row, kRates),
          at(row, kForce),
          at(row, kGyro),
          at(row, kAccelerometer),
          at(row, kMagnetometer),
          row[kPressure],
          row[kHeight],
          at(row, kGpsPosition),
          at(row, kGpsVelocity),
          0};
}

/// Names motion between two rows that does not follow from velocity, force and rates; "" if all
/// does.
std::string break_of_motion(const Row& a, const Row& b) {
  const double dt_s = b[kTime] - a[kTime];
  // Forces of the air and of rotors change within a step, and a crash stops a drone at once.
  const Vector3d moved = at(b, kPosition) - at(a, kPosition);
  const Vector3d mean = 0.5 * (at(a, kVelocity) + at(b, kVelocity));
  const double off_m = (moved - mean * dt_s).norm();
  const double change_mps = (at(b, kVelocity) - at(a, kVelocity)).norm();
  if (off_m > 0.002 + 0.6 * change_mps * dt_s) {
    return fmt::format("moved by {:.4f} m more or less than its velocity says", off_m);
  }
  constexpr double kGravity = 9.81;
  const Vector3d force = read_orientation(a) * at(a, kForce);
  const Vector3d force_then = read_orientation(b) * at(b, kForce);
  const Vector3d expected = 0.5 * (force + force_then) - Vector3d(0, 0, kGravity);
  const Vector3d acceleration = (at(b, kVelocity) - at(a, kVelocity)) / dt_s;
  const double off_mps2 = (acceleration - expected).norm();
  if (off_mps2 > 1.5 + (force - force_then).norm() + 0.2 * expected.norm()) {
    return fmt::format("velocity changes by {:.2f} m/s2 other than true_f says", off_mps2);
  }
  const Eigen::AngleAxisd turn(read_orientation(a).conjugate() * read_orientation(b));
  const Vector3d turned = std::remainder(turn.angle(), 2 * EIGEN_PI) * turn.axis();
  const Vector3d rates = 0.5 * (at(a, kRates) + at(b, kRates));
  const double off_rad_s = (turned / dt_s - rates).norm();
  if (off_rad_s > 0.1 + (at(a, kRates) - at(b, kRates)).norm()) {
    return fmt::format("turns by {:.3f} rad/s other than true_w says", off_rad_s);
  }
  return "";
}

/// Names a value of a row that does not follow from the one before; "" if all do. Motion is not
/// judged in contact.
std::string break_between(const Row& a, const Row& b, bool in_contact) {
  const double dt_s = b[kTime] - a[kTime];
  if (!(dt_s > 0)) return fmt::format("time_s {} after {}", b[kTime], a[kTime]);
  const std::string motion = in_contact ? "" : break_of_motion(a, b);
  if (!motion.empty()) return motion;
  constexpr double kMaxPowerW = 5000;
  const double power_w = (b[kEnergy] - a[kEnergy]) / dt_s;
  if (!(power_w >= -1e-6 && power_w < kMaxPowerW)) {
    return fmt::format("energy_j grows by {:.0f} W", power_w);
  }
  if (b[kGpsTime] < a[kGpsTime] || b[kGpsTime] > b[kTime] + 1e-6 || b[kTime] - b[kGpsTime] > 0.5) {
    return fmt::format("gps_time_s {}", b[kGpsTime]);
  }
  if (b[kGpsTime] == a[kGpsTime] &&
      (at(b, kGpsPosition) != at(a, kGpsPosition) || at(b, kGpsVelocity) != at(a, kGpsVelocity))) {
    return "another GPS position at the same gps_time_s";
  }
  constexpr double kMaxGustMps2 = 400;
  if ((at(b, kAir) - at(a, kAir)).norm() > 0.5 + kMaxGustMps2 * dt_s) {
    return "air velocity jumps";
  }
  return "";
}

/// The drone's figures in metrics/RUN.json; an empty object without.
json read_flight_figures(const formats::DatasetInfo& info, const std::string& run,
                         const std::string& drone) {
  const std::filesystem::path file = info.root / "metrics" / (run + ".json");
  if (!std::filesystem::is_regular_file(file)) return json::object();
  const json figures = parse_json_or_discard(read_file(file), kOwnJsonLimits);
  if (!figures.is_object()) return json::object();  // check_metrics says so
  for (const json& figure : figures.value("drones", json::array())) {
    if (figure.value("id", "") == drone) return figure;
  }
  return json::object();
}

/// Names a figure that is not what the rows, which are those of the whole run, add up to.
std::string other_figure(const json& figures, const std::vector<Row>& rows) {
  double flown_m = 0;
  double fastest_mps = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    fastest_mps = std::max(fastest_mps, at(rows[i], kVelocity).norm());
    if (i > 0) flown_m += (at(rows[i], kPosition) - at(rows[i - 1], kPosition)).norm();
  }
  constexpr double kJoules = 3600;
  const double energy_wh = rows.back()[kEnergy] / kJoules;
  struct Figure {
    const char* key;
    double expected;
  };
  for (const Figure& figure : {Figure{"flown_m", flown_m}, Figure{"fastest_mps", fastest_mps},
                               Figure{"energy_wh", energy_wh}}) {
    if (!figures.contains(figure.key) || !figures.at(figure.key).is_number()) continue;
    const double found = figures.at(figure.key).get<double>();
    constexpr double kSlack = 1e-3;  // the last row may be a step before the end
    if (std::abs(found - figure.expected) <= kSlack * (1 + std::abs(figure.expected))) continue;
    return fmt::format("{} is {} in the run's metrics, but the rows give {:.4f}", figure.key, found,
                       figure.expected);
  }
  return "";
}

/// Contact lasts less than the time between two rows: velocity jumps, and no row has the force.
bool is_contact(const Row& a, const Row& b) {
  // Collisions are of 0.3 m/s and more (docs/trace.md), of which glancing ones change a part.
  constexpr double kJumpMps = 0.02;
  return (at(b, kVelocity) - at(a, kVelocity)).norm() > kJumpMps && !break_of_motion(a, b).empty();
}

/// Names a place where rows are missing: they begin with the run, are as far apart as the first two
/// and reach the last frame. "" if none are.
std::string missing_rows(const std::vector<Row>& rows, double end_s) {
  if (rows.size() < 2) return "fewer than two rows";
  constexpr double kRoundingS = 2e-4;  // nine digits are written of up to two hours
  const double step_s = rows[1][kTime] - rows[0][kTime];
  if (rows.front()[kTime] > kRoundingS) return fmt::format("begins at {} s", rows.front()[kTime]);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double passed_s = rows[i][kTime] - rows[i - 1][kTime];
    if (std::abs(passed_s - step_s) <= kRoundingS) continue;
    return fmt::format("line {} is {:.4f} s after the one before, others {:.4f} s", i + 2, passed_s,
                       step_s);
  }
  if (rows.back()[kTime] + step_s + kRoundingS >= end_s) return "";
  return fmt::format("ends at {} s, before the last frame", rows.back()[kTime]);
}

/// Whether a drone may stand on the ground there: touching down slowly is no collision.
bool is_near_ground(const Row& row) {
  constexpr double kHalfHeightM = 0.5;  // of large airframes
  return row[kPosition + 2] < kHalfHeightM;
}

/// The row at or before a time.
std::size_t row_at(const std::vector<Row>& rows, double time_s) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), time_s + 1e-6,
                                      [](double t, const Row& row) { return t < row[kTime]; });
  return after == rows.begin() ? 0 : static_cast<std::size_t>(after - rows.begin()) - 1;
}

bool are_equal(const Vector3d& a, const Vector3d& b, double slack) {
  return (a - b).cwiseAbs().maxCoeff() <= slack + 1e-7 * b.cwiseAbs().maxCoeff();
}

/// Names a reading of an image that is not in the row; "" if all are.
std::string other_reading(const json& measured, const Row& row) {
  struct Reading {
    const char* name;
    std::size_t column;
    json value;
  };
  const json& gps = measured.at("gps");
  for (const Reading& reading :
       {Reading{"gyro", kGyro, measured.at("gyro")},
        Reading{"accelerometer", kAccelerometer, measured.at("accelerometer")},
        Reading{"magnetometer_ut", kMagnetometer, measured.at("magnetometer_ut")},
        Reading{"gps.position", kGpsPosition, gps.at("position")},
        Reading{"gps.velocity", kGpsVelocity, gps.at("velocity")}}) {
    if (!are_equal(formats::numbers_at<3>(reading.value), at(row, reading.column), 1e-6)) {
      return reading.name;
    }
  }
  const auto differ = [&](const json& value, std::size_t column) {
    return std::abs(value.get<double>() - row[column]) > 1e-6 * (1 + std::abs(row[column]));
  };
  if (differ(measured.at("time_s"), kTime)) return "time_s";
  if (differ(measured.at("pressure_pa"), kPressure)) return "pressure_pa";
  if (differ(measured.at("height_m"), kHeight)) return "height_m";
  if (differ(gps.at("time_s"), kGpsTime)) return "gps.time_s";
  return "";
}

/// Names a true value of an image that is not between two rows; "" if all are.
std::string other_truth(const json& truth, const Row& a, const Row& b) {
  const double dt_s = b[kTime] - a[kTime];
  const double time_s = truth.at("time_s").get<double>();
  const double share = dt_s > 0 ? std::clamp((time_s - a[kTime]) / dt_s, 0.0, 1.0) : 0;
  struct Value {
    const char* name;
    std::size_t column;
  };
  for (const Value& value :
       {Value{"position", kPosition}, Value{"velocity", kVelocity}, Value{"body_rates", kRates},
        Value{"specific_force", kForce}, Value{"air_velocity", kAir}}) {
    const Vector3d expected =
        at(a, value.column) + share * (at(b, value.column) - at(a, value.column));
    if (!are_equal(formats::numbers_at<3>(truth.at(value.name)), expected, 1e-5)) return value.name;
  }
  const Quaterniond expected = read_orientation(a).slerp(share, read_orientation(b));
  if (expected.angularDistance(formats::quaternion_at(truth.at("orientation_wxyz"))) > 1e-4) {
    return "orientation_wxyz";
  }
  const double energy_j = a[kEnergy] + share * (b[kEnergy] - a[kEnergy]);
  constexpr double kJoules = 3600;
  if (std::abs(truth.at("energy_wh").get<double>() * kJoules - energy_j) > 1e-6 * (1 + energy_j)) {
    return "energy_wh";
  }
  return "";
}

}  // namespace

bool may_have_touched(const formats::DatasetInfo& info, const std::string& run,
                      const std::string& drone) {
  const json figures = read_flight_figures(info, run, drone);
  return !figures.value("collisions", json::object()).empty() ||
         figures.value("near_misses", 0) > 0 || figures.value("landed_s", json()).is_number();
}

namespace {

/// The rows of a table; nothing where it is malformed, which is a finding.
std::optional<std::vector<Row>> read_sensor_rows(const formats::DatasetInfo& info,
                                                 const std::string& name, Findings& findings) {
  const formats::CsvTable csv = formats::read_csv(info.root / name);
  if (fmt::format("{}", fmt::join(csv.columns, ",")) != annotate::kSensorColumns) {
    findings.add("sensors", name, "line 1", "other columns than docs/formats_coco.md has");
    return std::nullopt;
  }
  std::vector<Row> rows;
  for (std::size_t i = 0; i < csv.rows.size(); ++i) {
    Row row;
    for (const std::string& cell : csv.rows[i]) row.push_back(formats::parse_number(cell));
    if (row.size() != kColumns ||
        !std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); })) {
      findings.add("sensors", name, fmt::format("line {}", i + 2), "not 39 numbers");
      return std::nullopt;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

struct SensorRows {
  const std::string& name;  ///< of the file
  const std::vector<Row>& rows;
};

/// Checks that rows follow from each other and readings from the truth. Only the first fault is
/// reported: the rest would repeat it.
void check_sensor_rows(const formats::DatasetInfo& info, const formats::Image& image,
                       const SensorRows& table, Findings& findings) {
  const auto& [name, rows] = table;
  const double latitude_deg =
      image.record.value("environment", json::object()).value("latitude_deg", 45.0);
  const json figures = read_flight_figures(info, image.run, image.camera);
  const bool may_touch = may_have_touched(info, image.run, image.camera);
  const double end_s = info.from_s + static_cast<double>(info.frames_per_camera - 1) / info.rate_hz;
  const std::string gap = missing_rows(rows, end_s);
  if (!gap.empty()) findings.add("sensors", name, "", gap);
  const std::string figure = rows.empty() ? "" : other_figure(figures, rows);
  if (!figure.empty()) findings.add("sensors", name, "", figure);
  const auto noise = info.sensor_noise.find(image.camera);
  bool in_contact = false;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // From then on it may lie there or slide.
    in_contact = in_contact || (may_touch && i > 0 && is_contact(rows[i - 1], rows[i]));
    const bool touches =
        in_contact || is_near_ground(rows[i]) || (i > 0 && is_near_ground(rows[i - 1]));
    std::string what = i == 0 ? "" : break_between(rows[i - 1], rows[i], touches);
    constexpr double kGpsAgeS = 0.45;
    if (what.empty() && noise != info.sensor_noise.end()) {
      SensorSample sample = sample_of_row(rows[i]);
      if (in_contact) sample.max_jump_mps = kMaxImpactMps;
      what = implausible_reading(sample, noise->second, latitude_deg, 0, kGpsAgeS);
    }
    if (what.empty()) continue;
    findings.add("sensors", name, fmt::format("line {}", i + 2), what);
    return;
  }
}

}  // namespace

void SensorTableCheck::add(const formats::DatasetInfo& info, const formats::Image& image,
                           Findings& findings) {
  if (!image.record.contains("flight")) return;
  const std::string name =
      ground_truth_file(annotate::GroundTruth::sensors, image.run, image.camera);
  Table& table = tables_[name];
  if (!table.is_read) {
    table.is_read = true;
    std::optional<std::vector<Row>> rows = read_sensor_rows(info, name, findings);
    if (!rows) return;
    table.rows = *std::move(rows);
    check_sensor_rows(info, image, {name, table.rows}, findings);
  }
  if (table.rows.empty()) return;
  const json& flight = image.record.at("flight");
  const std::size_t row = row_at(table.rows, image.time_s);
  const std::string reading = other_reading(flight.at("measured"), table.rows[row]);
  if (!reading.empty()) {
    findings.add("sensors", name, fmt::format("line {}", row + 2),
                 fmt::format("{} is not what flight.measured of image {} says", reading, image.id));
  }
  const Row& next = table.rows[std::min(row + 1, table.rows.size() - 1)];
  const std::string truth = other_truth(flight.at("true"), table.rows[row], next);
  if (!truth.empty()) {
    findings.add("sensors", name, fmt::format("line {}", row + 2),
                 fmt::format("{} is not what flight.true of image {} says", truth, image.id));
  }
}

}  // namespace throng::checks
