#include "places/imports/gazebo/world_population.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sdf/sdf.hh>

#include "base/compute/random.h"
#include "places/imports/gazebo/sdf_children.h"

namespace throng::imports {

using Eigen::Vector3d;

namespace {

constexpr int kMaxCopies = 1000;

Vector3d vector_in(const sdf::ElementPtr& element, const std::string& name,
                   const Vector3d& otherwise) {
  if (!element || !element->HasElement(name)) return otherwise;
  const auto v = element->Get<ignition::math::Vector3d>(name);
  return {v.X(), v.Y(), v.Z()};
}

template <typename Value>
Value value_in(const sdf::ElementPtr& element, const std::string& name, Value otherwise) {
  if (!element || !element->HasElement(name)) return otherwise;
  return element->Get<Value>(name);
}

/// A box, or the cylinder in it, about `center`.
struct Region {
  Vector3d center = Vector3d::Zero();
  Vector3d size = Vector3d::Ones();
  bool is_round = false;
};

Region read_region(const sdf::ElementPtr& population) {
  Region region;
  if (const auto box = find_child(population, "box")) {
    region.size = vector_in(box, "size", region.size);
  } else if (const auto cylinder = find_child(population, "cylinder")) {
    const auto radius = value_in(cylinder, "radius", 0.5);
    region.size = {2 * radius, 2 * radius, value_in(cylinder, "length", 1.0)};
    region.is_round = true;
  }
  // Until SDF 1.5 the region had a place of its own; copies stand at its bottom.
  const sdf::ElementPtr old = find_child(population, "region");
  if (const auto cuboid = find_child(old, "cuboid")) {
    const Vector3d low = vector_in(cuboid, "min", Vector3d::Zero());
    region.size = vector_in(cuboid, "max", low) - low;
    region.center = low + 0.5 * Vector3d(region.size.x(), region.size.y(), 0);
  } else if (const auto cylinder = find_child(old, "cylinder")) {
    const auto radius = value_in(cylinder, "radius", 0.5);
    region.center = vector_in(cylinder, "center", Vector3d::Zero());
    region.size = {2 * radius, 2 * radius, value_in(cylinder, "height", 1.0)};
    region.is_round = true;
  }
  return region;
}

std::vector<Vector3d> random_places(const Region& region, int count, std::uint64_t seed) {
  Random random(seed, Stream::place);
  std::vector<Vector3d> places;
  while (static_cast<int>(places.size()) < count) {
    const double x = random.uniform(-0.5, 0.5);
    const double y = random.uniform(-0.5, 0.5);
    if (region.is_round && std::hypot(x, y) > 0.5) continue;
    places.emplace_back(x * region.size.x(), y * region.size.y(), 0);
  }
  return places;
}

std::vector<Vector3d> grid_places(int rows, int columns, const Vector3d& step) {
  std::vector<Vector3d> places;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      places.emplace_back((column - 0.5 * (columns - 1)) * step.x(),
                          (row - 0.5 * (rows - 1)) * step.y(), 0);
    }
  }
  return places;
}

/// A grid over the region with as many points as asked.
std::vector<Vector3d> even_places(const Region& region, int count) {
  constexpr double kSmallestM = 1e-3;
  const double shape =
      std::max(region.size.x(), kSmallestM) / std::max(region.size.y(), kSmallestM);
  // A circle covers this share of its square.
  const double wanted = region.is_round ? count * 4 / std::numbers::pi : count;
  int columns = std::clamp(static_cast<int>(std::lround(std::sqrt(wanted * shape))), 1, count);
  std::vector<Vector3d> places;
  for (; static_cast<int>(places.size()) < count; ++columns) {
    const int rows = static_cast<int>(std::ceil(wanted / columns));
    places = grid_places(rows, columns, {region.size.x() / columns, region.size.y() / rows, 0});
    std::erase_if(places, [&](const Vector3d& place) {
      return region.is_round && place.head<2>().norm() > 0.5 * region.size.x();
    });
  }
  places.resize(static_cast<std::size_t>(count));
  return places;
}

std::vector<Vector3d> line_places(const Region& region, int count, int axis) {
  std::vector<Vector3d> places;
  for (int i = 0; i < count; ++i) {
    Vector3d place = Vector3d::Zero();
    place[axis] = ((i + 0.5) / count - (axis == 2 ? 0 : 0.5)) * region.size[axis];
    places.push_back(place);
  }
  return places;
}

}  // namespace

ModelCopies place_copies(const sdf::ElementPtr& population, const std::string& stated_kind) {
  ModelCopies copies;
  const Region region = read_region(population);
  if (!region.size.allFinite() || !region.center.allFinite() || region.size.minCoeff() < 0) {
    return {{}, "its region has no size"};
  }
  const int asked = value_in(population, "model_count", 1);
  const int count = std::clamp(asked, 0, kMaxCopies);
  const sdf::ElementPtr distribution = find_child(population, "distribution");
  const std::string kind =
      stated_kind.empty() ? value_in<std::string>(distribution, "type", "random") : stated_kind;
  std::vector<Vector3d> places;
  if (kind == "grid") {
    const sdf::ElementPtr old = find_child(find_child(population, "region"), "cuboid");
    const sdf::ElementPtr grid = old && old->HasElement("rows") ? old : distribution;
    const int rows = std::clamp(value_in(grid, "rows", 1), 0, kMaxCopies);
    const int columns = std::clamp(value_in(grid, "cols", 1), 0, kMaxCopies / std::max(rows, 1));
    places = grid_places(rows, columns, vector_in(grid, "step", {0.5, 0.5, 0}));
  } else if (kind.starts_with("linear-") && kind.size() == 8 && kind[7] >= 'x' && kind[7] <= 'z') {
    places = line_places(region, count, kind[7] - 'x');
  } else if (kind == "uniform") {
    if (count > 0) places = even_places(region, count);
  } else if (kind == "random") {
    std::uint64_t seed = 1;
    for (const unsigned char c : population->Get<std::string>("name")) seed = 31 * seed + c;
    places = random_places(region, count, seed);
  } else {
    return {{},
            fmt::format("its distribution is \"{}\"; Gazebo has random, uniform, grid, linear-x, "
                        "linear-y and linear-z",
                        kind)};
  }
  if (asked > kMaxCopies) copies.unread = fmt::format("{} of {} copies", kMaxCopies, asked);
  const auto pose = population->HasElement("pose") ? population->Get<ignition::math::Pose3d>("pose")
                                                   : ignition::math::Pose3d();
  for (const Vector3d& place : places) {
    const Vector3d at = region.center + place;
    const auto turned = pose.Rot().RotateVector({at.x(), at.y(), at.z()});
    Eigen::Isometry3d whole = Eigen::Isometry3d::Identity();
    whole.translation() = Vector3d(pose.Pos().X() + turned.X(), pose.Pos().Y() + turned.Y(),
                                   pose.Pos().Z() + turned.Z());
    if (whole.translation().allFinite()) copies.poses.push_back(whole);
  }
  return copies;
}

bool load_model(const sdf::ElementPtr& model, sdf::Root& root) {
  const std::string text =
      fmt::format("<sdf version='{}'>{}</sdf>", SDF_VERSION, model->ToString(""));
  root.LoadSdfString(text);
  return root.Model() != nullptr;
}

}  // namespace throng::imports
