#include "render/buildings/building_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "render/frame/frame.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using world::Facade;

std::array<float, 3> to_floats(const Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

std::array<std::uint8_t, 4> painted(const Paint& paint, std::uint8_t more) {
  std::array<std::uint8_t, 4> bytes{0, 0, 0, more};
  for (int i = 0; i < 3; ++i) {
    bytes.at(static_cast<std::size_t>(i)) =
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(paint[i], 0.0F, 1.0F)));
  }
  return bytes;
}

/// A plane polygon of one look: `local` returns the first two local coordinates of a corner.
struct Panel {
  std::uint32_t id = 0;
  float facade = 0;
  std::array<std::uint8_t, 4> paint{};
  Vector2d size = Vector2d::Zero();  ///< the other two local coordinates
};

template <typename Local>
void add_panel(std::span<const Vector3d> corners, const Panel& panel, const Local& local,
               SceneryMesh& mesh) {
  Vector3d normal = Vector3d::Zero();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    normal += (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]);
  }
  normal.normalize();
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vector3d& corner : corners) {
    const Vector2d at = local(corner);
    mesh.vertices.push_back(
        {to_floats(corner),
         to_floats(normal),
         {static_cast<float>(at.x()), static_cast<float>(at.y()),
          static_cast<float>(panel.size.x()), static_cast<float>(panel.size.y())},
         panel.id,
         panel.facade,
         panel.paint,
         {}});
  }
  for (std::uint32_t i = 2; i < corners.size(); ++i) {
    mesh.indices.insert(mesh.indices.end(), {first, first + i - 1, first + i});
  }
}

/// Adds an upright rectangle of the panel's size from the ground on.
void add_upright(const Vector2d& from, const Vector2d& to, const Panel& panel, SceneryMesh& mesh) {
  const double height_m = panel.size.y();
  const Vector2d along = (to - from).normalized();
  const std::array<Vector3d, 4> corners = {
      Vector3d(from.x(), from.y(), 0), Vector3d(to.x(), to.y(), 0),
      Vector3d(to.x(), to.y(), height_m), Vector3d(from.x(), from.y(), height_m)};
  add_panel(
      corners, panel,
      [&](const Vector3d& p) { return Vector2d((p.head<2>() - from).dot(along), p.z()); }, mesh);
}

/// Fronts of a wall: long ones of houses look like several houses.
void add_fronts(const BuildingModel& model, std::size_t wall, std::vector<Front>& fronts) {
  constexpr double kLongM = 19;
  constexpr double kFrontM = 12;
  constexpr std::uint32_t kMaxNumber = 127;
  const std::vector<Vector2d>& footprint = model.building.footprint;
  const Vector2d& from = footprint[wall];
  const Vector2d edge = footprint[(wall + 1) % footprint.size()] - from;
  const double length_m = edge.norm();
  const bool may_vary =
      model.building.facade != Facade::glass && !model.building.paint &&
      (model.look.facade == Facade::historic || model.look.facade == Facade::plaster ||
       model.look.facade == Facade::brick);
  const int count =
      may_vary && length_m > kLongM ? static_cast<int>(std::lround(length_m / kFrontM)) : 1;
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<std::uint32_t>(fronts.size()) % kMaxNumber;
    const Paint paint =
        count > 1 ? front_paint(model.look.facade, model.number, static_cast<std::uint32_t>(i))
                  : model.look.wall;
    fronts.push_back({from + edge * i / count, edge / length_m, length_m / count,
                      model.roof.eaves_m, paint, static_cast<std::uint8_t>(number)});
  }
}

}  // namespace

BuildingModel building_model(const world::Building& building, std::uint32_t number) {
  BuildingModel model{building, number, building_look(building, number), {}, {}};
  model.roof = roof_shape(building, model.look);
  for (std::size_t wall = 0; wall < building.footprint.size(); ++wall) {
    add_fronts(model, wall, model.fronts);
  }
  return model;
}

void add_walls(const BuildingModel& model, SceneryMesh& mesh) {
  constexpr std::uint8_t kShops = 0x80;
  const std::uint32_t id = kIdBuilding + model.number;
  for (const Front& front : model.fronts) {
    const auto more =
        static_cast<std::uint8_t>(front.number | (model.look.has_shops ? kShops : 0U));
    const Panel panel{id,
                      static_cast<float>(model.look.facade),
                      painted(front.paint, more),
                      {front.length_m, front.height_m}};
    add_upright(front.from, front.from + front.length_m * front.along, panel, mesh);
  }
  const bool is_brick =
      model.look.facade == Facade::brick || model.look.facade == Facade::warehouse;
  for (const RoofSurface& surface : model.roof.surfaces) {
    if (surface.part != RoofPart::gable && surface.part != RoofPart::glazing) continue;
    const WallLook look = surface.part == RoofPart::glazing ? WallLook::glazing
                          : is_brick                        ? WallLook::brick_gable
                                                            : WallLook::gable;
    const Vector2d from = surface.corners[0].head<2>();
    const Vector2d along = (surface.corners[1].head<2>() - from).normalized();
    const double length_m = (surface.corners[1].head<2>() - from).norm();
    const Panel panel{id,
                      static_cast<float>(look),
                      painted(model.look.wall, 0),
                      {length_m, model.roof.top_m - model.roof.eaves_m}};
    add_panel(
        surface.corners, panel,
        [&](const Vector3d& p) {
          return Vector2d((p.head<2>() - from).dot(along), p.z() - model.roof.eaves_m);
        },
        mesh);
  }
}

void add_roof(const BuildingModel& model, SceneryMesh& mesh) {
  const bool is_hedge = model.look.facade == Facade::hedge;
  const bool is_low = model.building.height_m < kMinStoryM && model.look.facade != Facade::glass;
  const auto covering = is_hedge ? static_cast<float>(RoofLook::hedge)
                        : is_low ? static_cast<float>(RoofLook::wall_top)
                                 : static_cast<float>(model.look.covering);
  Panel panel{kIdBuilding + model.number, covering, painted(model.look.roof_paint, 0), {}};
  for (const RoofSurface& surface : model.roof.surfaces) {
    const bool is_coping = surface.part == RoofPart::coping;
    if (!is_coping && surface.part != RoofPart::covering) continue;
    panel.facade = is_coping ? static_cast<float>(RoofLook::coping) : covering;
    panel.paint = painted(is_coping ? Paint(0.44F, 0.43F, 0.41F) : model.look.roof_paint, 0);
    // A flat roof's pattern runs through all of its parts.
    const Vector2d from =
        model.roof.is_flat ? model.building.footprint.front() : Vector2d(surface.from);
    const Vector2d along =
        model.roof.is_flat ? main_direction(model.building.footprint) : Vector2d(surface.along);
    const Vector2d inward(-along.y(), along.x());
    const Vector3d normal = (surface.corners[1] - surface.corners[0])
                                .cross(surface.corners[2] - surface.corners[0])
                                .normalized();
    const double slope = std::max(0.2, normal.z());
    add_panel(
        surface.corners, panel,
        [&](const Vector3d& p) {
          const Vector2d off = p.head<2>() - from;
          return Vector2d(off.dot(along), off.dot(inward) / slope);
        },
        mesh);
  }
}

void add_wall_panel(const Vector2d& from, const Vector2d& to, double height_m, std::uint32_t id,
                    WallLook look, SceneryMesh& mesh) {
  add_upright(from, to, {id, static_cast<float>(look), {}, {(to - from).norm(), height_m}}, mesh);
}

}  // namespace throng::render
