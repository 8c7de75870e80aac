#include "spec/job/camera_fields.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/angle.h"

namespace throng::jobs {

using nlohmann::json;

namespace {

constexpr std::array kModels{"pinhole", "brown_conrady", "fisheye"};
constexpr std::array kGimbals{"ideal", "second_order", "rigid"};
constexpr std::array kMeterings{"image", "light"};
constexpr std::array kCalibrated = {"preset", "width", "height", "hfov_deg", "fx_px",
                                    "fy_px",  "cx_px", "cy_px",  "model",    "distortion"};

bool is_calibrated(const std::string& path) {
  const std::string first = path.substr(0, path.find('/'));
  return std::find(kCalibrated.begin(), kCalibrated.end(), first) != kCalibrated.end();
}

/// A number as it is kept, if it is there.
using GetNumber = std::function<std::optional<double>(const CameraSpec&)>;
using SetNumber = std::function<void(CameraSpec&, double)>;

/// A number that may be a distribution.
void add_number(FieldTable<CameraSpec>& table, const std::string& path, std::string title,
                std::string unit, double low, double high, const GetNumber& number,
                const SetNumber& set_number, std::string help) {
  Values values = numbers(low, high);
  const Quantity quantity = *values.quantity;
  const auto get = [path, quantity, number](const CameraSpec& spec) -> json {
    // A calibrated camera says it; and of two that mean the same the focal length counts.
    if (spec.calibration && is_calibrated(path)) return {};
    if (path == "hfov_deg" && spec.fx_px) return {};
    const auto found = spec.sampled.find(path);
    if (found != spec.sampled.end()) return found->second.to_json(quantity);
    return value_json(number(spec));
  };
  const auto set = [path, quantity, low, set_number](CameraSpec& spec, const json& value,
                                                     const FieldLocation& place) {
    const Distribution distribution =
        Distribution::read(value, quantity, place.pointer, place.problems);
    set_number(spec, value.is_number() ? value.get<double>() : low);
    if (value.is_object()) spec.sampled.emplace(path, distribution);
  };
  table.add(path, std::move(title), std::move(unit), std::move(values), get, set, std::move(help))
      .sampling = Sampling::in_place;
}

template <typename Access>
void add_number(FieldTable<CameraSpec>& table, const std::string& path, std::string title,
                std::string unit, double low, double high, Access access, std::string help) {
  add_number(
      table, path, std::move(title), std::move(unit), low, high,
      [access](const CameraSpec& spec) { return std::optional<double>(access(spec)); },
      [access](CameraSpec& spec, double value) { access(spec) = value; }, std::move(help));
}

/// In degrees, of an angle that is kept in radians.
GetNumber angle_getter(double camera::GimbalSpec::*member) {
  // Digits that degrees need beyond these are those of the conversion.
  constexpr double kDigits = 1e12;
  return [member](const CameraSpec& spec) {
    return std::round(spec.gimbal.*member / kDegree * kDigits) / kDigits;
  };
}

SetNumber angle_setter(double camera::GimbalSpec::*member) {
  return [member](CameraSpec& spec, double value) { spec.gimbal.*member = value * kDegree; };
}

FieldTable<CameraSpec>::Get unless_calibrated(int CameraSpec::*member) {
  return
      [member](const CameraSpec& spec) { return spec.calibration ? json() : json(spec.*member); };
}

FieldTable<CameraSpec>::Set set_size(int CameraSpec::*member) {
  return [member](CameraSpec& spec, const json& value, const FieldLocation& /*place*/) {
    value.get_to(spec.*member);
  };
}

json model_json(const CameraSpec& spec) {
  return spec.calibration ? json() : json(to_string(spec.lens.model));
}

void set_model(CameraSpec& spec, const json& value, const FieldLocation& /*place*/) {
  spec.lens.model = static_cast<camera::LensModel>(
      std::find(kModels.begin(), kModels.end(), value) - kModels.begin());
}

json gimbal_json(const CameraSpec& spec) {
  return kGimbals.at(static_cast<std::size_t>(spec.gimbal.model));
}

void set_gimbal(CameraSpec& spec, const json& value, const FieldLocation& /*place*/) {
  spec.gimbal.model = static_cast<camera::GimbalModel>(
      std::find(kGimbals.begin(), kGimbals.end(), value) - kGimbals.begin());
}

json metering_json(const CameraSpec& spec) { return kMeterings.at(spec.sensor.is_metered ? 0 : 1); }

void set_metering(CameraSpec& spec, const json& value, const FieldLocation& /*place*/) {
  spec.sensor.is_metered = value == kMeterings.front();
}

json calibration_json(const CameraSpec& spec) {
  return spec.calibration ? calibrate::to_json(*spec.calibration) : json();
}

void set_calibration(CameraSpec& spec, const json& value, const FieldLocation& place) {
  if (value.is_string()) {
    place.problems.push_back(
        {"", place.pointer, value.dump(), "the id of a calibration that has succeeded"});
    return;
  }
  try {
    spec.calibration = calibrate::camera_from_json(value, "");
  } catch (const InputError& error) {
    for (Problem problem : error.problems()) {
      problem.where = place.pointer + problem.where;
      place.problems.push_back(std::move(problem));
    }
    return;
  }
  const calibrate::CameraFile& camera = *spec.calibration;
  spec.calibrated = camera.intrinsics();
  spec.width = camera.size.width;
  spec.height = camera.size.height;
  spec.fx_px = camera.parameters[calibrate::kFx];
  spec.fy_px = camera.parameters[calibrate::kFy];
}

void add_lens_fields(FieldTable<CameraSpec>& table) {
  table.add("preset", "Preset", "", one_of_words(camera_presets()), at(&CameraSpec::preset),
            "A known camera, whose image size and field of view are defaults of the fields below "
            "(spec/job/cameras.json, with sources).");
  table.add("calibration", "Calibration", "",
            raw({{"type", {"string", "object"}}, {"maxLength", 1000}},
                "a camera file of throng calibrate, the id of a calibration, or such a camera"),
            calibration_json, set_calibration,
            "A real camera: frames have exactly its size, lens and distortion, instead of width, "
            "height, hfov_deg, fx_px to cy_px, model and distortion. A file is found beside the "
            "job's; the service takes ids. A recorded job holds the camera itself.");
  table.add("width", "Image width", "px", integers(64, 7680), unless_calibrated(&CameraSpec::width),
            set_size(&CameraSpec::width), "Columns of each image.");
  table.add("height", "Image height", "px", integers(64, 4320),
            unless_calibrated(&CameraSpec::height), set_size(&CameraSpec::height),
            "Rows of each image.");
  add_number(table, "hfov_deg", "Field of view", "degrees", 5, 150, at(&CameraSpec::hfov_deg),
             "Horizontal angle that the image covers, with the lens's distortion.");
  add_number(table, "fx_px", "Focal length", "px", 1, 100000, at(&CameraSpec::fx_px),
             "Of a calibrated camera, instead of hfov_deg.");
  add_number(table, "fy_px", "Vertical focal length", "px", 1, 100000, at(&CameraSpec::fy_px),
             "Of a calibrated camera; default: fx_px.");
  add_number(table, "cx_px", "Principal point, x", "px", -20000, 20000, at(&CameraSpec::cx_px),
             "Of a calibrated camera, 0 being the middle of the first column; default: the "
             "image's middle.");
  add_number(table, "cy_px", "Principal point, y", "px", -20000, 20000, at(&CameraSpec::cy_px),
             "Of a calibrated camera, 0 being the middle of the first row; default: the image's "
             "middle.");
  table.add("model", "Lens model", "", one_of_words(kModels), model_json, set_model,
            "pinhole: straight lines stay straight; brown_conrady and fisheye (Kannala and Brandt) "
            "as in OpenCV, with the coefficients of distortion.");
}

void add_distortion_fields(FieldTable<CameraSpec>& table) {
  table.group("distortion", "Distortion",
              "Coefficients of the lens model, by their names in OpenCV.");
  add_number(table, "distortion/k1", "k1", "", -100, 100,
             at(&CameraSpec::lens, &camera::LensSpec::k1), "Radial term of r² (fisheye: of θ³).");
  add_number(table, "distortion/k2", "k2", "", -100, 100,
             at(&CameraSpec::lens, &camera::LensSpec::k2), "Radial term of r⁴ (fisheye: of θ⁵).");
  add_number(table, "distortion/k3", "k3", "", -100, 100,
             at(&CameraSpec::lens, &camera::LensSpec::k3), "Radial term of r⁶ (fisheye: of θ⁷).");
  add_number(table, "distortion/k4", "k4", "", -100, 100,
             at(&CameraSpec::lens, &camera::LensSpec::k4),
             "Term of r² of the rational model's denominator (fisheye: of θ⁹).");
  add_number(table, "distortion/k5", "k5", "", -100, 100,
             at(&CameraSpec::lens, &camera::LensSpec::k5),
             "Term of r⁴ of the denominator; brown_conrady only.");
  add_number(table, "distortion/k6", "k6", "", -100, 100,
             at(&CameraSpec::lens, &camera::LensSpec::k6),
             "Term of r⁶ of the denominator; brown_conrady only.");
  add_number(table, "distortion/p1", "p1", "", -100, 100,
             at(&CameraSpec::lens, &camera::LensSpec::p1),
             "First tangential term; brown_conrady only.");
  add_number(table, "distortion/p2", "p2", "", -100, 100,
             at(&CameraSpec::lens, &camera::LensSpec::p2),
             "Second tangential term; brown_conrady only.");
}

void add_view_fields(FieldTable<CameraSpec>& table) {
  add_number(table, "pitch_deg", "Pitch", "degrees", camera::kMinGimbalPitchDeg,
             camera::kMaxGimbalPitchDeg, at(&CameraSpec::pitch_deg),
             "Angle above the horizon; -90 looks straight down.");
  add_number(table, "yaw_deg", "Yaw", "degrees", -camera::kMaxGimbalYawDeg,
             camera::kMaxGimbalYawDeg, at(&CameraSpec::yaw_deg),
             "Angle to the left of the drone's heading.");
  table.group("mount", "Mount", "Position of the camera's center on the drone.");
  const std::array<std::pair<const char*, const char*>, 3> axes{
      {{"x", "ahead"}, {"y", "to the left"}, {"z", "above"}}};
  for (int axis = 0; axis < 3; ++axis) {
    const auto& [name, direction] = axes.at(static_cast<std::size_t>(axis));
    add_number(
        table, std::string("mount/") + name + "_m", std::string("Mount ") + name, "m", -2, 2,
        [axis](const CameraSpec& spec) { return std::optional<double>(spec.mount_m[axis]); },
        [axis](CameraSpec& spec, double value) { spec.mount_m[axis] = value; },
        std::string("Distance from the drone's center, ") + direction + ".");
  }
  table.group("per_frame", "Per frame",
              "Differences from frame to frame: standard deviations of normal numbers that are "
              "sampled for each.");
  add_number(table, "per_frame/yaw_deg", "Yaw", "degrees", 0, 45,
             at(&CameraSpec::per_frame, &camera::FrameOffsets::yaw_deg),
             "Standard deviation of each frame's offset from yaw_deg.");
  add_number(table, "per_frame/pitch_deg", "Pitch", "degrees", 0, 45,
             at(&CameraSpec::per_frame, &camera::FrameOffsets::pitch_deg),
             "Standard deviation of each frame's offset from pitch_deg; their sum stays between "
             "-90 and 90.");
  add_number(table, "per_frame/ev", "Exposure", "EV", 0, 3,
             at(&CameraSpec::per_frame, &camera::FrameOffsets::ev),
             "Standard deviation of each frame's offset from sensor.ev.");
  add_number(table, "per_frame/white_balance_k", "White balance", "K", 0, 3000,
             at(&CameraSpec::per_frame, &camera::FrameOffsets::white_balance_k),
             "Standard deviation of each frame's offset from sensor.white_balance_k; their sum "
             "stays between 1667 and 25000.");
}

void add_body_fields(FieldTable<CameraSpec>& table) {
  table.group("gimbal", "Gimbal", "The stabilized mount of the camera.");
  table.add("gimbal/model", "Model", "", one_of_words(kGimbals), gimbal_json, set_gimbal,
            "ideal: exact direction; second_order: follows the heading as a damped second-order "
            "system, with jitter and a misaligned mount; rigid: no gimbal, the camera rolls and "
            "pitches with the drone.");
  add_number(table, "gimbal/natural_rad_s", "Natural frequency", "rad/s", 1, 100,
             at(&CameraSpec::gimbal, &camera::GimbalSpec::natural_rad_s),
             "Natural frequency of the response.");
  add_number(table, "gimbal/damping", "Damping", "", 0.1, 2,
             at(&CameraSpec::gimbal, &camera::GimbalSpec::damping),
             "Damping ratio of the response; 1: no overshoot.");
  add_number(table, "gimbal/jitter_deg", "Jitter", "degrees", 0, 5,
             angle_getter(&camera::GimbalSpec::jitter_rad),
             angle_setter(&camera::GimbalSpec::jitter_rad),
             "Standard deviation of the remaining vibration about each axis.");
  add_number(table, "gimbal/bias_deg", "Misalignment", "degrees", 0, 5,
             angle_getter(&camera::GimbalSpec::bias_rad),
             angle_setter(&camera::GimbalSpec::bias_rad),
             "Maximum error of the camera's mounting about each axis, sampled per run.");
  add_number(table, "gimbal/reading_deg", "Noise of the encoders", "degrees", 0, 5,
             angle_getter(&camera::GimbalSpec::reading_rad),
             angle_setter(&camera::GimbalSpec::reading_rad),
             "Standard deviation of the angles that the gimbal reports.");
  table.group("sensor", "Sensor", "Effects of sensor and shutter on the images.");
  table.add("sensor/metering", "Exposure metering", "", one_of_words(kMeterings), metering_json,
            set_metering,
            "image: each image's exposure follows the brightness of what it shows, people left "
            "out; light: only the light of hour and weather, the same for all images of a run.");
  add_number(table, "sensor/ev", "Exposure compensation", "EV", -6, 6,
             at(&CameraSpec::sensor, &camera::Sensor::ev), "Each 1 EV doubles the light.");
  add_number(table, "sensor/white_balance_k", "White balance", "K", 1667, 25000,
             at(&CameraSpec::sensor, &camera::Sensor::white_balance_k),
             "Color temperature that the camera assumes for white: below 6500 images turn blue, "
             "above yellow.");
  add_number(table, "sensor/vignette", "Vignetting", "", 0, 1,
             at(&CameraSpec::sensor, &camera::Sensor::vignette),
             "Share of the natural fall of light towards the corners, which is cos⁴ of the angle "
             "from the axis.");
  add_number(table, "sensor/color_shading", "Color shading", "", 0, 0.5,
             at(&CameraSpec::sensor, &camera::Sensor::color_shading),
             "Share of red and blue that is lost in the corners, which turn green.");
  add_number(
      table, "sensor/iso", "ISO", "", 0, 409600, at(&CameraSpec::sensor, &camera::Sensor::iso),
      "Sets the noise: full_well_e · 100 / iso electrons make white. 0: no noise. Default: as "
      "the light asks for at f/2.8 and 1/60 s, 1600 at most, and no noise below 400, as by "
      "day.");
  add_number(table, "sensor/min_iso", "Least automatic ISO", "", 0, 409600,
             at(&CameraSpec::sensor, &camera::Sensor::min_iso),
             "An automatic iso is at least this: real cameras have noise by day, too.");
  add_number(table, "sensor/full_well_e", "Full well", "electrons", 100, 1000000,
             at(&CameraSpec::sensor, &camera::Sensor::full_well_e),
             "Electrons that fill a pixel at ISO 100.");
  add_number(table, "sensor/read_noise_e", "Read noise", "electrons", 0, 1000,
             at(&CameraSpec::sensor, &camera::Sensor::read_noise_e),
             "Standard deviation of each reading.");
  add_number(table, "sensor/exposure_s", "Exposure time", "s", 0, 0.5,
             at(&CameraSpec::exposure, &camera::Exposure::exposure_s),
             "Duration for which each row gathers light, around the frame's time: moving objects "
             "are blurred. 0: an instant.");
  add_number(table, "sensor/readout_s", "Readout time", "s", 0, 0.5,
             at(&CameraSpec::exposure, &camera::Exposure::readout_s),
             "From the first row to the last, the middle one at the frame's time: moving objects "
             "are skewed. 0: all rows at once (global shutter).");
  add_number(table, "sensor/field_s", "Time between fields", "s", 0, 0.5,
             at(&CameraSpec::exposure, &camera::Exposure::field_s),
             "Interlaced video: the odd rows are this much older than the frame, whose labels are "
             "those of the even rows. 0: all rows are of one time.");
}

void add_processing_fields(FieldTable<CameraSpec>& table) {
  table.group("processing", "Processing",
              "Effects of the lens, the camera's signal processor and its encoder on the "
              "images, in this order. 0: none.");
  add_number(table, "processing/point_spread_px", "Point spread", "px", 0, 10,
             at(&CameraSpec::processing, &camera::Processing::point_spread_px),
             "Standard deviation of the Gaussian that a point of light becomes.");
  add_number(table, "processing/flare", "Flare", "", 0, 0.5,
             at(&CameraSpec::processing, &camera::Processing::flare),
             "Share of the light that the lens scatters over the image.");
  add_number(table, "processing/denoising", "Denoising", "", 0, 1,
             at(&CameraSpec::processing, &camera::Processing::denoising),
             "Strength of the filter that smooths noise, and fine texture with it.");
  add_number(table, "processing/tone_mapping", "Local tone mapping", "", 0, 1,
             at(&CameraSpec::processing, &camera::Processing::tone_mapping),
             "How far dark and bright regions are brought to the brightness of the whole.");
  add_number(table, "processing/sharpening", "Sharpening", "", 0, 5,
             at(&CameraSpec::processing, &camera::Processing::sharpening),
             "Gain of the unsharp mask, which draws bright and dark halos along edges.");
  add_number(table, "processing/bits_per_px", "Encoded size", "bits per pixel", 0, 24,
             at(&CameraSpec::processing, &camera::Processing::bits_per_px),
             "The image is encoded once to this size before it is written: blocks of 8 x 8 pixels, "
             "and half of the colors' resolution. 0: it is not.");
}

FieldTable<CameraSpec> make_camera_fields() {
  FieldTable<CameraSpec> table;
  add_lens_fields(table);
  add_distortion_fields(table);
  add_view_fields(table);
  add_body_fields(table);
  add_processing_fields(table);
  return table;
}

}  // namespace

const FieldTable<CameraSpec>& camera_fields() {
  static const FieldTable<CameraSpec> table = make_camera_fields();
  return table;
}

const char* to_string(camera::LensModel model) {
  return kModels.at(static_cast<std::size_t>(model));
}

std::span<const char* const> calibrated_fields() { return kCalibrated; }

}  // namespace throng::jobs
