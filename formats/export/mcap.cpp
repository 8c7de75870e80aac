// MCAP recordings for ROS 2, one for each run with all of its drones: images, lenses, transforms,
// sensors and people, stamped with the frames' times.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/angle.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/raster_files.h"
#include "formats/dataset/sensor_table.h"
#include "formats/export/makers.h"
#include "formats/files/json_vectors.h"
#include "formats/files/mcap_file.h"
#include "formats/files/ros_messages.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kWorldFrame = "world";

/// Readings before the first image that are worth having (s): filters settle on them.
constexpr double kLeadS = 1;

ros::Motion read_motion(const json& truth) {
  ros::Motion motion;
  motion.pose.position = numbers_at<3>(truth.at("position"));
  motion.pose.rotation = quaternion_at(truth.at("orientation_wxyz"));
  motion.velocity_mps = motion.pose.rotation.inverse() * numbers_at<3>(truth.at("velocity"));
  motion.rates_rad_s = numbers_at<3>(truth.at("body_rates"));
  return motion;
}

/// Pose of the camera in the world.
ros::Pose camera_pose(const Image& image) {
  return {-image.R.transpose() * image.t, Eigen::Quaterniond(Eigen::Matrix3d(image.R.transpose()))};
}

ros::Pose relative_pose(const ros::Pose& parent, const ros::Pose& pose) {
  const Eigen::Quaterniond back = parent.rotation.inverse();
  return {back * (pose.position - parent.position), back * pose.rotation};
}

/// Position of a point of the world on the ellipsoid WGS 84: the origin lies at the image's
/// latitude and longitude 0, x leads to the east, y to the north.
ros::Fix geodetic_fix(const Eigen::Vector3d& position, double latitude_deg,
                      const Eigen::Vector3d& sd_m) {
  constexpr double kEquatorM = 6'378'137;
  constexpr double kEccentricity2 = 6.69437999014e-3;
  const double sine = std::sin(latitude_deg * kDegree);
  const double share = 1 - kEccentricity2 * sine * sine;
  const double east_radius_m = kEquatorM / std::sqrt(share);
  const double north_radius_m = east_radius_m * (1 - kEccentricity2) / share;
  const double cosine = std::max(std::cos(latitude_deg * kDegree), 1e-9);
  return {latitude_deg + position.y() / north_radius_m / kDegree,
          position.x() / (east_radius_m * cosine) / kDegree, position.z(), sd_m};
}

SensorRow reading_of_image(const json& measured) {
  const json& gps = measured.at("gps");
  return {
      measured.at("time_s").get<double>(),         numbers_at<3>(measured.at("gyro")),
      numbers_at<3>(measured.at("accelerometer")), numbers_at<3>(measured.at("magnetometer_ut")),
      measured.at("pressure_pa").get<double>(),    gps.at("time_s").get<double>(),
      numbers_at<3>(gps.at("position")),           numbers_at<3>(gps.at("velocity"))};
}

std::vector<ros::Box3> person_boxes(const Image& image, const std::vector<std::string>& classes) {
  std::vector<ros::Box3> boxes;
  boxes.reserve(image.people.size());
  for (const Person& person : image.people) {
    const Eigen::AngleAxisd turn(person.heading_rad, Eigen::Vector3d::UnitZ());
    boxes.push_back({person.number_in_run(),
                     classes.at(person.category),
                     {person.box_middle, Eigen::Quaterniond(turn)},
                     person.box_size});
  }
  return boxes;
}

std::vector<ros::Box2> image_boxes(const Image& image, const std::vector<std::string>& classes) {
  std::vector<ros::Box2> boxes;
  for (const std::vector<Person>* group : {&image.people, &image.objects}) {
    for (const Person& each : *group) {
      const Eigen::Vector2d size(each.box.width, each.box.height);
      boxes.push_back({each.number_in_run(), classes.at(each.category),
                       Eigen::Vector2d(each.box.x, each.box.y) + 0.5 * size, size});
    }
  }
  return boxes;
}

template <typename Number>
std::string_view bytes_of_all(const std::vector<Number>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
}

/// The recording of one run: its topics, each with the kind of its messages.
class Recording {
 public:
  explicit Recording(const fs::path& path) : file_(path) {}

  void publish(const std::string& topic, ros::Kind kind, double time_s,
               const std::string& message) {
    topic_ = topic;
    const auto [channel, is_new] = channels_.try_emplace(topic, 0);
    if (is_new) channel->second = file_.add_channel(topic, ros::make_schema(kind));
    file_.add(channel->second, ros::time_ns(time_s), message);
  }

  void close() { file_.close(); }
  const std::string& topic() const { return topic_; }

