#include "render/light/place_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/compute/parallel.h"
#include "base/files/hash.h"
#include "render/light/cut_meshes.h"
#include "render/light/light_bake.h"
#include "render/light/light_store.h"
#include "render/light/ray_scene.h"
#include "render/light/sky_light.h"
#include "render/light/surfaces.h"
#include "render/light/vertex.h"
#include "render/scenery/lamps.h"

namespace throng::render {

namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

/// Part of the files' names: another one where the same arguments give other light.
constexpr std::string_view kVersion = "1";

/// Paths for each point, and how coarse triangles are.
struct Effort {
  int scenery;
  int props;
  int air;
  int leaves;
  double scale;
};

Effort effort_for(const QualitySettings& quality) {
  if (!quality.textured) return {16, 8, 16, 8, 2.5};
  return quality.supersampling > 1 ? Effort{144, 64, 96, 24, 0.7} : Effort{48, 20, 32, 10, 1};
}

struct Point {
  Vector3f position;
  Vector3f normal;
  int paths = 0;
  bool is_leaf = false;
  float share_m = 0;  ///< within which points of about its normal are one
};

constexpr std::uint32_t kInTheOpen = ~0U;

/// Most points of a place: more than about these take longer than the few seconds that a place is
/// worth, and lie closer than light varies.
constexpr std::size_t kMaxPoints = 90'000;

/// Points whose light is wanted, each once, and which of them vertices use. Those within `step_m`
/// of each other with about the same normal are one.
class Points {
 public:
  explicit Points(float step_m) : step_m_(step_m), normal_step_(step_m > kFineM ? 0.3F : 0.02F) {}

  std::uint32_t add(const Point& point) {
    const auto round = [](float value, float step) {
      return static_cast<int>(std::lround(value / step));
    };
    const float step_m = std::max(step_m_, point.share_m);
    const float normal_step = point.share_m > 0 ? 0.6F : normal_step_;
    // Layers of ground lie closer than the third number tells apart.
    const std::array<int, 7> key = {round(point.position.x(), step_m),
                                    round(point.position.y(), step_m),
                                    round(point.position.z(), std::max(step_m, 0.04F)),
                                    round(point.normal.x(), normal_step),
                                    round(point.normal.y(), normal_step),
                                    round(point.normal.z(), normal_step),
                                    point.paths};
    const auto [found, is_new] = known_.try_emplace(key, static_cast<std::uint32_t>(all_.size()));
    if (is_new) {
      all_.push_back(point);
    } else if (Point& first = all_[found->second];
               first.share_m > 0 && point.share_m > 0 && point.position.z() > first.position.z()) {
      first = point;  // corners at the ground would darken all that share theirs
    }
    return found->second;
  }
  const std::vector<Point>& all() const { return all_; }

  static constexpr float kFineM = 0.01F;

 private:
  float step_m_;
  float normal_step_;
  std::map<std::array<int, 7>, std::uint32_t> known_;
  std::vector<Point> all_;
};

std::vector<std::uint32_t> list_points(const SceneryMesh& mesh, const Eigen::AlignedBox2d& ground,
                                       int paths, Points& points) {
  constexpr double kNearM = 30;
  std::vector<std::uint32_t> used;
  used.reserve(mesh.vertices.size());
  const std::size_t first_decal =
      mesh.decals.count > 0 ? mesh.indices[mesh.decals.first] : mesh.vertices.size();
  const std::size_t decals = mesh.decals.count / 6;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const SceneryVertex& vertex = mesh.vertices[i];
    Vector3f at = vertex_position(vertex);
    if (i >= first_decal && i < first_decal + 4 * decals) {
      // A decal's corners share the light of its middle.
      const std::size_t corner = first_decal + (i - first_decal) / 4 * 4;
      at = 0.5F *
           (vertex_position(mesh.vertices[corner]) + vertex_position(mesh.vertices[corner + 2]));
    }
    const bool far = ground.exteriorDistance(Eigen::Vector2d(at.head<2>().cast<double>())) > kNearM;
    used.push_back(far ? kInTheOpen : points.add({at, vertex_normal(vertex), paths, false}));
  }
  return used;
}

