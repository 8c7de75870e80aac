#include "render/props/airframe_mesh.h"

#include <cmath>

#include "render/frame/frame.h"
#include "render/props/prop_builder.h"

namespace throng::render {

namespace {

using Eigen::Vector3d;

const Vector3d kShell(0.55, 0.56, 0.58);
const Vector3d kCarbon(0.03, 0.03, 0.035);
const Vector3d kPlastic(0.08, 0.08, 0.09);
const Vector3d kRed(0.8, 0.04, 0.03);
const Vector3d kGreen(0.03, 0.6, 0.08);

/// Two blades across a rotor's axis.
void add_blades(PropBuilder& builder, const Vector3d& hub, double radius_m, double turn_rad) {
  const Vector3d along(radius_m * std::cos(turn_rad), radius_m * std::sin(turn_rad), 0);
  const Vector3d across = 0.09 * Vector3d(-along.y(), along.x(), 0);
  builder.quad(
      {hub - along - across, hub + along - across, hub + along + across, hub - along + across},
      kCarbon, Finish::matt);
}

void add_arm(PropBuilder& builder, const AirframeShape& shape, std::size_t rotor, double middle_z) {
  const double x = shape.rotors_m.at(rotor).x();
  const double y = shape.rotors_m.at(rotor).y();
  const double h = shape.height_m;
  const double thickness = 0.055 * shape.arm_m;
  builder.tube({0, 0, middle_z}, 1.4 * thickness, {x, y, middle_z}, thickness, kPlastic);
  builder.tube({x, y, middle_z - 0.25 * h}, 1.8 * thickness, {x, y, middle_z + 0.35 * h},
               1.8 * thickness, kCarbon, Finish::glossy);
  add_blades(builder, {x, y, middle_z + 0.42 * h}, shape.propeller_radius_m,
             0.3 + 0.9 * static_cast<double>(rotor));
  // Lights as aircraft have them: red on the left, green on the right.
  const double size = thickness;
  const Vector3d lamp(0.93 * x, 0.93 * y, middle_z - 0.2 * h);
  builder.box(lamp.array() - size, lamp.array() + size, y > 0 ? kRed : kGreen, Finish::lamp);
}

void add_skid(PropBuilder& builder, const AirframeShape& shape, double side, double top_z) {
  const double a = shape.arm_m;
  const double foot_z = top_z - 0.9 * shape.height_m;
  const double radius = 0.03 * a;
  const double y = side * 0.38 * a;
  builder.tube({-0.4 * a, y, foot_z}, radius, {0.4 * a, y, foot_z}, radius, kPlastic, Finish::matt,
               6);
  for (const double x : {-0.22 * a, 0.22 * a}) {
    builder.tube({x, side * 0.2 * a, top_z}, radius, {x, y, foot_z}, radius, kPlastic, Finish::matt,
                 6);
  }
}

}  // namespace

AirframeShape airframe_shape(const sim::Airframe& airframe) {
  AirframeShape shape{airframe.arm_m, airframe.height_m, airframe.propeller_radius_m};
  for (std::size_t i = 0; i < shape.rotors_m.size(); ++i) {
    shape.rotors_m[i] = airframe.rotors[i].at_m;
  }
  return shape;
}

PropMesh airframe_mesh(const DroneInstance& drone) {
  const AirframeShape& shape = drone.shape;
  const double a = shape.arm_m;
  const double h = shape.height_m;
  // The builder leaves out what faces the ground at z = 0, so everything is put above it first.
  const double middle_z = 2 * h;
  const world::Prop as_prop;
  PropBuilder builder(as_prop, kIdDrone + drone.drone);
  const auto rectangle = [&](double x, double y) {
    return Eigen::AlignedBox2d(Eigen::Vector2d(-x, -y), Eigen::Vector2d(x, y));
  };
  builder.block(rectangle(0.42 * a, 0.26 * a), middle_z - 0.35 * h, rectangle(0.46 * a, 0.3 * a),
                middle_z, kShell, Finish::glossy);
  builder.block(rectangle(0.46 * a, 0.3 * a), middle_z, rectangle(0.3 * a, 0.18 * a),
                middle_z + 0.5 * h, kShell, Finish::glossy);
  builder.box({0.3 * a, -0.1 * a, middle_z - 0.75 * h}, {0.5 * a, 0.1 * a, middle_z - 0.3 * h},
              kCarbon, Finish::glossy);
  for (std::size_t i = 0; i < shape.rotors_m.size(); ++i) add_arm(builder, shape, i, middle_z);
  for (const double side : {-1.0, 1.0}) add_skid(builder, shape, side, middle_z - 0.3 * h);
  PropMesh mesh = builder.take();
  const Eigen::Matrix3d turn = drone.orientation.toRotationMatrix();
  for (PropVertex& vertex : mesh.vertices) {
    const Eigen::Map<Eigen::Vector3f> position(vertex.position.data());
    Eigen::Map<Eigen::Vector3f> place(vertex.position.data());
    Eigen::Map<Eigen::Vector3f> normal(vertex.normal.data());
    const Vector3d own = position.cast<double>() - Vector3d(0, 0, middle_z);
    place = (turn * own + drone.position).cast<float>();
    normal = (turn * normal.cast<double>()).cast<float>().eval();
  }
  return mesh;
}

}  // namespace throng::render
