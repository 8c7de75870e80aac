#include "places/imports/osm/osm_file.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <osmium/area/assembler.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/osm.hpp>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "base/geometry/angle.h"
#include "places/imports/osm/osm_rings.h"
#include "places/imports/osm/osm_text.h"
#include "places/imports/parts/xml_words.h"

namespace throng::imports {

namespace fs = std::filesystem;
using Eigen::Vector2d;

namespace {

constexpr std::uintmax_t kMaxFileBytes = 256U << 20U;
constexpr std::size_t kMaxNodes = 2'000'000;
constexpr double kMaxSizeM = 5'000;
constexpr const char* kBadValue = "an id or a value that is no number, or is too long";
constexpr const char* kNumbers = "an extract of OpenStreetMap with ids that are numbers";

/// Meters east and north of a point on the WGS 84 ellipsoid, by its radii of curvature there
/// (Torge, Geodesy, 2001, section 4.1.3).
class Projection {
 public:
  explicit Projection(const GeoPoint& origin) : origin_(origin) {
    constexpr double kEquatorM = 6'378'137;
    constexpr double kEccentricity2 = 6.69437999014e-3;
    const double sine = std::sin(origin.latitude_deg * kDegree);
    const double w = std::sqrt(1 - kEccentricity2 * sine * sine);
    north_m_ = kEquatorM * (1 - kEccentricity2) / (w * w * w) * kDegree;
    east_m_ = kEquatorM / w * std::cos(origin.latitude_deg * kDegree) * kDegree;
  }

  Vector2d at(const osmium::Location& location) const {
    return {east_m_ * (location.lon() - origin_.longitude_deg),
            north_m_ * (location.lat() - origin_.latitude_deg)};
  }

 private:
  GeoPoint origin_;
  double north_m_;  // of a degree
  double east_m_;
};

/// Everything that the file holds, and where its nodes are.
struct Extract {
  osmium::memory::Buffer buffer{1U << 16U, osmium::memory::Buffer::auto_grow::yes};
  osmium::Box bounds;
  bool has_bounds = false;  // the file says
  std::unordered_map<std::int64_t, osmium::Location> nodes;
  std::set<OsmId> deleted;
};

Tags read_tags(const osmium::TagList& list) {
  Tags tags;
  for (const osmium::Tag& tag : list) tags[tag.key()] = tag.value();
  return tags;
}

// Closed ways with one of these are areas, others rings of road or wall.
bool is_area(const osmium::TagList& tags) {
  if (tags.has_tag("area", "no")) return false;
  constexpr std::array<const char*, 8> kAreas = {"building", "building:part", "landuse", "leisure",
                                                 "natural",  "amenity",       "area",    "water"};
  for (const char* key : kAreas) {
    if (tags.has_key(key)) return true;
  }
  return tags.has_tag("waterway", "riverbank") || tags.has_tag("waterway", "dock");
}

void read_all(const fs::path& file, Extract& extract) {
  OsmText plain = plain_osm(read_file(file));
  extract.deleted = std::move(plain.deleted);
  osmium::io::Reader reader{osmium::io::File{plain.text.data(), plain.text.size(), "osm"}};
  extract.bounds = reader.header().joined_boxes();
  while (osmium::memory::Buffer part = reader.read()) {
    extract.buffer.add_buffer(part);
    extract.buffer.commit();
  }
  reader.close();
  osmium::Box all;
  for (const osmium::Node& node : extract.buffer.select<osmium::Node>()) {
    if (!node.visible() || !node.location().valid()) continue;
    if (extract.deleted.contains({'n', node.id()})) continue;
    extract.nodes[node.id()] = node.location();
    if (extract.nodes.size() > kMaxNodes) {
      throw InputError(
          {file.string(), "", fmt::format("more than {} nodes", kMaxNodes), "a smaller extract"});
    }
    all.extend(node.location());
  }
  for (const osmium::Way& way : extract.buffer.select<osmium::Way>()) {
    for (const osmium::NodeRef& node : way.nodes()) {  // as Overpass writes them by "out geom"
      if (node.location().valid()) all.extend(node.location());
    }
  }
  extract.has_bounds = extract.bounds.valid();
  if (!extract.has_bounds) extract.bounds = all;
  if (!extract.bounds.valid()) {
    throw InputError({file.string(), "", "no bounds and no nodes", "an extract of OpenStreetMap"});
  }
}

class ExtractReader {
 public:
  ExtractReader(std::string name, Extract& extract, const Projection& projection)
      : name_(std::move(name)), extract_(extract), projection_(projection) {
    config_.create_empty_areas = false;
  }

