#include "render/ground/ground_decals.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/compute/random.h"
#include "base/geometry/polygon.h"
#include "base/geometry/rectangle.h"
#include "render/frame/frame.h"
#include "render/ground/decal_rules.h"
#include "render/ground/ground_builder.h"
#include "render/ground/ground_heights.h"
#include "render/ground/ground_map.h"
#include "render/ground/ground_tone.h"
#include "render/ground/pitch.h"
#include "render/ground/worn_paths.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Polygon = std::vector<Vector2d>;

constexpr std::uint64_t kDecalIndex = std::uint64_t{1}
                                      << 44;  // apart from other uses of the stream

std::uint8_t ground_bit(std::string_view material) {
  if (material.empty()) return 0;
  if (is_paved(material)) return on_paved;
  if (material == "asphalt") return on_road;
  return material == "grass" ? on_green : on_bare;
}

/// Whether a decal hides the ground, so that it must not lie on two materials or below props.
bool is_solid(DecalKind kind) { return kind <= DecalKind::signs; }

/// A part of the ground of one material: its outline, and the direction of its longest side.
struct Field {
  Polygon corners;
  std::string_view material;
  GroundSegment longest;
};

std::vector<Field> list_fields(const world::Scenario& scenario) {
  const auto& [low, high] = scenario.ground;
  std::vector<Field> fields = {
      {{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, scenario.ground_material, {}}};
  for (const world::GroundArea& area : scenario.areas) {
    fields.push_back({area.corners, area.material, {}});
  }
  for (Field& field : fields) {
    for (std::size_t i = 0; i < field.corners.size(); ++i) {
      const GroundSegment side = {field.corners[i], field.corners[(i + 1) % field.corners.size()]};
      if (side.length_m() > field.longest.length_m()) field.longest = side;
    }
  }
  return fields;
}

class Scatterer {
 public:
  explicit Scatterer(const world::Scenario& scenario)
      : scenario_(scenario),
        map_(scenario),
        fields_(list_fields(scenario)),
        kerbs_(map_.road_edges()) {
    for (const world::Building& building : scenario.buildings) {
      if (building.facade == world::Facade::hedge) continue;
      for (std::size_t i = 0; i < building.footprint.size(); ++i) {
        // Backwards: the ground is to the left.
        walls_.push_back(
            {building.footprint[(i + 1) % building.footprint.size()], building.footprint[i]});
      }
    }
  }

  std::vector<GroundDecal> scatter() {
    add_lanes();
    add_shades();
    add_pitches();
    for (const GroundDecal& path : worn_paths(scenario_, map_)) decals_.push_back(path);
    for (std::uint64_t i = 0; i < decal_rules().size(); ++i) {
      rule_ = &decal_rules()[i];
      number_ = i;
      switch (rule_->anchor) {
        case DecalAnchor::prop:
          around_props();
          break;
        case DecalAnchor::area:
          over_areas();
          break;
        case DecalAnchor::wall:
          along(walls_, 0);
          break;
        case DecalAnchor::kerb:
          along(kerbs_, 0.16);
          break;
      }
    }
    if (decals_.size() > kMaxDecals) decals_.resize(kMaxDecals);
    return std::move(decals_);
  }

 private:
  Random random_for(std::size_t item, std::uint64_t k) const {
    return {number_, Stream::environment, kDecalIndex + (item << 20U) + k};
  }

  /// How many of an expected number there are.
  static std::uint64_t count_of(double expected, Random random) {
    return static_cast<std::uint64_t>(expected + random.uniform());
  }

  static GroundDecal sized(const DecalRule& rule, const Vector2d& direction, Random& random) {
    GroundDecal decal;
    decal.kind = rule.kind;
    const double half = random.uniform(rule.half_length_m[0], rule.half_length_m[1]);
    decal.half_size = {half, half * random.uniform(rule.width_share[0], rule.width_share[1])};
    const double yaw_rad = random.uniform(0, 2 * std::numbers::pi);
    decal.along = rule.turn == DecalTurn::along    ? direction
                  : rule.turn == DecalTurn::across ? Vector2d(-direction.y(), direction.x())
                                                   : Vector2d(std::cos(yaw_rad), std::sin(yaw_rad));
    return decal;
  }

  void around_props() {
    for (std::size_t i = 0; i < scenario_.props.size(); ++i) {
      const world::Prop& prop = scenario_.props[i];
      if (prop.kind != rule_->prop) continue;
      const auto corners = world::prop_footprint(prop);
      const std::uint64_t count = count_of(rule_->count, random_for(i, 0));
      for (std::uint64_t k = 1; k <= count; ++k) {
        Random random = random_for(i, k);
        GroundDecal decal = sized(*rule_, Vector2d::UnitX(), random);
        const Vector2d at(random.uniform(), random.uniform());
        if (rule_->reach_m < 0) {
          decal.middle =
              corners[0] + at.x() * (corners[1] - corners[0]) + at.y() * (corners[3] - corners[0]);
        } else {
          const std::uint32_t side = random.below(4);
          const GroundSegment edge = {corners.at(side), corners.at((side + 1) % 4)};
          decal.middle = edge.from + at.x() * (edge.to - edge.from) -
                         (0.5 * decal.half_size.y() + at.y() * rule_->reach_m) * edge.left();
        }
        add(decal);
      }
    }
  }

  void over_areas() {
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const Field& field = fields_[i];
      if ((ground_bit(field.material) & rule_->on) == 0) continue;
      const auto bounds = geometry::bounding_box(field.corners);
      const Vector2d size = bounds.max - bounds.min;
      const std::uint64_t count = count_of(0.01 * rule_->count * size.prod(), random_for(i, 0));
      for (std::uint64_t k = 1; k <= count; ++k) {
        Random random = random_for(i, k);
        GroundDecal decal = sized(*rule_, field.longest.along(), random);
        decal.middle = {random.uniform(bounds.min.x(), bounds.max.x()),
                        random.uniform(bounds.min.y(), bounds.max.y())};
        if (geometry::signed_distance_to(field.corners, decal.middle) < 0) add(decal);
      }
    }
  }

  void along(const std::vector<GroundSegment>& edges, double off_m) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const GroundSegment& edge = edges[i];
      const std::uint64_t count = count_of(0.1 * rule_->count * edge.length_m(), random_for(i, 0));
      for (std::uint64_t k = 1; k <= count; ++k) {
        Random random = random_for(i, k);
        GroundDecal decal = sized(*rule_, edge.along(), random);
        decal.middle = edge.from + random.uniform() * (edge.to - edge.from) +
                       (off_m + 0.9 * decal.half_size.y()) * edge.left();
        add(decal);
      }
    }
  }

  /// Wheel tracks in both lanes of roads.
  void add_lanes() {
    constexpr double kMinLengthM = 20;
    constexpr double kPieceM = 20;
    for (const Field& field : fields_) {
      if (field.material != "asphalt" || field.corners.size() != 4) continue;
      const GroundSegment& side = field.longest;
      double width_m = 0;
      for (const Vector2d& corner : field.corners) {
        width_m = std::max(width_m, (corner - side.from).dot(side.left()));
      }
      if (side.length_m() < kMinLengthM || width_m < 5 || width_m > 14) continue;
      const double pieces = std::ceil(side.length_m() / kPieceM);
      for (const double lane : {0.27, 0.73}) {
        for (double i = 0; i < pieces; ++i) {
          decals_.push_back({DecalKind::tracks,
                             side.from + (i + 0.5) / pieces * (side.to - side.from) +
                                 lane * width_m * side.left(),
                             {0.5 * side.length_m() / pieces, 1.25},
                             side.along()});
        }
      }
    }
  }

  /// Dirt and shade at the feet of kerbs.
  void add_shades() {
    constexpr double kHalfM = 0.12;
    constexpr double kInRoadM = 0.2;
    const auto add_shade = [&](const GroundSegment& edge, double off_m) {
      const double half_m = 0.5 * edge.length_m();
      if (half_m <= kHalfM) return;
      decals_.push_back({DecalKind::shade,
                         0.5 * (edge.from + edge.to) + off_m * edge.left(),
                         {half_m, kHalfM},
                         edge.along()});
    };
    for (const GroundSegment& kerb : kerbs_) add_shade(kerb, kInRoadM);
    for (const world::GroundArea& area : scenario_.areas) {
      if (!is_bed(area)) continue;
      for (std::size_t i = 0; i < area.corners.size(); ++i) {
        add_shade({area.corners[i], area.corners[(i + 1) % area.corners.size()]}, 0);
      }
    }
  }

  /// Lines again: strips of their width are dashes where they are narrower than a pixel.
  void add_pitches() {
    constexpr double kHalfWidthM = 0.25;
    for (const world::Marking& marking : scenario_.markings) {
      if (marking.kind != "pitch") continue;
      for (const GroundSegment& line : pitch_lines(marking)) {
        decals_.push_back({DecalKind::line,
                           0.5 * (line.from + line.to),
                           {std::max(0.5 * line.length_m(), kHalfWidthM), kHalfWidthM},
                           line.along()});
      }
    }
  }

  void add(const GroundDecal& decal) {
    if (rule_->apart_m > 0) {
      for (const GroundDecal& other : decals_) {
        if (other.kind == decal.kind && (other.middle - decal.middle).norm() < rule_->apart_m)
          return;
      }
    }
    const std::string_view material = map_.material_at(decal.middle);
    if ((ground_bit(material) & rule_->on) == 0 || map_.wall_m(decal.middle) < 0) return;
    if (lies_on_water(decal) || lies_on_pitch(decal.middle)) return;
    if (is_solid(decal.kind) && !is_free(decal, material)) return;
    decals_.push_back(decal);
  }

  /// Whether any part of it would hover over water.
  bool lies_on_water(const GroundDecal& decal) const {
    if (!has_water_) return false;
    const auto corners = geometry::turned_rectangle(decal.middle, decal.half_size, decal.along);
    return std::any_of(corners.begin(), corners.end(),
                       [&](const Vector2d& corner) { return map_.material_at(corner) == "water"; });
  }

  /// Pitches are well kept.
  bool lies_on_pitch(const Vector2d& point) const {
    return std::any_of(scenario_.markings.begin(), scenario_.markings.end(),
                       [&](const world::Marking& marking) {
                         return marking.kind == "pitch" && is_on_pitch(marking, point);
                       });
  }

  bool is_free(const GroundDecal& decal, std::string_view material) const {
    constexpr double kKerbM = 0.5;  // with its gutter
    const double margin_m = rule_->anchor == DecalAnchor::kerb ? 0 : kKerbM;
    const Vector2d half = decal.half_size.array() + margin_m;
    for (const Vector2d& corner : geometry::turned_rectangle(decal.middle, half, decal.along)) {
      if (map_.material_at(corner) != material || map_.wall_m(corner) < 0) return false;
    }
    const auto corners = geometry::turned_rectangle(decal.middle, decal.half_size, decal.along);
    return std::none_of(
        scenario_.props.begin(), scenario_.props.end(), [&](const world::Prop& prop) {
          if ((prop.position - decal.middle).norm() > 15) return false;
          const auto footprint = world::prop_footprint(prop);
          return prop.kind != world::PropKind::car && geometry::touch(corners, footprint);
        });
  }

  const world::Scenario& scenario_;
  GroundMap map_;
  bool has_water_ = !world::water_parts(scenario_.areas).empty();
  std::vector<Field> fields_;
  std::vector<GroundSegment> kerbs_;
  std::vector<GroundSegment> walls_;
  std::vector<GroundDecal> decals_;
  const DecalRule* rule_ = nullptr;
  std::uint64_t number_ = 0;
};

}  // namespace

