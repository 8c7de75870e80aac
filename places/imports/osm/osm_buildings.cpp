#include "places/imports/osm/osm_buildings.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/geometry/rectangle.h"
#include "places/imports/osm/osm_tags.h"
#include "places/imports/parts/solids.h"

namespace throng::imports {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Outline {
  const OsmArea* area;
  geometry::Rectangle bounds;
  std::vector<const OsmArea*> parts;
};

BuildingPiece building_piece(const OsmArea& area, const Tags& tags) {
  BuildingPiece piece{area.name,
                      area.area,
                      building_base_m(tags),
                      0,
                      true,
                      false,
                      building_looks(tags, roof_height_m(tags))};
  piece.to_m = std::max(building_height_m(tags), piece.from_m + 0.5);
  piece.stands = piece.from_m <= kHeadM && tag_value(tags, "building") != "roof";
  return piece;
}

// Tags that a part lacks are those of its building.
Tags inherited(const Tags& part, const Tags& building) {
  Tags tags = part;
  inherit_height(building, tags);
  inherit_looks(building, tags);
  const std::string& kind = tag_value(building, "building");
  tags["building"] = tag_value(part, "building:part") == "roof" ? "roof" : kind;
  return tags;
}

// The building that most of a part lies in.
std::size_t building_around(const OsmArea& part, const std::vector<Outline>& outlines) {
  const geometry::Rectangle bounds = geometry::bounding_box(part.area.outline);
  const double half_m2 = 0.5 * size_m2(part.area);
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (!bounds.meets(outlines[i].bounds)) continue;
    if (shared_m2(part.area, outlines[i].area->area) >= half_m2) return i;
  }
  return kNone;
}

// A tower on a base reaches the ground in it: it is drawn and flown around as one.
void stand_on_each_other(std::vector<BuildingPiece>& pieces) {
  constexpr double kSlackM = 0.5;
  constexpr double kMaxOverhang = 0.1;  // of the area
  std::vector<std::size_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return pieces[a].from_m < pieces[b].from_m;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    BuildingPiece& piece = pieces[order[i]];
    if (piece.stands) continue;
    std::vector<Area> below;
    for (std::size_t k = 0; k < i; ++k) {
      const BuildingPiece& other = pieces[order[k]];
      if (other.stands && other.from_m < piece.from_m && other.to_m + kSlackM >= piece.from_m) {
        below.push_back(other.area);
      }
    }
    double overhang_m2 = 0;
    for (const Area& rest : without(piece.area, below)) overhang_m2 += size_m2(rest);
    if (overhang_m2 > kMaxOverhang * size_m2(piece.area)) continue;
    piece.stands = true;
    piece.from_m = 0;
  }
}

void note_unread(const OsmArea& area, const BuildingPiece& piece, const std::string& file,
                 std::vector<Skipped>& skipped) {
  for (const std::string& tag : unread_building_sizes(area.tags)) {
    skipped.push_back(
        {file, 0, area.name,
         fmt::format("{} is no size such as 12, 12.5 m, 40 ft, 22'3\" or 3 levels: it "
                     "reaches from {:g} to {:g} m",
                     tag, piece.from_m, piece.to_m)});
  }
  for (const std::string& tag : undrawn_looks(area.tags)) {
    skipped.push_back({file, 0, area.name, fmt::format("{} is not drawn as it says", tag)});
  }
  const auto stated = stated_height_m(area.tags);
  if (stated && piece.from_m >= *stated) {
    skipped.push_back({file, 0, area.name,
                       fmt::format("its lower end at {:g} m is not below its height of {:g} m",
                                   piece.from_m, *stated)});
  }
}

/// The building itself stands beside its parts if they leave most of it bare: a church whose only
/// part is its tower.
void add_body(const Outline& outline, const BuildingPiece& whole, const std::string& file,
              std::vector<BuildingPiece>& pieces, std::vector<Skipped>& skipped) {
  constexpr double kMinBareShare = 0.5;  // of its area
  constexpr double kWorthSayingM2 = 5;
  std::vector<Area> covered;
  std::vector<Area> on_ground;
  for (const BuildingPiece& piece : pieces) {
    covered.push_back(piece.area);
    if (piece.from_m <= kHeadM) on_ground.push_back(piece.area);
  }
  double bare_m2 = 0;
  for (const Area& rest : without(whole.area, covered)) bare_m2 += size_m2(rest);
  if (bare_m2 > kMinBareShare * size_m2(whole.area)) {
    for (Area& rest : without(whole.area, on_ground)) {
      BuildingPiece body = whole;
      body.area = std::move(rest);
      body.part = whole.stands;
      pieces.push_back(std::move(body));
    }
  } else if (bare_m2 > kWorthSayingM2) {
    skipped.push_back(
        {file, 0, outline.area->name,
         fmt::format("is drawn by its parts, which leave {:.0f} m² of it bare", bare_m2)});
  }
}

void add_parts(const Outline& outline, const BuildingPiece& whole, const std::string& file,
               MapBuildings& result) {
  std::vector<BuildingPiece> pieces;
  for (const OsmArea* part : outline.parts) {
    pieces.push_back(building_piece(*part, inherited(part->tags, outline.area->tags)));
    pieces.back().part = whole.stands;
    // A part without a roof's shape is flat; a whole building may have any.
    world::Roof& roof = pieces.back().looks.roof;
    if (roof.kind == world::RoofKind::by_id) roof.kind = world::RoofKind::flat;
    note_unread(*part, pieces.back(), file, result.skipped);
  }
  add_body(outline, whole, file, pieces, result.skipped);
  stand_on_each_other(pieces);
  std::stable_sort(pieces.begin(), pieces.end(),
                   [](const auto& a, const auto& b) { return a.to_m > b.to_m; });
  result.pieces.insert(result.pieces.end(), pieces.begin(), pieces.end());
  if (whole.stands) result.outlines.push_back(outline.area->area);
}

}  // namespace

bool is_building(const Tags& tags) {
  return tags.contains("building") && tag_value(tags, "building") != "no";
}

bool is_building_part(const Tags& tags) {
  return tags.contains("building:part") && tag_value(tags, "building:part") != "no";
}

MapBuildings make_buildings(const std::vector<OsmArea>& areas, const std::string& file) {
  MapBuildings result;
  std::vector<Outline> outlines;
  const auto is_there = [&](const OsmArea& area) {
    if (!is_underground(area.tags)) return true;
    result.skipped.push_back({file, 0, area.name, "is underground"});
    return false;
  };
  for (const OsmArea& area : areas) {
    if (!is_building(area.tags) || !is_there(area)) continue;
    outlines.push_back({&area, geometry::bounding_box(area.area.outline), {}});
  }
  std::vector<const OsmArea*> alone;
  for (const OsmArea& area : areas) {
    if (is_building(area.tags) || !is_building_part(area.tags) || !is_there(area)) continue;
    const std::size_t around = building_around(area, outlines);
    if (around == kNone) {
      alone.push_back(&area);
    } else {
      outlines[around].parts.push_back(&area);
    }
  }
  for (const Outline& outline : outlines) {
    const BuildingPiece whole = building_piece(*outline.area, outline.area->tags);
    note_unread(*outline.area, whole, file, result.skipped);
    if (outline.parts.empty()) {
      result.pieces.push_back(whole);
    } else {
      add_parts(outline, whole, file, result);
    }
  }
  for (const OsmArea* part : alone) {
    result.pieces.push_back(building_piece(*part, part->tags));
    note_unread(*part, result.pieces.back(), file, result.skipped);
  }
  return result;
}

}  // namespace throng::imports
