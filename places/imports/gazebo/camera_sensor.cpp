#include "places/imports/gazebo/camera_sensor.h"

#include <sdf/sdf.hh>

#include "places/imports/sdf/sdf_pose.h"

namespace throng::imports {

bool is_camera(const sdf::Sensor& sensor) {
  switch (sensor.Type()) {
    case sdf::SensorType::CAMERA:
    case sdf::SensorType::WIDE_ANGLE_CAMERA:
    case sdf::SensorType::RGBD_CAMERA:
    case sdf::SensorType::DEPTH_CAMERA:
    case sdf::SensorType::THERMAL_CAMERA:
    case sdf::SensorType::SEGMENTATION_CAMERA:
    case sdf::SensorType::BOUNDINGBOX_CAMERA:
      return true;
    default:
      return false;
  }
}

std::optional<CameraSensor> read_camera_sensor(const sdf::Sensor& sensor,
                                               const Eigen::Isometry3d& link) {
  const sdf::Camera* lens = sensor.CameraSensor();
  const auto pose = resolved_pose(sensor.SemanticPose());
  if (lens == nullptr || !pose) return std::nullopt;
  CameraSensor camera;
  camera.name = sensor.Name();
  camera.pose = link * *pose;
  camera.is_color = sensor.Type() != sdf::SensorType::DEPTH_CAMERA &&
                    sensor.Type() != sdf::SensorType::THERMAL_CAMERA;
  camera.has_noise = lens->ImageNoise().Type() != sdf::NoiseType::NONE;
  camera.width = static_cast<int>(lens->ImageWidth());
  camera.height = static_cast<int>(lens->ImageHeight());
  camera.hfov_rad = lens->HorizontalFov().Radian();
  if (lens->HasLensIntrinsics()) {
    camera.intrinsics_px = Eigen::Vector4d(lens->LensIntrinsicsFx(), lens->LensIntrinsicsFy(),
                                           lens->LensIntrinsicsCx(), lens->LensIntrinsicsCy());
  }
  camera.distortion = {lens->DistortionK1(), lens->DistortionK2(), lens->DistortionK3(),
                       lens->DistortionP1(), lens->DistortionP2()};
  return camera;
}

}  // namespace throng::imports