  OsmFile read() {
    for (const osmium::Node& node : extract_.buffer.select<osmium::Node>()) {
      if (node.tags().empty() || !is_there('n', node)) continue;
      if (!extract_.nodes.contains(node.id())) {
        skip(fmt::format("node {}", node.id()), "its lat and lon are no position");
        continue;
      }
      result_.points.push_back(
          {node.id(), read_tags(node.tags()), projection_.at(node.location())});
    }
    for (osmium::Way& way : extract_.buffer.select<osmium::Way>()) {
      locate(way);
      if (is_there('w', way)) ways_[way.id()] = &way;
    }
    std::vector<const osmium::Relation*> multipolygons;
    for (const osmium::Relation& relation : extract_.buffer.select<osmium::Relation>()) {
      if (!is_there('r', relation)) continue;
      if (!relation.tags().has_tag("type", "multipolygon")) {
        note_other(relation);
        continue;
      }
      multipolygons.push_back(&relation);
      for (const osmium::RelationMember& member : relation.members()) {
        if (member.type() == osmium::item_type::way) edges_of_areas_.insert(member.ref());
      }
      if (relation.tags().size() == 1) find_tags_of_outers(relation);
    }
    for (const auto& way : extract_.buffer.select<osmium::Way>()) {
      if (!way.tags().empty() && is_there('w', way)) add_way(way);
    }
    for (const osmium::Relation* relation : multipolygons) add_relation(*relation);
    return std::move(result_);
  }

 private:
  bool is_there(char kind, const osmium::OSMObject& object) const {
    return object.visible() && !extract_.deleted.contains({kind, object.id()});
  }

  /// Lists relations that state an area as multipolygons do.
  void note_other(const osmium::Relation& relation) {
    const char* const type = relation.tags().get_value_by_key("type", "");
    const bool groups_ways =
        std::string_view(type) == "building" || std::string_view(type) == "site";
    if (groups_ways || !is_area(relation.tags())) return;
    skip(fmt::format("relation {}", relation.id()),
         fmt::format("its type is \"{}\"; areas have the type multipolygon", type));
  }

  // Until 2017 a multipolygon's tags stood on its outer ways.
  void find_tags_of_outers(const osmium::Relation& relation) {
    for (const osmium::RelationMember& member : relation.members()) {
      const auto way = ways_.find(member.ref());
      if (member.type() != osmium::item_type::way || way == ways_.end()) continue;
      if (std::string_view(member.role()) == "inner" || !is_area(way->second->tags())) continue;
      tags_of_outers_.try_emplace(relation.id(), read_tags(way->second->tags()));
      drawn_by_relations_.insert(way->first);
    }
  }

  void locate(osmium::Way& way) const {
    for (osmium::NodeRef& node : way.nodes()) {
      const auto known = extract_.nodes.find(node.ref());
      if (known != extract_.nodes.end()) node.set_location(known->second);
    }
    close_by_place(way);
  }

  /// Closes a way whose last node is another one at the place of the first.
  void close_by_place(osmium::Way& way) const {
    constexpr std::size_t kMinNodes = 4;  // nodes of a triangle
    constexpr double kSamePlaceM = 0.1;
    if (way.nodes().size() < kMinNodes) return;
    const osmium::NodeRef& first = way.nodes().front();
    osmium::NodeRef& last = *std::prev(way.nodes().end());
    if (!first.location().valid() || !last.location().valid()) return;
    const Vector2d gap = projection_.at(first.location()) - projection_.at(last.location());
    if (gap.norm() <= kSamePlaceM) last = first;
  }

  static bool is_complete(const osmium::Way& way) {
    for (const osmium::NodeRef& node : way.nodes()) {
      if (!node.location().valid()) return false;
    }
    return !way.nodes().empty();
  }

  void skip(const std::string& element, const std::string& reason) {
    result_.skipped.push_back({name_, 0, element, reason});
  }

