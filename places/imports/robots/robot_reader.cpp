#include "places/imports/robots/robot_reader.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "places/imports/parts/scenario_writer.h"
#include "places/imports/robots/robot_plugins.h"
#include "places/imports/robots/robot_sensors.h"
#include "places/imports/robots/robot_source.h"
#include "places/imports/sdf/sdf_pose.h"

namespace throng::imports {

namespace fs = std::filesystem;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// A link of the robot or of a model in it.
struct Part {
  std::string name;  ///< with the names of nested models: "gimbal::arm"
  const sdf::Link* link;
  Isometry3d pose;
};

class RobotReader {
 public:
  RobotReader(const fs::path& file, const LocalFiles& files) : source_(file, files) {
    robot_.name = source_.model().Name();
    robot_.skipped = source_.complaints();
  }

  Robot read() {
    collect(source_.model(), Isometry3d::Identity(), "");
    if (parts_.empty()) {
      throw InputError(
          source_.problem(source_.model().Element(), "no links", "a robot with links"));
    }
    sum_masses();
    find_rigid_parts();
    read_plugins(source_.model());
    place_rotors();
    read_sensors();
    measure_height();
    return std::move(robot_);
  }

 private:
  void collect(const sdf::Model& model, const Isometry3d& frame, const std::string& scope) {
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      const auto pose = resolved_pose(link.SemanticPose());
      if (!pose) refuse_pose(link.Element(), "link " + scope + link.Name());
      parts_.push_back({scope + link.Name(), &link, frame * *pose});
    }
    for (std::uint64_t i = 0; i < model.JointCount(); ++i) add_joint(*model.JointByIndex(i), scope);
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const sdf::Model& inner = *model.ModelByIndex(i);
      const auto pose = resolved_pose(inner.SemanticPose());
      if (!pose) refuse_pose(inner.Element(), "model " + scope + inner.Name());
      collect(inner, frame * *pose, scope + inner.Name() + "::");
    }
  }

  [[noreturn]] void refuse_pose(const sdf::ElementPtr& element, const std::string& name) const {
    throw InputError(source_.problem(element, "the pose of " + name,
                                     "six numbers, relative to a frame that exists"));
  }

  void add_joint(const sdf::Joint& joint, const std::string& scope) {
    std::string parent;
    std::string child;
    if (!joint.ResolveParentLink(parent).empty()) parent = joint.ParentLinkName();
    if (!joint.ResolveChildLink(child).empty()) child = joint.ChildLinkName();
    child_of_joint_[scope + joint.Name()] = scope + child;
    if (joint.Type() == sdf::JointType::FIXED) fixed_.emplace_back(scope + parent, scope + child);
  }

  void sum_masses() {
    Vector3d moment = Vector3d::Zero();
    for (const Part& part : parts_) {
      const auto& inertial = part.link->Inertial();
      const double mass_kg = inertial.MassMatrix().Mass();
      const Vector3d center = part.pose * position(inertial.Pose());
      robot_.mass_kg += mass_kg;
      moment += mass_kg * center;
    }
    robot_.center = moment / robot_.mass_kg;
    for (const Part& part : parts_) {
      const auto& inertial = part.link->Inertial();
      const double mass_kg = inertial.MassMatrix().Mass();
      const Vector3d offset = part.pose * position(inertial.Pose()) - robot_.center;
      const Matrix3d turn = part.pose.linear();
      robot_.inertia +=
          turn * own_inertia(part) * turn.transpose() +
          mass_kg * (offset.squaredNorm() * Matrix3d::Identity() - offset * offset.transpose());
    }
  }

  /// About the link's axes. A link without <inertia> has 1 kg m² in SDF, as a house has: it is
  /// taken as a point.
  Matrix3d own_inertia(const Part& part) {
    const auto moments = part.link->Inertial().Moi();
    Matrix3d own;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) {
        own(row, column) = moments(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
      }
    }
    if (!own.isApprox(Matrix3d::Identity())) return own;
    robot_.skipped.push_back(source_.skipped(part.link->Element(), "link " + part.name,
                                             "no <inertia>: its mass lies in one point"));
    return Matrix3d::Zero();
  }

  static Vector3d position(const ignition::math::Pose3d& pose) {
    return {pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z()};
  }

  /// The links that hang at the first one without joints that move.
  void find_rigid_parts() {
    std::vector<std::string> open = {parts_.front().name};
    rigid_.insert(open.front());
    while (!open.empty()) {
      const std::string name = std::move(open.back());
      open.pop_back();
      for (const auto& [parent, child] : fixed_) {
        for (const auto& [from, to] : {std::pair(parent, child), std::pair(child, parent)}) {
          if (from == name && rigid_.insert(to).second) open.push_back(to);
        }
      }
    }
  }

  void read_plugins(const sdf::Model& model) {
    const auto read_all = [&](const sdf::ElementPtr& holder) {
      if (!holder || !holder->HasElement("plugin")) return;
      for (auto plugin = holder->GetElement("plugin"); plugin;
           plugin = plugin->GetNextElement("plugin")) {
        read_plugin(source_, plugin, robot_);
      }
    };
    read_all(model.Element());
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      const sdf::Link& link = *model.LinkByIndex(i);
      read_all(link.Element());
      for (std::uint64_t j = 0; j < link.SensorCount(); ++j) {
        read_all(link.SensorByIndex(j)->Element());
      }
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) read_plugins(*model.ModelByIndex(i));
  }

  const Part* find_part(const std::string& name) const {
    for (const Part& part : parts_) {
      if (part.name == name || part.name.ends_with("::" + name)) return &part;
    }
    return nullptr;
  }

  void place_rotors() {
    for (RobotRotor& rotor : robot_.rotors) {
      const Part* part = find_part(rotor.name);
      if (part == nullptr) {
        const auto joint = child_of_joint_.find(rotor.name);
        if (joint != child_of_joint_.end()) part = find_part(joint->second);
      }
      if (part == nullptr) {
        throw InputError(source_.problem(source_.model().Element(),
                                         fmt::format("a motor of \"{}\"", rotor.name),
                                         "<linkName> or <jointName> of a link that the robot has"));
      }
      rotor.name = part->name;
      rotor.position = part->pose.translation();
      rotor.axis = part->pose.linear().col(2);
      rotor.radius_m = propeller_radius_m(*part->link);
    }
    std::stable_sort(robot_.rotors.begin(), robot_.rotors.end(),
                     [](const RobotRotor& a, const RobotRotor& b) { return a.number < b.number; });
  }

  /// Half of the longest side of the link's shapes; nothing where they are meshes.
  static std::optional<double> propeller_radius_m(const sdf::Link& link) {
    double radius_m = 0;
    const auto reach = [&](const sdf::Geometry* shape) {
      if (shape == nullptr) return;
      if (const sdf::Box* box = shape->BoxShape())
        radius_m = std::max(radius_m, 0.5 * box->Size().Max());
      if (const sdf::Cylinder* cylinder = shape->CylinderShape()) {
        radius_m = std::max({radius_m, cylinder->Radius(), 0.5 * cylinder->Length()});
      }
    };
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i)
      reach(link.CollisionByIndex(i)->Geom());
    if (radius_m == 0) {
      for (std::uint64_t i = 0; i < link.VisualCount(); ++i) reach(link.VisualByIndex(i)->Geom());
    }
    if (radius_m == 0) return std::nullopt;
    return radius_m;
  }

  void read_sensors() {
    for (const Part& part : parts_) {
      const bool is_movable = !rigid_.contains(part.name);
      for (std::uint64_t i = 0; i < part.link->SensorCount(); ++i) {
        read_sensor(source_, *part.link->SensorByIndex(i), part.pose, is_movable, robot_);
      }
    }
  }

  /// The height of boxes, cylinders and spheres that collide; unknown where meshes do.
  void measure_height() {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Part& part : parts_) {
      for (std::uint64_t i = 0; i < part.link->CollisionCount(); ++i) {
        const sdf::Collision& collision = *part.link->CollisionByIndex(i);
        const auto pose = resolved_pose(collision.SemanticPose());
        const auto half = half_size(collision.Geom());
        if (!pose || !half) return;
        const Isometry3d whole = part.pose * *pose;
        const double reach = whole.linear().row(2).cwiseAbs().dot(*half);
        low = std::min(low, whole.translation().z() - reach);
        high = std::max(high, whole.translation().z() + reach);
      }
    }
    if (high > low) robot_.height_m = high - low;
  }

  static std::optional<Vector3d> half_size(const sdf::Geometry* shape) {
    if (shape == nullptr) return std::nullopt;
    if (const sdf::Box* box = shape->BoxShape()) {
      return Vector3d(0.5 * box->Size().X(), 0.5 * box->Size().Y(), 0.5 * box->Size().Z());
    }
    if (const sdf::Cylinder* cylinder = shape->CylinderShape()) {
      return Vector3d(cylinder->Radius(), cylinder->Radius(), 0.5 * cylinder->Length());
    }
    if (const sdf::Sphere* sphere = shape->SphereShape()) {
      return Vector3d(Vector3d::Constant(sphere->Radius()));
    }
    return std::nullopt;
  }

  RobotSource source_;
  Robot robot_;
  std::vector<Part> parts_;
  std::vector<std::pair<std::string, std::string>> fixed_;  ///< links that fixed joints connect
  std::map<std::string, std::string> child_of_joint_;
  std::set<std::string> rigid_;
};

}  // namespace

Robot read_robot(const fs::path& file, const std::vector<fs::path>& models) {
  // The model's own folder, the folder of models that it lies in, and those that are named.
  std::vector<fs::path> folders = {file.parent_path(), file.parent_path() / ".."};
  folders.insert(folders.end(), models.begin(), models.end());
  return RobotReader(file, LocalFiles(folders)).read();
}

}  // namespace throng::imports
