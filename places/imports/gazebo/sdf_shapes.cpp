#include "places/imports/gazebo/sdf_shapes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sdf/sdf.hh>

#include "base/error.h"
#include "base/geometry/polygon.h"
#include "places/imports/gazebo/gazebo_colors.h"
#include "places/imports/gazebo/mesh_reader.h"

namespace throng::imports {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kMaxSizeM = 10'000;

Vector3d to_vector(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

[[noreturn]] void reject(const std::string& found, const std::string& expected) {
  throw InputError(Problem{"", "", found, expected});
}

double size_within(double size) {
  if (!(size > 0 && size <= kMaxSizeM)) {
    reject(fmt::format("a size of {:g} m", size), "a size above 0 and up to 10 km");
  }
  return size;
}

Vector3d size_within(const Vector3d& size) {
  return {size_within(size.x()), size_within(size.y()), size_within(size.z())};
}

bool is_upright(const Isometry3d& pose) {
  constexpr double kCosineOfADegree = 0.99985;
  return std::abs(pose.linear()(2, 2)) > kCosineOfADegree;
}

// A prism about the pose's z.
Body prism(const Corners& outline, double length, const Isometry3d& pose) {
  Body body;
  Solid solid;
  solid.triangles = prism_triangles(outline, -0.5 * length, 0.5 * length);
  move(solid.triangles, pose);
  body.solids.push_back(std::move(solid));
  if (!is_upright(pose)) return body;
  Corners corners;
  for (const Vector2d& corner : outline) {
    corners.emplace_back((pose * Vector3d(corner.x(), corner.y(), 0)).head<2>());
  }
  if (auto tidy = tidied({corners, {}})) body.footprint = tidy->outline;
  body.from_z = pose.translation().z() - 0.5 * length;
  body.to_z = pose.translation().z() + 0.5 * length;
  return body;
}

Body ball(const Vector3d& radii, double stretch, const Isometry3d& pose) {
  Body body;
  Solid solid;
  solid.triangles = ball_triangles(radii, stretch);
  move(solid.triangles, pose);
  body.solids.push_back(std::move(solid));
  return body;
}

/// Turns the plane z = 0, in which sizes are given, so that it has this normal: about y by half a
/// turn for the opposite one, as Gazebo does.
Eigen::Quaterniond turn_to(const Vector3d& normal) {
  constexpr double kOpposite = -1 + 1e-9;
  if (normal.normalized().z() < kOpposite) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(EIGEN_PI, Vector3d::UnitY()));
  }
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
}

Body plane(const sdf::Plane& plane, const Isometry3d& pose, const Vector3d& factors) {
  const Vector3d normal = to_vector(plane.Normal());
  const Vector3d up = pose.linear() * normal;
  const Eigen::Quaterniond turn = turn_to(normal);
  if (!(up.z() > 0.99)) reject("a plane that is not level", "a level plane");
  const double half_x = 0.5 * size_within(plane.Size().X() * factors.x());
  const double half_y = 0.5 * size_within(plane.Size().Y() * factors.y());
  Body body;
  Corners corners;
  for (const Vector2d& corner : rectangle_corners({{-half_x, -half_y}, {half_x, half_y}})) {
    corners.emplace_back((pose * (turn * Vector3d(corner.x(), corner.y(), 0))).head<2>());
  }
  if (auto tidy = tidied({corners, {}})) body.footprint = tidy->outline;
  body.from_z = body.to_z = pose.translation().z();
  return body;
}

Body mesh(const sdf::Mesh& mesh, const Isometry3d& pose, const std::string& file,
          const LocalFiles& files, const Vector3d& factors) {
  const auto path = files.find(mesh.Uri(), file);
  if (!path) {
    reject(fmt::format("mesh \"{}\"", mesh.Uri()), "a file in the folders of the world and models");
  }
  Body body;
  body.solids = read_mesh(*path, mesh.Submesh());
  const Vector3d scale = to_vector(mesh.Scale()).cwiseProduct(factors);
  if (!scale.allFinite() || !(scale.cwiseAbs().maxCoeff() <= kMaxSizeM)) {
    reject("a scale that is no number", "a scale");
  }
  for (Solid& solid : body.solids) {
    for (Triangle& triangle : solid.triangles) {
      for (Vector3d& corner : triangle) {
        corner = corner.cwiseProduct(scale);
        if (!(corner.norm() <= kMaxSizeM)) reject("a mesh of more than 10 km", "a smaller mesh");
        corner = pose * corner;
      }
    }
  }
  return body;
}

// A cone about the pose's z, its tip up.
Body cone(const sdf::ElementPtr& element, const Isometry3d& pose, const Vector3d& factors) {
  Body body;
  Solid solid;
  solid.triangles =
      cone_triangles(size_within(element->Get<double>("radius") * factors.head<2>().maxCoeff()),
                     size_within(element->Get<double>("length") * factors.z()));
  move(solid.triangles, pose);
  body.solids.push_back(std::move(solid));
  return body;
}