  void add_way(const osmium::Way& way) {
    const std::string name = fmt::format("way {}", way.id());
    if (way.nodes().size() >= 4 && way.is_closed() && is_area(way.tags())) {
      if (drawn_by_relations_.contains(way.id())) return;
      if (!is_complete(way)) return skip(name, "some of its nodes are not in the file");
      osmium::area::Assembler assembler{config_};
      osmium::memory::Buffer made{1U << 12U, osmium::memory::Buffer::auto_grow::yes};
      assembler(way, made);
      const Tags tags = read_tags(way.tags());
      if (!add_areas(made, name, tags)) repair({&way}, {}, name, tags);
      if (!tags.contains("barrier")) return;  // else it is fenced, too
    }
    OsmLine line{way.id(), read_tags(way.tags()), {}, {}, 0, edges_of_areas_.contains(way.id())};
    for (const osmium::NodeRef& node : way.nodes()) {
      if (!node.location().valid()) {
        ++line.missing;
        continue;
      }
      line.points.push_back(projection_.at(node.location()));
      line.nodes.push_back(node.ref());
    }
    if (line.points.size() < 2) {
      return skip(name, fmt::format("{} of its {} nodes are in the file", line.points.size(),
                                    way.nodes().size()));
    }
    result_.lines.push_back(std::move(line));
  }

  void add_relation(const osmium::Relation& relation) {
    const std::string name = fmt::format("relation {}", relation.id());
    std::vector<const osmium::Way*> members;
    std::vector<const osmium::Way*> outer;
    std::vector<const osmium::Way*> inner;
    for (const osmium::RelationMember& member : relation.members()) {
      if (member.type() != osmium::item_type::way) continue;
      const auto way = ways_.find(member.ref());
      if (way == ways_.end() || !is_complete(*way->second)) {
        return skip(name, fmt::format("way {} is not whole in the file", member.ref()));
      }
      members.push_back(way->second);
      (std::string_view(member.role()) == "inner" ? inner : outer).push_back(way->second);
    }
    if (outer.empty()) return skip(name, "a multipolygon without an outer way");
    const auto lent = tags_of_outers_.find(relation.id());
    const Tags tags = lent == tags_of_outers_.end() ? read_tags(relation.tags()) : lent->second;
    // The assembler counts ways and members alike.
    if (members.size() == relation.members().size()) {
      osmium::area::Assembler assembler{config_};
      osmium::memory::Buffer made{1U << 12U, osmium::memory::Buffer::auto_grow::yes};
      assembler(relation, members, made);
      if (add_areas(made, name, tags)) return;
    }
    repair(outer, inner, name, tags);
  }

  // Nodes at one place count as one.
  JoinedRings joined(const std::vector<const osmium::Way*>& ways) const {
    std::vector<WayNodes> parts;
    std::map<osmium::Location, std::int64_t> node_at;
    for (const osmium::Way* way : ways) {
      WayNodes& part = parts.emplace_back();
      for (const osmium::NodeRef& node : way->nodes()) {
        part.nodes.push_back(node_at.try_emplace(node.location(), node.ref()).first->second);
        part.points.push_back(projection_.at(node.location()));
      }
    }
    return joined_rings(std::move(parts));
  }

  // Takes areas that libosmium cannot assemble apart at their crossings.
  void repair(const std::vector<const osmium::Way*>& outer,
              const std::vector<const osmium::Way*>& inner, const std::string& name,
              const Tags& tags) {
    const JoinedRings outlines = joined(outer);
    const JoinedRings holes = joined(inner);
    std::vector<Area> found;
    for (const Corners& outline : outlines.rings) {
      for (Area& area : repaired({outline, {}})) found.push_back(std::move(area));
    }
    std::vector<Area> cut;
    for (const Corners& hole : holes.rings) {
      for (Area& area : repaired({hole, {}})) cut.push_back(std::move(area));
    }
    bool any = false;
    for (const Area& area : found) {
      for (Area& rest : without(area, cut)) {
        result_.areas.push_back({name, tags, std::move(rest)});
        any = true;
      }
    }
    if (!any) return skip(name, "its edges cross or do not close");
    if (outlines.open + holes.open > 0) skip(name, "parts of it that do not close");
  }