std::vector<std::uint32_t> list_points(const PropMesh& mesh, const Effort& effort, float share_m,
                                       Points& points) {
  constexpr std::size_t kCardCorners = 4;
  constexpr float kNearDetailM = 2;
  std::vector<std::uint32_t> used;
  used.reserve(mesh.vertices.size());
  // Light hardly varies along what is only drawn near by.
  std::vector<std::uint8_t> shows_far(mesh.vertices.size());
  const std::size_t far_count = std::min(mesh.far_indices, mesh.indices.size());
  for (std::size_t i = 0; i < far_count; ++i) shows_far[mesh.indices[i]] = 1;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const PropVertex& vertex = mesh.vertices[i];
    const bool is_leaf = vertex.paint[3] == static_cast<std::uint8_t>(Finish::leaves);
    if (!is_leaf || i + kCardCorners > mesh.vertices.size()) {
      const float share = shows_far[i] != 0 ? share_m : std::max(share_m, kNearDetailM);
      used.push_back(
          points.add({vertex_position(vertex), vertex_normal(vertex), effort.props, false, share}));
      continue;
    }
    // A card's corners share the light of its middle.
    Vector3f middle = Vector3f::Zero();
    Vector3f normal = Vector3f::Zero();
    for (std::size_t k = 0; k < kCardCorners; ++k) {
      middle += 0.25F * vertex_position(mesh.vertices[i + k]);
      normal += 0.25F * vertex_normal(mesh.vertices[i + k]);
    }
    used.insert(used.end(), kCardCorners, points.add({middle, normal, effort.leaves, true}));
    i += kCardCorners - 1;
  }
  return used;
}

template <typename Vertex>
std::vector<std::uint32_t> in_the_open(const std::vector<Vertex>& vertices) {
  return std::vector<std::uint32_t>(vertices.size(), kInTheOpen);
}

/// The points of a place, and which of them its vertices use.
struct PlacePoints {
  Points points;
  std::vector<std::uint32_t> scenery;
  std::vector<std::vector<std::uint32_t>> props;
};

PlacePoints list_points(const PlaceMeshes& meshes, const Eigen::AlignedBox2d& ground,
                        const Effort& effort, bool is_empty) {
  std::size_t vertices = meshes.scenery.vertices.size();
  for (const PlacedProp& prop : meshes.props) vertices += prop.mesh.vertices.size();
  // The dense meshes of users share points.
  constexpr float kShareM = 0.2F;
  constexpr float kMaxShareM = 4;
  float step_m = vertices > 5 * kMaxPoints ? kShareM : Points::kFineM;
  while (true) {
    PlacePoints listed{Points(step_m), {}, {}};
    listed.scenery = is_empty ? in_the_open(meshes.scenery.vertices)
                              : list_points(meshes.scenery, ground, effort.scenery, listed.points);
    for (const PlacedProp& prop : meshes.props) {
      constexpr float kDetailM = 0.5F;
      constexpr std::size_t kSmallVertices = 3000;
      constexpr float kSmallSteps = 5;
      // Light varies less along what is small than along grounds, walls and stands.
      const bool is_coarse = step_m > Points::kFineM && prop.mesh.vertices.size() < kSmallVertices;
      const float share_m =
          std::max(prop.is_detail ? kDetailM : 0, is_coarse ? kSmallSteps * step_m : 0);
      listed.props.push_back(prop.is_backdrop
                                 ? in_the_open(prop.mesh.vertices)
                                 : list_points(prop.mesh, effort, share_m, listed.points));
    }
    if (listed.points.all().size() <= kMaxPoints || step_m >= kMaxShareM) return listed;
    step_m = std::max(kShareM, 1.5F * step_m);
  }
}