std::vector<GroundDecal> ground_decals(const world::Scenario& scenario) {
  return Scatterer(scenario).scatter();
}

void add_ground_decals(const std::vector<GroundDecal>& decals, SceneryMesh& mesh) {
  constexpr float kBelowOne = 0.999F;
  const std::array<Vector2d, 4> corner_signs = {Vector2d{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  mesh.decals.first = static_cast<std::uint32_t>(mesh.indices.size());
  for (std::uint32_t i = 0; i < decals.size(); ++i) {
    const GroundDecal& decal = decals[i];
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const std::uint32_t number = Random(i, Stream::environment, kDecalIndex).bits();
    const auto corners = geometry::turned_rectangle(decal.middle, decal.half_size, decal.along);
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector2d local = corner_signs.at(k).cwiseProduct(decal.half_size);
      mesh.vertices.push_back(
          {{static_cast<float>(corners[k].x()), static_cast<float>(corners[k].y()),
            static_cast<float>(ground_height::kDecalM)},
           {0, 0, 1},
           {ground_tone_at(corners[k]), static_cast<float>(decal.half_size.x()),
            static_cast<float>(local.x()), static_cast<float>(local.y())},
           number,
           static_cast<float>(decal.kind) +
               kBelowOne * static_cast<float>(decal.half_size.y() / decal.half_size.x()),
           {}});
    }
    mesh.indices.insert(mesh.indices.end(),
                        {first, first + 1, first + 2, first, first + 2, first + 3});
  }
  mesh.decals.count = static_cast<std::uint32_t>(mesh.indices.size()) - mesh.decals.first;
}

}  // namespace throng::render
