// The manifest's job against the images' records: cameras, sensors, light and weather.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "checks/run_checks.h"

namespace throng::checks {

using nlohmann::json;

namespace {

bool is_setpoint(const json& row) {
  constexpr std::size_t kMinNumbers = 6;
  return row.is_array() && row.size() >= kMinNumbers &&
         std::all_of(row.begin(), row.end(), [](const json& value) { return value.is_number(); });
}

/// The fields of the job as they hold for one image: those that were sampled are in its record.
class JobOfImage {
 public:
  JobOfImage(const json& job, const formats::Image& image)
      : job_(job), drawn_(image.record.value("drawn", json::object())) {}

  /// The value of a field by its dotted path; null where the job does not say one or another sample
  /// cannot be looked up.
  json at(const std::string& path) const {
    if (const auto sampled = drawn_.find(path); sampled != drawn_.end()) return *sampled;
    std::string pointer_text = "/" + path;
    std::replace(pointer_text.begin(), pointer_text.end(), '.', '/');
    const json::json_pointer pointer(pointer_text);
    if (!job_.contains(pointer)) return nullptr;
    const json& value = job_.at(pointer);
    return value.is_structured() ? json(nullptr) : value;
  }
  /// Whether the job says anything of a field.
  bool has(const std::string& path) const {
    std::string pointer_text = "/" + path;
    std::replace(pointer_text.begin(), pointer_text.end(), '.', '/');
    return job_.contains(json::json_pointer(pointer_text));
  }
  /// The pitch of a drone's camera at a time: its set-points' where these turn the gimbal.
  json pitch_deg(std::size_t drone, double time_s) const {
    const json otherwise = at(fmt::format("drones.{}.camera.pitch_deg", drone));
    const json::json_pointer pointer(fmt::format("/drones/{}/guidance/setpoints", drone));
    if (!job_.contains(pointer) || !otherwise.is_number()) return otherwise;
    constexpr std::size_t kPitch = 6;
    const auto pitch_in = [&](const json& row) {
      return row.size() > kPitch ? row[kPitch].get<double>() : otherwise.get<double>();
    };
    const json& rows = job_.at(pointer);
    if (rows.empty() || !std::all_of(rows.begin(), rows.end(), is_setpoint)) return otherwise;
    const auto after = std::find_if(rows.begin(), rows.end(),
                                    [&](const json& row) { return row[0].get<double>() > time_s; });
    if (after == rows.begin()) return pitch_in(*after);
    const json& before = *(after - 1);
    if (after == rows.end()) return pitch_in(before);
    const double begin_s = before[0];
    const double share = (time_s - begin_s) / ((*after)[0].get<double>() - begin_s);
    return pitch_in(before) + share * (pitch_in(*after) - pitch_in(before));
  }
  /// A number that was sampled for the frame alone; 0 without.
  double of_frame(const char* name) const {
    return drawn_.value(std::string("frame.") + name, 0.0);
  }

 private:
  const json& job_;
  json drawn_;
};

std::optional<std::size_t> find_drone(const json& job, const formats::Image& image) {
  const json drones = job.value("drones", json::array());
  if (!drones.is_array()) return std::nullopt;
  for (std::size_t i = 0; i < drones.size(); ++i) {
    if (drones[i].is_object() && drones[i].value("id", json()) == image.camera) return i;
  }
  return std::nullopt;
}

class JobCheck {
 public:
  JobCheck(const json& job, const formats::Image& image, Findings& findings)
      : job_(job, image), image_(image), findings_(findings) {}

  void compare(const std::string& path, const std::string& name, const json& found) const {
    const json expected = job_.at(path);
    if (expected.is_null() || found.is_null()) return;
    if (expected.is_number() && found.is_number()) {
      compare_number(path, name, found.get<double>(), expected.get<double>());
    } else if (expected != found) {
      fault(path, name, found.dump(), expected.dump());
    }
  }
  void compare_number(const std::string& path, const std::string& name, double found,
                      double expected) const {
    constexpr double kRelative = 1e-6;
    if (std::abs(found - expected) <= kRelative * (1 + std::abs(expected))) return;
    fault(path, name, fmt::format("{}", found), fmt::format("{}", expected));
  }

  void check_camera(std::size_t drone) const {
    const std::string path = fmt::format("drones.{}.camera.", drone);
    const json& camera = image_.record.at("camera");
    if (job_.at(path + "width").is_null() || !job_.at(path + "calibration").is_null()) return;
    compare(path + "width", "width", image_.width);
    compare(path + "height", "height", image_.height);
    compare(path + "model", "camera.model", camera.value("model", json()));
    const json lens = camera.value("distortion", json::object());
    for (const auto& [name, value] : lens.items()) {
      compare(path + "distortion." + name, "camera.distortion." + name, value);
    }
    check_focal_length(path);
    const json gimbal = image_.record.value("flight", json::object())
                            .value("true", json::object())
                            .value("gimbal", json::object());
    const json pitch = job_.pitch_deg(drone, image_.time_s);
    if (job_.at(path + "gimbal.model") != "ideal" || !pitch.is_number()) return;
    const double expected = pitch.get<double>() + job_.of_frame("pitch_deg");
    constexpr double kRightAngle = 90;
    if (!gimbal.contains("pitch_deg") || std::abs(expected) >= kRightAngle) return;
    compare_number(path + "pitch_deg", "flight.true.gimbal.pitch_deg",
                   gimbal.at("pitch_deg").get<double>(), expected);
  }