void append(std::string& bytes, std::span<const float> values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

std::string light_key(const RayScene& rays, const Environment& environment, const Daylight& day,
                      const std::vector<Lamp>& lamps, const Points& points, const ProbeGrid& probes,
                      int air_paths) {
  std::string bytes(kVersion);
  bytes += rays.fingerprint();
  const auto add = [&](double value) {
    const auto single = static_cast<float>(value);
    append(bytes, {&single, 1});
  };
  for (const Eigen::Array3d& color : {day.sun, day.sky, day.lamps}) {
    for (const double value : color) add(value / day.exposure);
  }
  for (const double value : day.direction) add(value);
  add(static_cast<double>(environment.weather));
  add(environment.sun_elevation_rad);
  for (const Lamp& lamp : lamps) {
    for (const double value : lamp.position) add(value);
    for (const double value : lamp.away) add(value);
    add(lamp.strength);
    for (const double value : lamp.color) add(value);
  }
  for (const Point& point : points.all()) {
    append(bytes, {point.position.data(), 3});
    append(bytes, {point.normal.data(), 3});
    add(point.paths);
  }
  add(air_paths);
  for (std::size_t i = 0; i < probes.size(); ++i) append(bytes, {probes.position(i).data(), 3});
  return sha256_hex(bytes);
}

constexpr float kInside = -1;  // in place of a color: within a building

std::vector<float> bake(const LightRays& light, const Points& points, const ProbeGrid& probes,
                        int air_paths) {
  const std::size_t surface = 3 * points.all().size();
  std::vector<float> values(surface + LightField::kNumbers * probes.size(), kInside);
  constexpr std::size_t kGrain = 32;
  parallel_ranges(points.all().size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point& point = points.all()[i];
      std::optional<Array3f> received;
      if (point.is_leaf) {
        // Light goes through leaves and around their sides.
        constexpr float kThrough = 0.6F;
        constexpr float kTwigM = 0.8F;  // the card's own twig, whose leaves are many
        const auto field = light.field(point.position, point.paths, kTwigM);
        if (field) received = field->received(kThrough * point.normal);
      } else {
        received = light.received(point.position, point.normal, point.paths);
      }
      if (received) std::copy_n(received->data(), 3, &values[3 * i]);
    }
  });
  parallel_ranges(probes.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto field = light.field(probes.position(i), air_paths);
      if (!field) continue;
      std::ranges::copy(field->numbers(), &values[surface + LightField::kNumbers * i]);
    }
  });
  return values;
}

void set_probes(std::span<const float> values, ProbeGrid& probes) {
  std::vector<std::optional<LightField>> fields(probes.size());
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const float* at = &values[LightField::kNumbers * i];
    if (at[0] < 0) continue;
    fields[i] = LightField{Array3f(at[0], at[1], at[2]), Eigen::Matrix3f(at + 3)};
  }
  probes.set(fields);
}

/// Sets the light of a mesh's vertices; those within buildings take that of their triangles' other
/// corners, or a share of the light in the open.
template <typename Vertex>
void set_light(std::span<const float> values, float exposure, const LightField& open,
               const std::vector<std::uint32_t>& used, const std::vector<std::uint32_t>& indices,
               std::vector<Vertex>& vertices) {
  std::vector<bool> known(vertices.size(), true);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    Array3f light = open.received(vertex_normal(vertices[i]));
    if (used[i] != kInTheOpen) {
      const float* at = &values[3 * std::size_t{used[i]}];
      known[i] = at[0] >= 0;
      light = exposure * Array3f(at[0], at[1], at[2]).max(0.0F);
    }
    std::copy_n(light.data(), 3, vertices[i].light.data());
  }
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    std::map<std::uint32_t, std::pair<Array3f, float>> sums;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        if (known[indices[i + k]]) continue;
        for (std::size_t other = 0; other < 3; ++other) {
          if (!known[indices[i + other]]) continue;
          auto& [sum, count] =
              sums.try_emplace(indices[i + k], Array3f::Zero(), 0.0F).first->second;
          sum += Array3f(vertices[indices[i + other]].light.data());
          ++count;
        }
      }
    }
    for (const auto& [vertex, sum] : sums) {
      const Array3f mean = sum.first / sum.second;
      std::copy_n(mean.data(), 3, vertices[vertex].light.data());
      known[vertex] = true;
    }
  }
  // A triangle may show between corners that all lie within others: it is not black.
  constexpr float kHidden = 0.35F;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (known[i]) continue;
    const Array3f light = kHidden * open.received(vertex_normal(vertices[i]));
    std::copy_n(light.data(), 3, vertices[i].light.data());
  }
}

}  // namespace

