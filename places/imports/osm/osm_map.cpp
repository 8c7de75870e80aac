#include "places/imports/osm/osm_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/geometry/rectangle.h"
#include "places/imports/osm/building_solids.h"
#include "places/imports/osm/osm_buildings.h"
#include "places/imports/osm/osm_gates.h"
#include "places/imports/osm/osm_passages.h"
#include "places/imports/osm/osm_props.h"
#include "places/imports/osm/osm_tags.h"
#include "places/imports/parts/populate.h"
#include "places/imports/parts/scenario_name.h"
#include "places/imports/parts/scenario_writer.h"
#include "places/imports/parts/solids.h"

namespace throng::imports {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kMinPatchM2 = 0.2;
const Vector3d kWaterRgb(0.05, 0.12, 0.2);

class MapReader {
 public:
  MapReader(OsmFile file, std::string source)
      : file_(std::move(file)), source_(std::move(source)), props_(place_, source_) {
    place_.inside = file_.bounds;
    place_.skipped = std::move(file_.skipped);
    ground_ = ground_rectangle(place_);
  }

  ImportedScenario read();

 private:
  void skip(const std::string& element, const std::string& reason) {
    place_.skipped.push_back({source_, 0, element, reason});
  }
  void add_surface(const Area& area, const std::string& material,
                   std::vector<world::GroundArea>& to);
  void note_outside();
  void add_buildings();
  void add_water(const OsmArea& found);
  void add_area(const OsmArea& found);
  void add_way(const OsmLine& line, const WayKind& kind);
  void add_crossings(const OsmLine& line, const WayKind& kind);
  void add_barrier(const OsmLine& line, const Barrier& barrier);
  std::vector<Area> openings_near(const Area& area) const;
  void add_line(const OsmLine& line);
  void add_street(const OsmLine& line, const std::string& name);
  void note_open_ring(const OsmLine& line, const std::string& name);
  void note_unread(const std::string& name, const std::vector<std::string>& tags,
                   const std::string& instead);
  Object& object(const std::string& name) { return place_.objects.emplace_back(Object{name, {}}); }

  OsmFile file_;
  std::string source_;
  world::Rectangle ground_;
  ImportedScenario place_;
  MapProps props_;
  std::vector<Area> openings_;        // in barriers
  std::set<std::int64_t> crossings_;  // nodes
  std::vector<world::GroundArea> green_;
  std::vector<world::GroundArea> paved_;
  std::vector<world::GroundArea> paths_;
  std::vector<world::GroundArea> roads_;
  std::vector<UsedWay> used_;
};

void MapReader::add_surface(const Area& area, const std::string& material,
                            std::vector<world::GroundArea>& to) {
  for (const Area& part : clipped(area, ground_)) {
    for (Corners& corners : simple_parts(part, kMinPatchM2)) {
      to.push_back({std::move(corners), material, false});
    }
  }
}

void MapReader::add_buildings() {
  BuildingSolids(place_, source_, find_passages(file_.lines))
      .add(make_buildings(file_.areas, source_));
}

void MapReader::add_water(const OsmArea& found) {
  constexpr double kSurfaceM = 0.02;
  Solid solid;
  solid.rgb = kWaterRgb;
  for (const Area& part : clipped(found.area, ground_)) {
    for (const Corners& corners : simple_parts(part, kMinPatchM2)) {
      const Triangles flat = prism_triangles(corners, 0, kSurfaceM);
      solid.triangles.insert(solid.triangles.end(), flat.begin(), flat.end());
      place_.obstacles.push_back(corners);
    }
  }
  if (!solid.triangles.empty()) object(found.name).solids.push_back(std::move(solid));
}

void MapReader::add_area(const OsmArea& found) {
  const Tags& tags = found.tags;
  if (is_building(tags) || is_building_part(tags)) return;  // add_buildings()
  if (is_underground(tags)) return skip(found.name, "is underground");
  if (is_water(tags)) return add_water(found);
  const std::string material = surface_material(tags);
  if (material == "grass") return add_surface(found.area, material, green_);
  if (!material.empty()) return add_surface(found.area, material, paved_);
  const bool silent = tags.contains("landuse") || tags.contains("amenity") ||
                      tags.contains("leisure") || tags.contains("area");
  if (!silent) skip(found.name, "an area that is not drawn");
}

// The bars of a crossing over the road, at the node that says so.
void MapReader::add_crossings(const OsmLine& line, const WayKind& kind) {
  constexpr double kBarsM = 4;
  constexpr double kClearOfKerb = 0.94;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (!crossings_.contains(line.nodes[i]) || !ground_.contains(line.points[i])) continue;
    const Vector2d along =
        line.points[std::min(i + 1, line.points.size() - 1)] - line.points[i > 0 ? i - 1 : 0];
    if (along.norm() < 0.1) continue;
    const Vector2d across =
        0.5 * kClearOfKerb * kind.width_m * Vector2d(-along.y(), along.x()).normalized();
    place_.markings.push_back(
        {"crossing", line.points[i] - across, line.points[i] + across, kBarsM});
  }
}