 private:
  McapFile file_;
  std::map<std::string, std::uint16_t> channels_;
  std::string topic_;  ///< the last one
};

class McapExporter : public Exporter {
 public:
  McapExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), classes_(info.class_names()) {}

  void add(const Image& image) override {
    try {
      write(image);
    } catch (const json::exception& error) {
      throw InputError({(info_.root / kCocoFile).string(),
                        fmt::format("image {}, after topic {}", image.id,
                                    recording_ ? recording_->topic() : "none"),
                        error.what(), "an image whose record says how its drone flew"});
    }
  }

  void finish() override { close(); }

 private:
  void open_run(const Image& image) {
    if (image.run == run_) return;
    close();
    run_ = image.run;
    file_ = fmt::format("{}/{}.mcap", to_string(image.split), image.run);
    const fs::path path = output_.folder() / file_;
    fs::create_directories(path.parent_path());
    recording_ = std::make_unique<Recording>(path);
    clock_s_ = -1;
  }

  void close() {
    if (recording_ != nullptr) {
      recording_->close();
      recording_.reset();
      output_.written(file_);
    }
    drones_.clear();
    names_.clear();
  }

  /// A drone's name in topics and frames: ROS has no '-' and no digit at the beginning.
  std::string ros_name(const std::string& camera) {
    std::string name = camera;
    std::replace(name.begin(), name.end(), '-', '_');
    if (std::isdigit(static_cast<unsigned char>(name.front())) != 0) name = "drone_" + name;
    const auto [found, is_new] = names_.try_emplace(name, camera);
    if (!is_new && found->second != camera) {
      throw InputError({info_.root.string(), "topics /" + name + "/...",
                        camera + " and " + found->second,
                        "drones whose names differ in ROS, which has no '-'"});
    }
    return name;
  }

  void write(const Image& image) {
    open_run(image);
    const std::string name = ros_name(image.camera);
    const double time_s = image.time_s;
    if (time_s > clock_s_) {
      recording_->publish("/clock", ros::Kind::clock, time_s, ros::clock(time_s));
      clock_s_ = time_s;
    }
    const ros::Header optical{name + "/camera_optical_frame", time_s};
    add_flight(image, name, optical);
    add_pixels(image, "/" + name + "/camera", optical);
    add_people(image, "/" + name, optical);
  }

  /// Poses of the drone and its camera, and the readings of its sensors. Of a dataset without
  /// flights only the camera is known.
  void add_flight(const Image& image, const std::string& name, const ros::Header& optical) {
    const double time_s = image.time_s;
    const ros::Pose camera = camera_pose(image);
    const auto flight = image.record.find("flight");
    if (flight == image.record.end()) {
      recording_->publish("/tf", ros::Kind::transforms, time_s,
                          ros::transforms(time_s, {{kWorldFrame, optical.frame, camera}}));
      return;
    }
    const std::string body = name + "/base_link";
    const ros::Motion motion = read_motion(flight->at("true"));
    recording_->publish(
        "/tf", ros::Kind::transforms, time_s,
        ros::transforms(time_s, {{kWorldFrame, body, motion.pose},
                                 {body, optical.frame, relative_pose(motion.pose, camera)}}));
    recording_->publish("/" + name + "/odometry", ros::Kind::odometry, time_s,
                        ros::odometry({kWorldFrame, time_s}, body, motion));
    add_sensors(image, flight->at("measured"), name);
  }

  /// All readings up to the image if the dataset has them, else the last ones before it.
  void add_sensors(const Image& image, const json& measured, const std::string& name) {
    const bool is_new = !drones_.contains(image.camera);
    Drone& drone = drones_[image.camera];
    const double latitude_deg =
        image.record.value("environment", json::object()).value("latitude_deg", 0.0);
    const Eigen::Vector3d sd_m = numbers_at<3>(measured.at("gps").at("position_sd_m"));
    const auto publish = [&](const SensorRow& row) {
      publish_readings(row, name, latitude_deg, sd_m, drone.last_fix_s);
    };
    if (!info_.has(annotate::GroundTruth::sensors)) {
      publish(reading_of_image(measured));
      return;
    }
    if (is_new) {
      drone.table.emplace(info_.root / "sensors" / image.run / (image.camera + ".csv"));
    }
    const double from_s = is_new ? image.time_s - kLeadS : 0;
    while (const auto row = drone.table->until(image.time_s)) {
      if (row->time_s >= from_s) publish(*row);
    }
  }

  void publish_readings(const SensorRow& row, const std::string& name, double latitude_deg,
                        const Eigen::Vector3d& sd_m, double& last_fix_s) {
    constexpr double kTeslaPerMicrotesla = 1e-6;
    const std::string root = "/" + name;
    const ros::Header body{name + "/base_link", row.time_s};
    recording_->publish(root + "/imu", ros::Kind::imu, row.time_s,
                        ros::imu(body, row.rates, row.acceleration));
    recording_->publish(root + "/magnetic_field", ros::Kind::magnetic_field, row.time_s,
                        ros::magnetic_field(body, kTeslaPerMicrotesla * row.field_ut));
    recording_->publish(root + "/pressure", ros::Kind::pressure, row.time_s,
                        ros::pressure(body, row.pressure_pa));
    if (row.gps_time_s <= last_fix_s) return;
    last_fix_s = row.gps_time_s;
    recording_->publish(
        root + "/fix", ros::Kind::fix, row.time_s,
        ros::fix({body.frame, row.gps_time_s}, geodetic_fix(row.gps_position, latitude_deg, sd_m)));
    recording_->publish(root + "/fix_velocity", ros::Kind::velocity, row.time_s,
                        ros::velocity({kWorldFrame, row.gps_time_s}, row.gps_velocity));
  }

  void add_pixels(const Image& image, const std::string& root, const ros::Header& optical) {
    const double time_s = image.time_s;
    const bool is_png = image.file.ends_with(".png");
    recording_->publish(root + "/camera_info", ros::Kind::camera_info, time_s,
                        ros::camera_info(optical, image_camera(image).intrinsics));
    recording_->publish(root + "/image_color/compressed", ros::Kind::compressed_image, time_s,
                        ros::compressed_image(optical, is_png ? "png" : "jpeg",
                                              read_file(info_.root / image.file)));
    const auto width = static_cast<std::uint32_t>(image.width);
    const auto height = static_cast<std::uint32_t>(image.height);
    if (info_.has(annotate::GroundTruth::depth)) {
      const std::vector<float> depth_m = read_depth(image);
      recording_->publish(
          root + "/depth", ros::Kind::image, time_s,
          ros::image(optical, {width, height, "32FC1", sizeof(float), bytes_of_all(depth_m)}));
    }
    if (info_.has(annotate::GroundTruth::instances)) {
      const std::vector<std::uint32_t> ids = read_instances(
          raster_path(info_.root, "instances", image.file), image.width, image.height);
      recording_->publish(
          root + "/instances", ros::Kind::image, time_s,
          ros::image(optical, {width, height, "32SC1", sizeof(std::uint32_t), bytes_of_all(ids)}));
    }
  }

  /// Meters along the optical axis; infinity where nothing is.
  std::vector<float> read_depth(const Image& image) const {
    const fs::path path = raster_path(info_.root, "depth", image.file);
    const images::Raster depth = images::read_raster(path);
    if (depth.width != image.width || depth.height != image.height) {
      throw InputError({path.string(), "", fmt::format("{} x {} pixels", depth.width, depth.height),
                        fmt::format("{} x {}", image.width, image.height)});
    }
    return depth_meters(depth);
  }

  void add_people(const Image& image, const std::string& root, const ros::Header& optical) {
    const double time_s = image.time_s;
    const ros::Header world{kWorldFrame, time_s};
    const std::vector<ros::Box3> boxes = person_boxes(image, classes_);
    recording_->publish(root + "/ground_truth/boxes", ros::Kind::markers, time_s,
                        ros::markers(world, boxes));
    recording_->publish(root + "/ground_truth/detections_3d", ros::Kind::detections_3d, time_s,
                        ros::detections_3d(world, boxes));
    recording_->publish(root + "/ground_truth/detections_2d", ros::Kind::detections_2d, time_s,
                        ros::detections_2d(optical, image_boxes(image, classes_)));
    recording_->publish(root + "/ground_truth/annotations", ros::Kind::text, time_s,
                        ros::text(webdataset_sample(image, info_).dump()));
  }

  /// Knowledge of a drone's sensors in a run.
  struct Drone {
    std::optional<SensorTable> table;
    double last_fix_s = -1;
  };

  const DatasetInfo& info_;
  Output output_;
  std::vector<std::string> classes_;
  std::string run_;
  std::string file_;  ///< of the run's recording, below the format's folder
  std::unique_ptr<Recording> recording_;
  double clock_s_ = -1;                       ///< time of the last /clock
  std::map<std::string, Drone> drones_;       ///< of the run, by camera
  std::map<std::string, std::string> names_;  ///< cameras of the run, by their names in ROS
};

}  // namespace

ExporterPointer make_mcap(const DatasetInfo& info, Output output) {
  return std::make_unique<McapExporter>(info, std::move(output));
}

}  // namespace throng::formats
