// MCAP recordings for ROS 2, one for each run with all of its drones: images, lenses, transforms,
// sensors and people, stamped with the frames' times.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "formats/dataset/image_camera.h"
#include "formats/dataset/raster_files.h"
#include "formats/dataset/sensor_table.h"
#include "formats/export/makers.h"
#include "formats/files/json_vectors.h"
#include "formats/files/ros_messages.h"
#include "formats/recording/drone_topics.h"
#include "formats/recording/recording.h"
#include "formats/recording/ros_names.h"
#include "formats/recording/run_topics.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

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

class McapExporter : public Exporter {
 public:
  McapExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)), classes_(info.class_names()) {}

  void add(const Image& image) override {
    try {
      write(image);
    } catch (const json::exception& error) {
      throw InputError(
          {(info_.root / kCocoFile).string(),
           fmt::format(
               "image {}, after topic {}", image.id,
               recording_ && !recording_->last_topic().empty() ? recording_->last_topic() : "none"),
           error.what(), "an image whose record says how its drone flew"});
    }
  }

  void finish() override { close(); }

 private:
  /// A drone in a run.
  struct Drone {
    ros::DroneTopics topics;
    std::optional<SensorTable> table;
  };

  void open_run(const Image& image) {
    if (image.run == run_) return;
    close();
    run_ = image.run;
    file_ = fmt::format("{}/{}.mcap", to_string(image.split), image.run);
    const fs::path path = output_.folder() / file_;
    fs::create_directories(path.parent_path());
    recording_ = std::make_unique<ros::Recording>(path);
    sink_ = [recording = recording_.get()](const ros::TopicMessage& message) {
      recording->add(message);
    };
    clock_.emplace(sink_);
    names_.emplace(info_.root.string());
  }

  void close() {
    if (recording_ != nullptr) {
      recording_->close();
      recording_.reset();
      output_.written(file_);
    }
    drones_.clear();
  }

  void write(const Image& image) {
    open_run(image);
    const std::string name = names_->name_of(image.camera);
    Drone& drone =
        drones_.try_emplace(image.camera, Drone{ros::DroneTopics(name, sink_), {}}).first->second;
    clock_->advance(image.time_s);
    add_flight(image, drone);
    add_pixels(image, drone.topics);
    add_people(image, drone.topics);
  }

  /// Poses of the drone and its camera, and the readings of its sensors. Of a dataset without
  /// flights only the camera is known.
  void add_flight(const Image& image, Drone& drone) {
    const ros::Pose camera = ros::camera_pose({image.R, image.t});
    const auto flight = image.record.find("flight");
    if (flight == image.record.end()) {
      drone.topics.publish_camera(image.time_s, camera);
      return;
    }
    const ros::Motion motion = read_motion(flight->at("true"));
    drone.topics.publish_transforms(image.time_s, motion.pose, camera);
    drone.topics.publish_odometry(image.time_s, motion);
    add_sensors(image, flight->at("measured"), drone);
  }

  /// All readings up to the image if the dataset has them, else the last ones before it.
  void add_sensors(const Image& image, const json& measured, Drone& drone) {
    const ros::GpsTraits gps{
        image.record.value("environment", json::object()).value("latitude_deg", 0.0),
        numbers_at<3>(measured.at("gps").at("position_sd_m"))};
    if (!info_.has(annotate::GroundTruth::sensors)) {
      drone.topics.publish_readings(reading_of_image(measured), gps);
      return;
    }
    const bool is_new = !drone.table.has_value();
    if (is_new) {
      drone.table.emplace(info_.root / "sensors" / image.run / (image.camera + ".csv"));
    }
    const double from_s = is_new ? image.time_s - kLeadS : 0;
    while (const auto row = drone.table->until(image.time_s)) {
      if (row->time_s >= from_s) drone.topics.publish_readings(*row, gps);
    }
  }

  void add_pixels(const Image& image, const ros::DroneTopics& topics) {
    const double time_s = image.time_s;
    const std::string root = topics.root() + "/camera";
    const ros::Header optical{topics.optical_frame(), time_s};
    topics.publish_image(time_s, image_camera(image).intrinsics,
                         image.file.ends_with(".png") ? "png" : "jpeg",
                         read_file(info_.root / image.file));
    const auto width = static_cast<std::uint32_t>(image.width);
    const auto height = static_cast<std::uint32_t>(image.height);
    if (info_.has(annotate::GroundTruth::depth)) {
      const std::vector<float> depth_m = read_depth(image);
      sink_({root + "/depth", ros::Kind::image, time_s,
             ros::image(optical, {width, height, "32FC1", sizeof(float), bytes_of_all(depth_m)})});
    }
    if (info_.has(annotate::GroundTruth::instances)) {
      const std::vector<std::uint32_t> ids = read_instances(
          raster_path(info_.root, "instances", image.file), image.width, image.height);
      sink_({root + "/instances", ros::Kind::image, time_s,
             ros::image(optical,
                        {width, height, "32SC1", sizeof(std::uint32_t), bytes_of_all(ids)})});
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

  void add_people(const Image& image, const ros::DroneTopics& topics) {
    const double time_s = image.time_s;
    const std::string root = topics.root() + "/ground_truth";
    ros::publish_boxes(sink_, topics.root(), time_s, person_boxes(image, classes_));
    sink_({root + "/detections_2d", ros::Kind::detections_2d, time_s,
           ros::detections_2d({topics.optical_frame(), time_s}, image_boxes(image, classes_))});
    sink_({root + "/annotations", ros::Kind::text, time_s,
           ros::text(webdataset_sample(image, info_).dump())});
  }

  const DatasetInfo& info_;
  Output output_;
  std::vector<std::string> classes_;
  std::string run_;
  std::string file_;  ///< of the run's recording, below the format's folder
  std::unique_ptr<ros::Recording> recording_;
  ros::MessageSink sink_;  ///< to the recording
  std::optional<ros::ClockTopic> clock_;
  std::optional<ros::RosNames> names_;   ///< of the run's drones
  std::map<std::string, Drone> drones_;  ///< of the run, by camera
};

}  // namespace

ExporterPointer make_mcap(const DatasetInfo& info, Output output) {
  return std::make_unique<McapExporter>(info, std::move(output));
}

}  // namespace throng::formats