void MapReader::add_way(const OsmLine& line, const WayKind& kind) {
  for (const Area& area : along(line.points, kind.width_m)) {
    add_surface(area, kind.material, kind.road ? roads_ : paths_);
  }
  used_.push_back({&line, kind});
  if (!kind.road) return;
  add_crossings(line, kind);
  if (!kind.center_line) return;
  constexpr double kFromEndsM = 4;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const Vector2d way = line.points[i + 1] - line.points[i];
    if (way.norm() < 3 * kFromEndsM) continue;
    const Vector2d ends = kFromEndsM * way.normalized();
    const auto part = part_within(line.points[i] + ends, line.points[i + 1] - ends, ground_);
    if (part) place_.markings.push_back({"dashes", part->first, part->second, 0.12});
  }
}

std::vector<Area> MapReader::openings_near(const Area& area) const {
  const geometry::Rectangle bounds = geometry::bounding_box(area.outline);
  std::vector<Area> near;
  for (const Area& opening : openings_) {
    if (bounds.meets(geometry::bounding_box(opening.outline))) near.push_back(opening);
  }
  return near;
}

void MapReader::add_barrier(const OsmLine& line, const Barrier& barrier) {
  Solid solid;
  solid.rgb = barrier.rgb;
  for (const Area& whole : along(line.points, barrier.width_m)) {
    for (const Area& closed : without(whole, openings_near(whole))) {
      for (const Area& part : clipped(closed, ground_)) {
        for (const Corners& corners : simple_parts(part)) {
          const Triangles prism = prism_triangles(corners, 0, barrier.height_m);
          solid.triangles.insert(solid.triangles.end(), prism.begin(), prism.end());
          place_.obstacles.push_back(corners);
        }
      }
    }
  }
  if (!solid.triangles.empty()) {
    object(fmt::format("{} {}", tag_value(line.tags, "barrier"), line.id)).solids.push_back(solid);
  }
}

// Mappers close the rings of areas; those that are open may be slips.
void MapReader::note_open_ring(const OsmLine& line, const std::string& name) {
  if (line.edge_of_area) return;
  const double gap_m = (line.points.front() - line.points.back()).norm();
  const std::string missing =
      line.missing == 0 ? "" : fmt::format("; {} of its nodes are not in the file", line.missing);
  skip(name, gap_m == 0 ? fmt::format("its ring has no area{}", missing)
                        : fmt::format("its ring does not close: the ends are {:.1f} m apart{}",
                                      gap_m, missing));
}

void MapReader::note_unread(const std::string& name, const std::vector<std::string>& tags,
                            const std::string& instead) {
  for (const std::string& tag : tags) {
    skip(name, fmt::format("{} cannot be read: {}", tag, instead));
  }
}

void MapReader::add_street(const OsmLine& line, const std::string& name) {
  if (is_off_ground(line.tags)) return skip(name, "a way above or below the ground");
  const auto kind = way_kind(line.tags);
  if (!kind) {
    return skip(name,
                fmt::format("highway={} has no ground here", tag_value(line.tags, "highway")));
  }
  const std::string width = fmt::format("it is {:g} m wide", kind->width_m);
  note_unread(name, unread_lengths(line.tags, {"width"}), width);
  if (kind->road) note_unread(name, unread_counts(line.tags, {"lanes"}), width);
  add_way(line, *kind);
}

