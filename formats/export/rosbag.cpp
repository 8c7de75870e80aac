// ROS 1 bags, one for each run with all of its drones: images, calibration, transforms, odometry,
// IMU and people, stamped with the frames' times.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/csv.h"
#include "formats/dataset/image_camera.h"
#include "formats/export/makers.h"
#include "formats/files/bag_file.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kWorldFrame = "world";

/// Readings before the first image that are worth having (s): filters settle on them.
constexpr double kLeadS = 1;

Eigen::Vector3d vector_in(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

/// An inertial unit's reading.
struct InertialReading {
  double time_s = 0;
  Eigen::Vector3d rates = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();
};

/// The dataset's table of a drone's sensors (sensors/RUN/CAMERA.csv), read line by line.
class SensorTable {
 public:
  explicit SensorTable(fs::path path) : path_(std::move(path)), file_(path_) {
    std::string header;
    if (!std::getline(file_, header)) {
      throw InputError({path_.string(), "", "no header", "a table of sensors"});
    }
    const std::vector<std::string> names = csv_cells(header);
    for (const char* name :
         {"time_s", "gyro_x_rad_s", "gyro_y_rad_s", "gyro_z_rad_s", "accelerometer_x_mps2",
          "accelerometer_y_mps2", "accelerometer_z_mps2"}) {
      const auto found = std::find(names.begin(), names.end(), name);
      if (found == names.end()) {
        throw InputError({path_.string(), "line 1", header, std::string("a column ") + name});
      }
      columns_.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    step();
  }

  /// The next reading if it is not later than `time_s`.
  std::optional<InertialReading> until(double time_s) {
    if (!next_ || next_->time_s > time_s) return std::nullopt;
    const InertialReading reading = *next_;
    step();
    return reading;
  }

 private:
  void step() {
    next_.reset();
    std::string line;
    ++number_;
    if (!std::getline(file_, line)) return;
    const std::vector<std::string> cells = csv_cells(line);
    std::vector<double> values;
    for (const std::size_t column : columns_) {
      char* end = nullptr;
      const std::string cell = column < cells.size() ? cells[column] : "";
      values.push_back(std::strtod(cell.c_str(), &end));
      if (cell.empty() || *end != '\0') {
        throw InputError({path_.string(), fmt::format("line {}", number_), cell, "a number"});
      }
    }
    next_ = {values[0], {values[1], values[2], values[3]}, {values[4], values[5], values[6]}};
  }

  fs::path path_;
  std::ifstream file_;
  std::vector<std::size_t> columns_;
  std::optional<InertialReading> next_;
  std::size_t number_ = 1;
};

BagMotion read_motion(const json& truth) {
  BagMotion motion;
  motion.pose.position = vector_in(truth.at("position"));
  const json& q = truth.at("orientation_wxyz");
  motion.pose.rotation = Eigen::Quaterniond(q.at(0).get<double>(), q.at(1).get<double>(),
                                            q.at(2).get<double>(), q.at(3).get<double>());
  motion.velocity_mps = motion.pose.rotation.inverse() * vector_in(truth.at("velocity"));
  motion.rates_rad_s = vector_in(truth.at("body_rates"));
  return motion;
}

/// Pose of the camera in the world.
BagPose pose_of_camera(const Image& image) {
  return {-image.R.transpose() * image.t, Eigen::Quaterniond(Eigen::Matrix3d(image.R.transpose()))};
}

BagPose relative_to(const BagPose& parent, const BagPose& pose) {
  const Eigen::Quaterniond back = parent.rotation.inverse();
  return {back * (pose.position - parent.position), back * pose.rotation};
}

std::vector<BagBox> make_boxes(const Image& image) {
  std::vector<BagBox> boxes;
  boxes.reserve(image.people.size());
  for (const Person& person : image.people) {
    const Eigen::AngleAxisd turn(person.heading_rad, Eigen::Vector3d::UnitZ());
    boxes.push_back({static_cast<std::int32_t>(person.number_in_run()),
                     {person.box_middle, Eigen::Quaterniond(turn)},
                     person.box_size});
  }
  return boxes;
}

class RosbagExporter : public Exporter {
 public:
  RosbagExporter(const DatasetInfo& info, Output output, bool is_compressed)
      : info_(info), output_(std::move(output)), is_compressed_(is_compressed) {}

  void add(const Image& image) override {
    guarded([&] { write(image); });
  }

  void finish() override {
    guarded([&] { close(); });
  }

 private:
  /// ROS reports disks that refuse in its own way.
  template <typename Work>
  void guarded(const Work& work) {
    try {
      work();
    } catch (const InputError&) {
      throw;
    } catch (const EnvironmentError&) {
      throw;
    } catch (const json::exception& error) {
      throw InputError({(info_.root / kCocoFile).string(), run_, error.what(),
                        "an image whose record says how its drone flew"});
    } catch (const std::runtime_error& error) {
      throw EnvironmentError(fmt::format("cannot write the bag of {}: {}", run_, error.what()));
    }
  }

  void open_run(const Image& image) {
    if (image.run == run_) return;
    close();
    run_ = image.run;
    place_ = fmt::format("{}/{}.bag", to_string(image.split), image.run);
    const fs::path path = output_.folder() / place_;
    fs::create_directories(path.parent_path());
    bag_ = std::make_unique<BagFile>(path, is_compressed_);
  }

  void close() {
    if (bag_ != nullptr) {
      bag_->close();
      bag_.reset();
      output_.written(place_);
    }
    tables_.clear();
    names_.clear();
  }

  /// A drone's name in topics and frames, where ROS has no '-'.
  std::string ros_name(const std::string& camera) {
    std::string name = camera;
    std::replace(name.begin(), name.end(), '-', '_');
    const auto [found, is_new] = names_.try_emplace(name, camera);
    if (!is_new && found->second != camera) {
      throw InputError({info_.root.string(), "", camera + " and " + found->second,
                        "drones whose names differ in ROS, which has no '-'"});
    }
    return name;
  }

  void write(const Image& image) {
    open_run(image);
    const std::string name = ros_name(image.camera);
    const std::string body_frame = name + "/base_link";
    const std::string optical_frame = name + "/camera_optical_frame";
    const std::string root = "/" + name;
    const double time_s = image.time_s;
    add_flight(image, root, body_frame, optical_frame);
    bag_->add_lens(root + "/camera/camera_info", optical_frame, time_s,
                   image_camera(image).intrinsics);
    bag_->add_image(root + "/camera/image_color/compressed", optical_frame, time_s,
                    read_file(info_.root / image.file));
    bag_->add_boxes(root + "/ground_truth/boxes", kWorldFrame, time_s, make_boxes(image));
    bag_->add_text(root + "/ground_truth/annotations", time_s,
                   webdataset_sample(image, info_).dump());
  }

  /// Poses of the drone and its camera, and the readings of its inertial unit. Of a dataset without
  /// flights only the camera is known.
  void add_flight(const Image& image, const std::string& root, const std::string& body_frame,
                  const std::string& optical_frame) {
    const BagPose camera = pose_of_camera(image);
    const auto flight = image.record.find("flight");
    if (flight == image.record.end()) {
      bag_->add_transforms(image.time_s, {{kWorldFrame, optical_frame, camera}});
      return;
    }
    const BagMotion motion = read_motion(flight->at("true"));
    bag_->add_transforms(image.time_s,
                         {{kWorldFrame, body_frame, motion.pose},
                          {body_frame, optical_frame, relative_to(motion.pose, camera)}});
    bag_->add_odometry(root + "/odometry", kWorldFrame, body_frame, image.time_s, motion);
    add_inertial(image, flight->at("measured"), root + "/imu", body_frame);
  }

  /// All readings up to the image if the dataset has them, else the last one before it.
  void add_inertial(const Image& image, const json& measured, const std::string& topic,
                    const std::string& frame) {
    if (!info_.has(annotate::GroundTruth::sensors)) {
      bag_->add_imu(topic, frame, measured.at("time_s").get<double>(),
                    vector_in(measured.at("gyro")), vector_in(measured.at("accelerometer")));
      return;
    }
    const auto [table, is_new] = tables_.try_emplace(
        image.camera, info_.root / "sensors" / image.run / (image.camera + ".csv"));
    const double from_s = is_new ? image.time_s - kLeadS : 0;
    while (const auto reading = table->second.until(image.time_s)) {
      if (reading->time_s < from_s) continue;
      bag_->add_imu(topic, frame, reading->time_s, reading->rates, reading->acceleration);
    }
  }

  const DatasetInfo& info_;
  Output output_;
  bool is_compressed_;
  std::string run_;
  std::unique_ptr<BagFile> bag_;
  std::string place_;                          ///< of the bag, below the format's folder
  std::map<std::string, SensorTable> tables_;  ///< of the run, by camera
  std::map<std::string, std::string> names_;   ///< cameras of the run, by their names in ROS
};

}  // namespace

ExporterPointer make_rosbag(const DatasetInfo& info, Output output) {
  return std::make_unique<RosbagExporter>(info, std::move(output), false);
}

ExporterPointer make_rosbag_lz4(const DatasetInfo& info, Output output) {
  return std::make_unique<RosbagExporter>(info, std::move(output), true);
}

}  // namespace throng::formats
