#include "formats/recording/drone_topics.h"

#include <utility>

#include "formats/recording/geodetic_fix.h"
#include "formats/recording/run_topics.h"

namespace throng::formats::ros {

namespace {

Pose relative_pose(const Pose& parent, const Pose& pose) {
  const Eigen::Quaterniond back = parent.rotation.inverse();
  return {back * (pose.position - parent.position), back * pose.rotation};
}

}  // namespace

Pose camera_pose(const camera::Pose& camera) {
  return {-camera.R.transpose() * camera.t,
          Eigen::Quaterniond(Eigen::Matrix3d(camera.R.transpose()))};
}

DroneTopics::DroneTopics(const std::string& name, MessageSink sink)
    : sink_(std::move(sink)),
      root_("/" + name),
      body_frame_(name + "/base_link"),
      optical_frame_(name + "/camera_optical_frame") {}

void DroneTopics::publish(const char* topic, Kind kind, double time_s, std::string bytes) const {
  sink_({root_ + topic, kind, time_s, std::move(bytes)});
}

void DroneTopics::publish_transforms(double time_s, const Pose& body, const Pose& camera) const {
  sink_({"/tf", Kind::transforms, time_s,
         transforms(time_s, {{kWorldFrame, body_frame_, body},
                             {body_frame_, optical_frame_, relative_pose(body, camera)}})});
}

void DroneTopics::publish_camera(double time_s, const Pose& camera) const {
  sink_({"/tf", Kind::transforms, time_s,
         transforms(time_s, {{kWorldFrame, optical_frame_, camera}})});
}

void DroneTopics::publish_odometry(double time_s, const Motion& motion) const {
  publish("/odometry", Kind::odometry, time_s,
          odometry({kWorldFrame, time_s}, body_frame_, motion));
}

void DroneTopics::publish_readings(const SensorRow& row, const GpsTraits& gps) {
  constexpr double kTeslaPerMicrotesla = 1e-6;
  const Header body{body_frame_, row.time_s};
  publish("/imu", Kind::imu, row.time_s, imu(body, row.rates, row.acceleration));
  publish("/magnetic_field", Kind::magnetic_field, row.time_s,
          magnetic_field(body, kTeslaPerMicrotesla * row.field_ut));
  publish("/pressure", Kind::pressure, row.time_s, pressure(body, row.pressure_pa));
  if (row.gps_time_s <= last_fix_s_) return;
  last_fix_s_ = row.gps_time_s;
  publish("/fix", Kind::fix, row.time_s,
          fix({body_frame_, row.gps_time_s},
              geodetic_fix(row.gps_position, gps.latitude_deg, gps.position_sd_m)));
  publish("/fix_velocity", Kind::velocity, row.time_s,
          velocity({kWorldFrame, row.gps_time_s}, row.gps_velocity));
}

void DroneTopics::publish_image(double time_s, const camera::Intrinsics& lens,
                                std::string_view format, std::string_view bytes) const {
  const Header optical{optical_frame_, time_s};
  publish("/camera/camera_info", Kind::camera_info, time_s, camera_info(optical, lens));
  publish("/camera/image_color/compressed", Kind::compressed_image, time_s,
          compressed_image(optical, format, bytes));
}

}  // namespace throng::formats::ros