  Corners corners_of_ring(const osmium::NodeRefList& ring) const {
    Corners corners;
    for (const osmium::NodeRef& node : ring) corners.push_back(projection_.at(node.location()));
    if (!corners.empty()) corners.pop_back();  // the first one again
    return corners;
  }

  bool add_areas(const osmium::memory::Buffer& made, const std::string& name, const Tags& tags) {
    bool any = false;
    for (const osmium::Area& found : made.select<osmium::Area>()) {
      for (const osmium::OuterRing& outer : found.outer_rings()) {
        Area area{corners_of_ring(outer), {}};
        for (const osmium::InnerRing& inner : found.inner_rings(outer)) {
          area.holes.push_back(corners_of_ring(inner));
        }
        const auto tidy = tidied(area);
        if (!tidy) continue;
        result_.areas.push_back({name, tags, *tidy});
        any = true;
      }
    }
    return any;
  }

  std::string name_;
  Extract& extract_;
  const Projection& projection_;
  osmium::area::AssemblerConfig config_;  // assemblers refer to it
  std::unordered_map<std::int64_t, const osmium::Way*> ways_;
  std::unordered_map<std::int64_t, Tags> tags_of_outers_;  // by relation
  std::set<std::int64_t> drawn_by_relations_;              // ways
  std::set<std::int64_t> edges_of_areas_;                  // ways
  OsmFile result_;
};

}  // namespace

OsmFile read_osm_file(const fs::path& file, const std::optional<GeoPoint>& origin) {
  std::error_code unreadable;
  const std::uintmax_t size = fs::file_size(file, unreadable);
  if (unreadable) throw EnvironmentError(fmt::format("cannot read {}", file.string()));
  if (size > kMaxFileBytes) {
    throw InputError({file.string(), "", "a file of more than 256 MB", "a smaller extract"});
  }
  Extract extract;
  try {
    read_all(file, extract);
  } catch (const osmium::xml_error& error) {
    const bool has_line = error.line > 0;
    throw InputError({file.string(), has_line ? fmt::format("line {}", error.line) : "",
                      has_line ? expat_fault(error.error_code)
                               : "elements that extracts do not have, or entities",
                      "an extract of OpenStreetMap (XML)"});
  } catch (const osmium::format_version_error& error) {
    throw InputError({file.string(), "<osm>",
                      error.version.empty() ? "no version" : "version " + error.version,
                      "version 0.6 of OpenStreetMap's XML"});
  } catch (const osmium::io_error&) {
    throw InputError({file.string(), "", "a file that is no XML of OpenStreetMap",
                      "an extract of OpenStreetMap (XML)"});
  } catch (const std::logic_error&) {  // of an argument or a length
    throw InputError({file.string(), "", kBadValue, kNumbers});
  } catch (const std::range_error&) {
    throw InputError({file.string(), "", kBadValue, kNumbers});
  }
  const osmium::Location low = extract.bounds.bottom_left();
  const osmium::Location high = extract.bounds.top_right();
  const GeoPoint middle{0.5 * (low.lat() + high.lat()), 0.5 * (low.lon() + high.lon())};
  const Projection projection(origin.value_or(middle));
  const world::Rectangle bounds{projection.at(low), projection.at(high)};
  const Vector2d extent = bounds.max - bounds.min;
  constexpr double kMaxCoordinateM = 50'000;
  const double farthest =
      std::max(bounds.min.cwiseAbs().maxCoeff(), bounds.max.cwiseAbs().maxCoeff());
  if (!(extent.maxCoeff() <= kMaxSizeM) || !(farthest <= kMaxCoordinateM) ||
      std::abs(middle.latitude_deg) > 85) {
    throw InputError({file.string(), "bounds",
                      fmt::format("{:.0f} m x {:.0f} m, {:.0f} m from the origin", extent.x(),
                                  extent.y(), farthest),
                      "at most 5 km, near the origin and not at a pole (a smaller extract: `osmium "
                      "extract -b`)"});
  }
  ExtractReader reader(file.string(), extract, projection);
  OsmFile result = reader.read();
  result.bounds = bounds;
  result.has_bounds = extract.has_bounds;
  return result;
}

}  // namespace throng::imports