// Prisms over outlines, upwards from the pose; an outline within another is a hole in it.
Body polylines(const sdf::ElementPtr& geometry, const Isometry3d& pose, const Vector3d& factors) {
  std::vector<Area> areas;
  double height = 0;
  for (auto line = geometry->GetElement("polyline"); line;
       line = line->GetNextElement("polyline")) {
    height = size_within(line->Get<double>("height") * factors.z());
    Corners corners;
    for (auto point = line->FindElement("point"); point; point = point->GetNextElement("point")) {
      const auto at = point->Get<ignition::math::Vector2d>();
      corners.emplace_back(at.X() * factors.x(), at.Y() * factors.y());
      if (!(corners.back().norm() <= kMaxSizeM)) reject("a point that is far away", "10 km");
    }
    for (Area& area : repaired({corners, {}})) areas.push_back(std::move(area));
  }
  std::stable_sort(areas.begin(), areas.end(),
                   [](const Area& a, const Area& b) { return size_m2(a) > size_m2(b); });
  std::vector<Area> whole;
  for (const Area& area : areas) {
    const auto around = std::find_if(whole.begin(), whole.end(), [&](const Area& other) {
      return geometry::distance_to(other.outline, area.outline.front()) == 0;
    });
    if (around == whole.end()) {
      whole.push_back(area);
    } else {
      around->holes.push_back(area.outline);
    }
  }
  std::vector<Corners> parts;
  for (const Area& area : whole) {
    for (Corners& part : simple_parts(area)) parts.push_back(std::move(part));
  }
  if (parts.empty()) reject("a polyline without an area", "three points or more");
  Isometry3d middle = pose;
  middle.translation() += pose.linear() * Vector3d(0, 0, 0.5 * height);
  Body body = prism(parts.front(), height, middle);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    Body more = prism(parts[i], height, middle);
    body.solids.push_back(std::move(more.solids.front()));
    body.footprint.reset();
  }
  return body;
}

// Kinds that libsdformat 12 has no class for.
Body other_kind(const sdf::Geometry& geometry, const Isometry3d& pose, const Vector3d& factors) {
  const sdf::ElementPtr element = geometry.Element();
  if (element && element->HasElement("polyline")) return polylines(element, pose, factors);
  if (element && element->HasElement("cone"))
    return cone(element->GetElement("cone"), pose, factors);
  const sdf::ElementPtr kind = element ? element->GetFirstElement() : nullptr;
  if (kind && kind->GetName() == "empty") return {};
  reject(kind ? fmt::format("<{}>", kind->GetName()) : "no geometry",
         "a box, cylinder, cone, sphere, ellipsoid, capsule, plane, polyline, mesh");
}

}  // namespace

Body make_body(const sdf::Geometry& geometry, const Isometry3d& pose, const std::string& file,
               const LocalFiles& files, const Vector3d& scale) {
  const double across = scale.head<2>().maxCoeff();
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX: {
      const Vector3d size = to_vector(geometry.BoxShape()->Size()).cwiseProduct(scale);
      const Vector3d half = 0.5 * size_within(size);
      return prism(rectangle_corners({-half.head<2>(), half.head<2>()}), 2 * half.z(), pose);
    }
    case sdf::GeometryType::CYLINDER:
      return prism(
          circle(Vector2d::Zero(), size_within(geometry.CylinderShape()->Radius() * across)),
          size_within(geometry.CylinderShape()->Length() * scale.z()), pose);
    case sdf::GeometryType::SPHERE:
      return ball(
          Vector3d::Constant(size_within(geometry.SphereShape()->Radius() * scale.maxCoeff())), 0,
          pose);
    case sdf::GeometryType::ELLIPSOID:
      return ball(size_within(to_vector(geometry.EllipsoidShape()->Radii()).cwiseProduct(scale)), 0,
                  pose);
    case sdf::GeometryType::CAPSULE:
      return ball(Vector3d::Constant(size_within(geometry.CapsuleShape()->Radius() * across)),
                  size_within(geometry.CapsuleShape()->Length() * scale.z()), pose);
    case sdf::GeometryType::PLANE:
      return plane(*geometry.PlaneShape(), pose, scale);
    case sdf::GeometryType::MESH:
      return mesh(*geometry.MeshShape(), pose, file, files, scale);
    default:
      return other_kind(geometry, pose, scale);
  }
}

std::optional<Vector3d> material_color(const sdf::Material* material) {
  if (material == nullptr) return std::nullopt;
  // libsdformat's default is black.
  const sdf::ElementPtr element = material->Element();
  const bool diffuse = element && element->HasElement("diffuse");
  if (!diffuse) {
    if (const auto rgb = gazebo_color(material->ScriptName())) return rgb;
    if (!element || !element->HasElement("ambient")) return std::nullopt;
  }
  const ignition::math::Color color = diffuse ? material->Diffuse() : material->Ambient();
  const Vector3d rgb(color.R(), color.G(), color.B());
  if (!rgb.allFinite()) return std::nullopt;
  return rgb.cwiseMax(0).cwiseMin(1);
}

std::string ground_material_like(const Vector3d& rgb) {
  constexpr double kTint = 0.08;
  constexpr double kDark = 0.3;
  if (rgb.y() > rgb.x() + kTint && rgb.y() > rgb.z() + kTint) return "grass";
  if (rgb.x() > rgb.z() + kTint && rgb.x() > rgb.y()) return "dirt";
  return rgb.maxCoeff() < kDark ? "asphalt" : "concrete";
}

}  // namespace throng::imports
