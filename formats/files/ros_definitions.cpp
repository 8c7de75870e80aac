// Definitions of ROS 2 messages (Humble and later), without their comments, constants and defaults.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "formats/files/ros_messages.h"

namespace throng::formats::ros {

namespace {

/// A message's name and its fields, one per line.
struct Definition {
  std::string_view name;
  std::string_view fields;
};

constexpr std::array kDefinitions{
    Definition{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    Definition{"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    Definition{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    Definition{"std_msgs/String", "string data\n"},
    Definition{"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    Definition{"rosgraph_msgs/Clock", "builtin_interfaces/Time clock\n"},
    Definition{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    Definition{"geometry_msgs/Pose",
               "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    Definition{"geometry_msgs/PoseWithCovariance",
               "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    Definition{"geometry_msgs/Twist",
               "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    Definition{"geometry_msgs/TwistWithCovariance",
               "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    Definition{"geometry_msgs/TwistStamped", "std_msgs/Header header\ngeometry_msgs/Twist twist\n"},
    Definition{"geometry_msgs/Transform",
               "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    Definition{"geometry_msgs/TransformStamped",
               "std_msgs/Header header\nstring child_frame_id\n"
               "geometry_msgs/Transform transform\n"},
    Definition{"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    Definition{"nav_msgs/Odometry",
               "std_msgs/Header header\nstring child_frame_id\n"
               "geometry_msgs/PoseWithCovariance pose\n"
               "geometry_msgs/TwistWithCovariance twist\n"},
    Definition{"sensor_msgs/Image",
               "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\n"
               "uint8 is_bigendian\nuint32 step\nuint8[] data\n"},
    Definition{"sensor_msgs/CompressedImage",
               "std_msgs/Header header\nstring format\nuint8[] data\n"},
    Definition{"sensor_msgs/RegionOfInterest",
               "uint32 x_offset\nuint32 y_offset\nuint32 height\nuint32 width\nbool do_rectify\n"},
    Definition{"sensor_msgs/CameraInfo",
               "std_msgs/Header header\nuint32 height\nuint32 width\nstring distortion_model\n"
               "float64[] d\nfloat64[9] k\nfloat64[9] r\nfloat64[12] p\nuint32 binning_x\n"
               "uint32 binning_y\nsensor_msgs/RegionOfInterest roi\n"},
    Definition{"sensor_msgs/Imu",
               "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\n"
               "float64[9] orientation_covariance\ngeometry_msgs/Vector3 angular_velocity\n"
               "float64[9] angular_velocity_covariance\n"
               "geometry_msgs/Vector3 linear_acceleration\n"
               "float64[9] linear_acceleration_covariance\n"},
    Definition{"sensor_msgs/NavSatStatus", "int8 status\nuint16 service\n"},
    Definition{"sensor_msgs/NavSatFix",
               "std_msgs/Header header\nsensor_msgs/NavSatStatus status\nfloat64 latitude\n"
               "float64 longitude\nfloat64 altitude\nfloat64[9] position_covariance\n"
               "uint8 position_covariance_type\n"},
    Definition{"sensor_msgs/MagneticField",
               "std_msgs/Header header\ngeometry_msgs/Vector3 magnetic_field\n"
               "float64[9] magnetic_field_covariance\n"},
    Definition{"sensor_msgs/FluidPressure",
               "std_msgs/Header header\nfloat64 fluid_pressure\nfloat64 variance\n"},
    Definition{"vision_msgs/ObjectHypothesis", "string class_id\nfloat64 score\n"},
    Definition{"vision_msgs/ObjectHypothesisWithPose",
               "vision_msgs/ObjectHypothesis hypothesis\n"
               "geometry_msgs/PoseWithCovariance pose\n"},
    Definition{"vision_msgs/Point2D", "float64 x\nfloat64 y\n"},
    Definition{"vision_msgs/Pose2D", "vision_msgs/Point2D position\nfloat64 theta\n"},
    Definition{"vision_msgs/BoundingBox2D",
               "vision_msgs/Pose2D center\nfloat64 size_x\nfloat64 size_y\n"},
    Definition{"vision_msgs/BoundingBox3D",
               "geometry_msgs/Pose center\ngeometry_msgs/Vector3 size\n"},
    Definition{"vision_msgs/Detection2D",
               "std_msgs/Header header\nvision_msgs/ObjectHypothesisWithPose[] results\n"
               "vision_msgs/BoundingBox2D bbox\nstring id\n"},
    Definition{"vision_msgs/Detection2DArray",
               "std_msgs/Header header\nvision_msgs/Detection2D[] detections\n"},
    Definition{"vision_msgs/Detection3D",
               "std_msgs/Header header\nvision_msgs/ObjectHypothesisWithPose[] results\n"
               "vision_msgs/BoundingBox3D bbox\nstring id\n"},
    Definition{"vision_msgs/Detection3DArray",
               "std_msgs/Header header\nvision_msgs/Detection3D[] detections\n"},
    Definition{"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    Definition{"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    Definition{"visualization_msgs/Marker",
               "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
               "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
               "builtin_interfaces/Duration lifetime\nbool frame_locked\n"
               "geometry_msgs/Point[] points\nstd_msgs/ColorRGBA[] colors\n"
               "string texture_resource\nsensor_msgs/CompressedImage texture\n"
               "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\n"
               "string mesh_resource\nvisualization_msgs/MeshFile mesh_file\n"
               "bool mesh_use_embedded_materials\n"},
    Definition{"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"},
};

std::string_view message_name(Kind kind) {
  switch (kind) {
    case Kind::clock:
      return "rosgraph_msgs/Clock";
    case Kind::transforms:
      return "tf2_msgs/TFMessage";
    case Kind::image:
      return "sensor_msgs/Image";
    case Kind::compressed_image:
      return "sensor_msgs/CompressedImage";
    case Kind::camera_info:
      return "sensor_msgs/CameraInfo";
    case Kind::imu:
      return "sensor_msgs/Imu";
    case Kind::fix:
      return "sensor_msgs/NavSatFix";
    case Kind::magnetic_field:
      return "sensor_msgs/MagneticField";
    case Kind::pressure:
      return "sensor_msgs/FluidPressure";
    case Kind::odometry:
      return "nav_msgs/Odometry";
    case Kind::velocity:
      return "geometry_msgs/TwistStamped";
    case Kind::detections_2d:
      return "vision_msgs/Detection2DArray";
    case Kind::detections_3d:
      return "vision_msgs/Detection3DArray";
    case Kind::markers:
      return "visualization_msgs/MarkerArray";
    case Kind::text:
      return "std_msgs/String";
  }
  check(false, "all kinds of messages have names");
  return "";
}

const Definition& definition(std::string_view name) {
  const auto found = std::find_if(kDefinitions.begin(), kDefinitions.end(),
                                  [&](const Definition& each) { return each.name == name; });
  check(found != kDefinitions.end(), "all parts of messages are defined");
  return *found;
}

/// Adds the messages that are fields of one, and those in them, each once.
void add_parts(const Definition& message, std::vector<std::string_view>& parts) {
  std::string_view fields = message.fields;
  while (!fields.empty()) {
    const std::string_view type = fields.substr(0, fields.find_first_of(" ["));
    fields.remove_prefix(fields.find('\n') + 1);
    if (type.find('/') == std::string_view::npos) continue;
    if (std::find(parts.begin(), parts.end(), type) != parts.end()) continue;
    parts.push_back(type);
    add_parts(definition(type), parts);
  }
}

}  // namespace

McapSchema make_schema(Kind kind) {
  const Definition& message = definition(message_name(kind));
  std::vector<std::string_view> parts;
  add_parts(message, parts);
  std::string text(message.fields);
  constexpr std::size_t kRule = 80;
  for (const std::string_view part : parts) {
    text += std::string(kRule, '=') + "\nMSG: " + std::string(part) + "\n";
    text += definition(part).fields;
  }
  std::string name(message.name);
  name.insert(name.find('/'), "/msg");
  return {name, "ros2msg", text};
}

}  // namespace throng::formats::ros