void add_place(const PlaceMeshes& meshes, const world::Scenario& scenario,
               const Array3f& lamp_color, RayScene& rays) {
  const SceneryMesh& mesh = meshes.scenery;
  for (std::size_t i = 0; i < mesh.walls.count; i += 3) {
    const std::size_t first = mesh.walls.first + i;
    rays.add_triangle(mesh, first, wall_surface(mesh.vertices[mesh.indices[first]], lamp_color));
  }
  for (std::size_t i = 0; i < mesh.roofs.count; i += 3) {
    const std::size_t first = mesh.roofs.first + i;
    rays.add_triangle(mesh, first, roof_surface(mesh.vertices[mesh.indices[first]]));
  }
  rays.add(mesh, mesh.ground, ground_surface(scenario.ground_material));
  rays.add(mesh, mesh.surroundings, ground_surface("surroundings"));
  for (const GroundLayer& layer : meshes.layers)
    rays.add(mesh, layer.range, ground_surface(layer.material));
  for (const PlacedProp& prop : meshes.props) {
    if (!prop.is_backdrop && prop.from_s <= 0) rays.add(prop.mesh, lamp_color);
  }
  rays.build();
}

ProbeGrid light_place(const world::Scenario& scenario, const Environment& environment,
                      const Daylight& day, const QualitySettings& quality,
                      const std::filesystem::path& folder, PlaceMeshes& meshes) {
  const Effort effort = effort_for(quality);
  const Eigen::AlignedBox2d ground(scenario.ground.min, scenario.ground.max);
  std::vector<Lamp> lamps;
  if (day.lamps_on) lamps = all_lamps(scenario);
  RayScene rays;
  add_place(meshes, scenario, (day.lamps / day.exposure).cast<float>(), rays);
  cut_meshes(ground, effort.scale, meshes);

  // Nothing stands in the way on an empty field: its light is that of the open.
  const bool is_empty = meshes.scenery.walls.count == 0 &&
                        std::none_of(meshes.props.begin(), meshes.props.end(),
                                     [](const PlacedProp& prop) { return !prop.is_backdrop; });
  const PlacePoints used = list_points(meshes, ground, effort, is_empty);
  const Points& points = used.points;
  ProbeGrid probes(ground, scenario.stands, !is_empty);
  const SkyLight sky(environment, day);
  const LightRays light(rays, sky, day, lamps);
  const std::size_t surface = 3 * points.all().size();
  const std::vector<float> values =
      load_or_make(folder, light_key(rays, environment, day, lamps, points, probes, effort.air),
                   surface + LightField::kNumbers * probes.size(),
                   [&] { return bake(light, points, probes, effort.air); });

  const auto exposure = static_cast<float>(day.exposure);
  set_probes(std::span(values).subspan(surface), probes);
  probes.expose(exposure);
  set_light(values, exposure, probes.open(), used.scenery, meshes.scenery.indices,
            meshes.scenery.vertices);
  for (std::size_t i = 0; i < meshes.props.size(); ++i) {
    PropMesh& mesh = meshes.props[i].mesh;
    set_light(values, exposure, probes.open(), used.props[i], mesh.indices, mesh.vertices);
  }
  return probes;
}

}  // namespace throng::render
