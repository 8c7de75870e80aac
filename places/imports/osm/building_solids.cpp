#include "places/imports/osm/building_solids.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "places/imports/parts/solids.h"

namespace throng::imports {

namespace {

constexpr double kMinBuildingM2 = 1;
constexpr double kThinnestM = 0.5;  // of a building above a passage
const Eigen::Vector3d kRoofRgb(0.35, 0.33, 0.3);

geometry::Rectangle find_bounds(const std::vector<Area>& areas) {
  Corners corners;
  for (const Area& area : areas) {
    corners.insert(corners.end(), area.outline.begin(), area.outline.end());
  }
  return geometry::bounding_box(corners);
}

}  // namespace

BuildingSolids::BuildingSolids(ImportedScenario& place, std::string source,
                               std::vector<Passage> passages)
    : place_(place), source_(std::move(source)), passages_(std::move(passages)) {
  std::erase_if(passages_, [](const Passage& passage) { return passage.ground.empty(); });
  for (const Passage& passage : passages_) passage_bounds_.push_back(find_bounds(passage.ground));
}

void BuildingSolids::block(const Area& outline) {
  const geometry::Rectangle bounds = geometry::bounding_box(outline.outline);
  std::vector<Area> open;
  for (std::size_t i = 0; i < passages_.size(); ++i) {
    const std::vector<Area>& ground = passages_[i].ground;
    if (bounds.meets(passage_bounds_[i])) open.insert(open.end(), ground.begin(), ground.end());
  }
  for (const Area& part : clipped(outline, ground_rectangle(place_))) {
    for (const Area& closed : without(part, open)) {
      for (Corners& corners : simple_parts(closed, kMinBuildingM2)) {
        place_.obstacles.push_back(std::move(corners));
      }
    }
  }
}

bool BuildingSolids::add_hanging(const BuildingPiece& piece) {
  Solid solid;
  solid.rgb = kRoofRgb;
  constexpr double kRoofM = 0.3;
  const double from_m = piece.from_m > kHeadM ? piece.from_m : piece.to_m - kRoofM;
  for (const Area& part : clipped(piece.area, ground_rectangle(place_))) {
    for (const Corners& corners : simple_parts(part, kMinBuildingM2)) {
      const Triangles prism = prism_triangles(corners, from_m, piece.to_m);
      solid.triangles.insert(solid.triangles.end(), prism.begin(), prism.end());
    }
  }
  if (solid.triangles.empty()) return false;
  place_.objects.push_back({piece.name, {std::move(solid)}});
  return true;
}

// Lets the building hang above its passages; the rest of it stands.
std::vector<Area> BuildingSolids::opened(const BuildingPiece& piece, const Area& area) {
  const geometry::Rectangle bounds = geometry::bounding_box(area.outline);
  std::vector<Area> standing = {area};
  for (std::size_t i = 0; i < passages_.size(); ++i) {
    const Passage& passage = passages_[i];
    if (!bounds.meets(passage_bounds_[i])) continue;
    const double from_m = std::min(passage.clear_m, piece.to_m - kThinnestM);
    std::vector<Area> left;
    for (const Area& whole : standing) {
      std::vector<Area> rest = without(whole, passage.ground);
      bool is_opened = false;
      for (const Area& above : from_m > kHeadM ? without(whole, rest) : std::vector<Area>()) {
        is_opened |=
            add_hanging({piece.name, above, from_m, piece.to_m, false, piece.part, piece.looks});
      }
      if (!is_opened) rest = {whole};
      left.insert(left.end(), rest.begin(), rest.end());
    }
    if (from_m <= kHeadM && shared_m2(area, passage.ground.front()) > kMinBuildingM2) {
      if (piece.part) place_.obstacles.push_back(area.outline);  // block() left it open
      skip(passage.name, fmt::format("a passage below {}, which is only {:.1f} m high: closed",
                                     piece.name, piece.to_m));
    }
    standing = std::move(left);
  }
  return standing;
}

void BuildingSolids::stand(const BuildingPiece& piece, const Area& area) {
  for (Corners& corners : simple_parts(area, kMinBuildingM2)) {
    building_bounds_.push_back(geometry::bounding_box(corners));
    if (!piece.part) place_.obstacles.push_back(corners);
    place_.buildings.push_back({fmt::format("b{}", place_.buildings.size() + 1), std::move(corners),
                                piece.to_m, piece.looks.facade, piece.looks.paint,
                                piece.looks.roof});
  }
}

// Buildings that are there already are cut out, so that no two buildings overlap.
void BuildingSolids::add_standing(const BuildingPiece& piece) {
  for (const Area& part : clipped(piece.area, ground_rectangle(place_))) {
    std::vector<Area> others;
    const geometry::Rectangle bounds = geometry::bounding_box(part.outline);
    for (std::size_t i = 0; i < place_.buildings.size(); ++i) {
      if (bounds.meets(building_bounds_[i])) others.push_back({place_.buildings[i].footprint, {}});
    }
    double kept_m2 = 0;
    for (const Area& rest : without(part, others)) {
      kept_m2 += size_m2(rest);
      for (const Area& closed : opened(piece, rest)) stand(piece, closed);
    }
    const double cut_m2 = size_m2(part) - kept_m2;
    if (cut_m2 > kMinBuildingM2 && !piece.part) {
      skip(piece.name, fmt::format("{:.0f} m² of it are in other buildings: cut off", cut_m2));
    } else if (size_m2(part) < kMinBuildingM2) {
      skip(piece.name, fmt::format("covers {:.2f} m² only; buildings have {:g} m² and more",
                                   size_m2(part), kMinBuildingM2));
    }
  }
}

void BuildingSolids::add(const MapBuildings& buildings) {
  for (const Area& outline : buildings.outlines) block(outline);
  for (const BuildingPiece& piece : buildings.pieces) {
    if (piece.stands) {
      add_standing(piece);
    } else if (!add_hanging(piece) && size_m2(piece.area) < kMinBuildingM2) {
      skip(piece.name, fmt::format("covers {:.2f} m² only; buildings have {:g} m² and more",
                                   size_m2(piece.area), kMinBuildingM2));
    }
  }
  place_.skipped.insert(place_.skipped.end(), buildings.skipped.begin(), buildings.skipped.end());
}

}  // namespace throng::imports
