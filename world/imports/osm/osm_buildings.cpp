#include "world/imports/osm/osm_buildings.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/geometry/rectangle.h"
#include "world/imports/osm/osm_tags.h"
#include "world/imports/parts/solids.h"

namespace throng::imports {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Outline {
  const OsmArea* area;
  geometry::Rectangle bounds;
  std::vector<const OsmArea*> parts;
};

BuildingPiece building_piece(const OsmArea& area, const Tags& tags) {
  BuildingPiece piece{area.name, area.area, building_base_m(tags), 0, true, false};
  piece.to_m = std::max(building_height_m(tags), piece.from_m + 0.5);
  piece.stands = piece.from_m <= kHeadM && tag_value(tags, "building") != "roof";
  return piece;
}

// Tags that a part lacks are those of its building.
Tags inherited(const Tags& part, const Tags& building) {
  Tags tags = part;
  constexpr const char* kHeight = "height";
  constexpr const char* kLevels = "building:levels";
  if (!part.contains(kHeight) && !part.contains(kLevels)) {
    for (const char* key : {kHeight, kLevels, "roof:height", "roof:levels"}) {
      const std::string& value = tag_value(building, key);
      if (!value.empty()) tags.try_emplace(key, value);
    }
  }
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
  for (const OsmArea& area : areas) {
    if (!is_building(area.tags)) continue;
    if (is_underground(area.tags)) {
      result.skipped.push_back({file, 0, area.name, "is underground"});
    } else {
      outlines.push_back({&area, geometry::bounding_box(area.area.outline), {}});
    }
  }
  std::vector<const OsmArea*> alone;
  for (const OsmArea& area : areas) {
    if (is_building(area.tags) || !is_building_part(area.tags)) continue;
    const std::size_t around = building_around(area, outlines);
    if (around == kNone) {
      alone.push_back(&area);
    } else {
      outlines[around].parts.push_back(&area);
    }
  }
  for (const Outline& outline : outlines) {
    const BuildingPiece whole = building_piece(*outline.area, outline.area->tags);
    if (outline.parts.empty()) {
      result.pieces.push_back(whole);
      continue;
    }
    std::vector<BuildingPiece> pieces;
    std::vector<Area> covered;
    for (const OsmArea* part : outline.parts) {
      pieces.push_back(building_piece(*part, inherited(part->tags, outline.area->tags)));
      pieces.back().part = whole.stands;
      covered.push_back(part->area);
    }
    stand_on_each_other(pieces);
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const auto& a, const auto& b) { return a.to_m > b.to_m; });
    result.pieces.insert(result.pieces.end(), pieces.begin(), pieces.end());
    if (whole.stands) result.outlines.push_back(outline.area->area);
    double bare_m2 = 0;
    for (const Area& rest : without(outline.area->area, covered)) bare_m2 += size_m2(rest);
    constexpr double kWorthSayingM2 = 5;
    if (bare_m2 > kWorthSayingM2) {
      result.skipped.push_back(
          {file, 0, outline.area->name,
           fmt::format("is drawn by its parts, which leave {:.0f} m² of it bare", bare_m2)});
    }
  }
  for (const OsmArea* part : alone) result.pieces.push_back(building_piece(*part, part->tags));
  return result;
}

}  // namespace throng::imports