  void check_focal_length(const std::string& path) const {
    for (const auto& [name, row, column] : {std::tuple("fx_px", 0, 0), std::tuple("fy_px", 1, 1),
                                            std::tuple("cx_px", 0, 2), std::tuple("cy_px", 1, 2)}) {
      compare(path + name, fmt::format("camera.K[{}][{}]", row, column),
              image_.camera_matrix(row, column));
    }
    const json angle = job_.at(path + "hfov_deg");
    if (!job_.at(path + "fx_px").is_null() || !angle.is_number() ||
        job_.at(path + "model") != "pinhole") {
      return;
    }
    const double half_rad = angle.get<double>() * std::numbers::pi / 360;
    compare_number(path + "hfov_deg", "camera.K[0][0]", image_.camera_matrix(0, 0),
                   image_.width / 2.0 / std::tan(half_rad));
  }

  void check_sensor(std::size_t drone) const {
    const json sensor = image_.record.value("sensor", json::object());
    const std::string path = fmt::format("drones.{}.camera.sensor.", drone);
    for (const char* name : {"iso", "full_well_e", "read_noise_e", "exposure_s", "readout_s",
                             "field_s", "vignette", "color_shading"}) {
      compare(path + name, fmt::format("sensor.{}", name), sensor.value(name, json()));
    }
    for (const char* name : {"ev", "white_balance_k"}) {
      const json run = job_.at(path + name);
      if (!run.is_number() || !sensor.contains(name)) continue;
      compare_number(path + name, fmt::format("sensor.{}", name), sensor.at(name).get<double>(),
                     run.get<double>() + job_.of_frame(name));
    }
    const json processing = sensor.value("processing", json::object());
    for (const auto& [name, value] : processing.items()) {
      compare(fmt::format("drones.{}.camera.processing.{}", drone, name),
              fmt::format("sensor.processing.{}", name), value);
    }
    compare("outputs.image.quality", "sensor.jpeg_quality", sensor.value("jpeg_quality", json()));
    if (sensor.contains("exposure_gain")) check_metering(path, sensor);
  }

  /// Exposure and ISO that the job leaves to the camera: the incident-light equation of ISO 2720
  /// with C = 250 at f/2.8 and 1/60 s, 0 below 400 and 1600 at most.
  void check_metering(const std::string& path, const json& sensor) const {
    const double gain = sensor.at("exposure_gain");
    if (job_.at(path + "metering") == "light" && gain != 1) {
      fault(path + "metering", "sensor.exposure_gain", fmt::format("{}", gain), "1");
    }
    if (job_.has(path + "iso") || !sensor.contains("iso")) return;
    constexpr double kLuxIso = 250 * 2.8 * 2.8 * 60;
    const double wanted = kLuxIso / sensor.value("illuminance_lux", 1.0) * gain;
    const json min_iso = job_.at(path + "min_iso");
    const double expected = std::max(wanted < 400 ? 0 : std::min(wanted, 1600.0),
                                     min_iso.is_number() ? min_iso.get<double>() : 0);
    const double found = sensor.at("iso");
    if (std::abs(found - expected) > 1e-6 * (1 + expected)) {
      fault(path + "iso", "sensor.iso", fmt::format("{}", found), fmt::format("{}", expected));
    }
  }

  void check_environment() const {
    const json environment = image_.record.value("environment", json::object());
    for (const char* name :
         {"time_of_day", "latitude_deg", "day_of_year", "weather", "visibility_m", "smoke"}) {
      compare(std::string("environment.") + name, std::string("environment.") + name,
              environment.value(name, json()));
    }
    if (environment.value("weather", "") == "rain") {
      compare("environment.rain_mm_per_h", "environment.rain_mm_per_h",
              environment.value("rain_mm_per_h", json()));
    }
    const json wind = environment.value("wind", json::object());
    for (const char* name : {"speed_mps", "direction_deg", "profile", "gusts"}) {
      compare(std::string("environment.wind.") + name, std::string("environment.wind.") + name,
              wind.value(name, json()));
    }
  }

 private:
  void fault(const std::string& path, const std::string& name, const std::string& found,
             const std::string& expected) const {
    findings_.add(
        "job", formats::kCocoFile, fmt::format("image {}", image_.id),
        fmt::format("{} is {}, but the job's {} makes it {}", name, found, path, expected));
  }

  JobOfImage job_;
  const formats::Image& image_;
  Findings& findings_;
};

}  // namespace

void check_job(const json& manifest, const formats::Image& image, Findings& findings) {
  const auto job = manifest.find("job");
  if (job == manifest.end() || !job->is_object()) return;
  const JobCheck check(*job, image, findings);
  check.check_environment();
  if (const auto drone = find_drone(*job, image)) {
    check.check_camera(*drone);
    check.check_sensor(*drone);
  }
}

}  // namespace throng::checks