void MapReader::add_line(const OsmLine& line) {
  const std::string name = fmt::format("way {}", line.id);
  if (line.tags.contains("highway")) return add_street(line, name);
  if (const auto barrier = find_barrier(line.tags)) {
    note_unread(name, unread_lengths(line.tags, {"height"}),
                fmt::format("it is {:g} m high", barrier->height_m));
    return add_barrier(line, *barrier);
  }
  if (tag_value(line.tags, "natural") == "tree_row") return props_.add_row(line);
  if (is_ring(line.tags)) return note_open_ring(line, name);
  constexpr std::array<const char*, 11> kSeen = {
      "railway", "waterway",  "natural", "barrier",  "man_made",        "power",
      "aeroway", "aerialway", "leisure", "historic", "public_transport"};
  for (const char* key : kSeen) {
    if (line.tags.contains(key)) {
      return skip(name, fmt::format("{}={} is not drawn", key, tag_value(line.tags, key)));
    }
  }
}

// Extracts hold whole ways, also where these reach beyond the bounds.
void MapReader::note_outside() {
  const geometry::Rectangle ground{ground_.min, ground_.max};
  const auto outside =
      std::count_if(file_.areas.begin(), file_.areas.end(),
                    [&](const OsmArea& area) {
                      return !geometry::bounding_box(area.area.outline).meets(ground);
                    }) +
      std::count_if(file_.lines.begin(), file_.lines.end(), [&](const OsmLine& line) {
        return !geometry::bounding_box(line.points).meets(ground);
      });
  if (outside > 0) skip("edge", fmt::format("{} areas and ways are outside of it", outside));
}

ImportedScenario MapReader::read() {
  constexpr double kGateM = 2.4;
  for (const OsmPoint& point : file_.points) {
    const std::string& barrier = tag_value(point.tags, "barrier");
    if (barrier == "gate" || barrier == "entrance" || barrier == "lift_gate") {
      const Vector2d half = Vector2d::Constant(0.5 * kGateM);
      openings_.push_back({rectangle_corners({point.position - half, point.position + half}), {}});
    }
    if (tag_value(point.tags, "highway") == "crossing") crossings_.insert(point.id);
  }
  note_outside();
  add_buildings();
  for (const OsmArea& area : file_.areas) add_area(area);
  for (const OsmLine& line : file_.lines) add_line(line);
  for (const OsmPoint& point : file_.points) props_.add(point);
  props_.list();
  for (const auto* layer : {&green_, &paved_, &paths_, &roads_}) {
    place_.areas.insert(place_.areas.end(), layer->begin(), layer->end());
  }
  place_.gates = gates_at_edge(used_, place_.inside);
  place_.people_come = true;
  return std::move(place_);
}

}  // namespace

ImportedScenario read_osm(const std::filesystem::path& file, const OsmOptions& options) {
  OsmFile extract = read_osm_file(file, options.origin);
  constexpr double kMinSizeM = 20;
  constexpr double kAroundM = 8;
  const Vector2d around = Vector2d::Constant(kAroundM);
  const auto size = [&] { return Vector2d(extract.bounds.max - extract.bounds.min); };
  const auto grow = [&] {
    extract.bounds = {extract.bounds.min - around, extract.bounds.max + around};
  };
  if (!extract.has_bounds && size().minCoeff() < kMinSizeM) grow();
  if (!(size().minCoeff() >= kMinSizeM)) {
    throw InputError({file.string(), "bounds",
                      fmt::format("{:.1f} m x {:.1f} m", size().x(), size().y()),
                      "at least 20 m x 20 m"});
  }
  const auto read = [&] {
    ImportedScenario scenario = MapReader(extract, file.string()).read();
    scenario.gates_asked = !options.gates.empty();
    if (scenario.gates_asked) scenario.gates = options.gates;
    return scenario;
  };
  ImportedScenario scenario = read();
  // Larger ones are not walled up, and take long to look at.
  constexpr double kSmallM = 500;
  const bool small = size().maxCoeff() < kSmallM;
  if (small && !scenario.gates_asked && open_ground_m2(scenario) == 0) {
    grow();
    scenario = read();
    scenario.skipped.push_back(
        {file.string(), 0, "edge", "walled up: there are 8 m of ground around"});
  }
  scenario.name = scenario_name_from(file);
  scenario.description = fmt::format("Imported from {} (OpenStreetMap).", file.filename().string());
  return scenario;
}

}  // namespace throng::imports
