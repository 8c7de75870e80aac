#include "places/imports/osm/osm_props.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/geometry/angle.h"
#include "places/imports/osm/osm_lengths.h"
#include "places/imports/osm/osm_tags.h"

namespace throng::imports {

using Eigen::Vector2d;

namespace {

constexpr std::size_t kMaxProps = 20'000;

struct NamedProp {
  const char* key;
  const char* value;
  world::PropKind kind;
};

constexpr std::array<NamedProp, 29> kProps = {
    {{"natural", "tree", world::PropKind::tree},
     {"natural", "shrub", world::PropKind::bush},
     {"man_made", "planter", world::PropKind::planter},
     {"highway", "street_lamp", world::PropKind::lamp_post},
     {"amenity", "bench", world::PropKind::bench},
     {"amenity", "waste_basket", world::PropKind::bin},
     {"barrier", "bollard", world::PropKind::bollard},
     {"amenity", "bicycle_parking", world::PropKind::bicycle_rack},
     {"amenity", "bicycle_rental", world::PropKind::bicycle_rack},
     {"amenity", "charging_station", world::PropKind::charging_station},
     {"amenity", "drinking_water", world::PropKind::drinking_fountain},
     {"amenity", "fountain", world::PropKind::fountain},
     {"amenity", "parking_meter", world::PropKind::parking_meter},
     {"amenity", "post_box", world::PropKind::post_box},
     {"amenity", "recycling", world::PropKind::recycling_container},
     {"amenity", "telephone", world::PropKind::phone_booth},
     {"amenity", "vending_machine", world::PropKind::vending_machine},
     {"advertising", "column", world::PropKind::advertising_column},
     {"emergency", "fire_hydrant", world::PropKind::hydrant},
     {"highway", "bus_stop", world::PropKind::bus_stop},
     {"highway", "stop", world::PropKind::traffic_sign},
     {"highway", "give_way", world::PropKind::traffic_sign},
     {"highway", "traffic_signals", world::PropKind::traffic_light},
     {"historic", "memorial", world::PropKind::statue},
     {"leisure", "picnic_table", world::PropKind::picnic_table},
     {"leisure", "playground", world::PropKind::swing},
     {"man_made", "flagpole", world::PropKind::flagpole},
     {"man_made", "street_cabinet", world::PropKind::cabinet},
     {"tourism", "artwork", world::PropKind::statue}}};

/// Whether another part of the import uses such a node.
bool is_used(const std::string& key, const std::string& value) {
  if (key == "barrier") return value == "gate" || value == "entrance" || value == "lift_gate";
  return key == "highway" && value == "crossing";
}

}  // namespace

void MapProps::add(world::PropKind kind, const Vector2d& at, const Tags& tags, std::uint32_t look,
                   const std::string& name) {
  if (!place_.inside.contains(at)) {
    ++outside_;
    return;
  }
  if (place_.props.size() >= kMaxProps) {
    ++too_many_;
    return;
  }
  world::Prop prop;
  prop.kind = kind;
  prop.position = at;
  prop.look = look % 16;
  if (kind == world::PropKind::tree) {
    constexpr double kTreeM = 8;
    prop.scale =
        std::clamp(length_in(tag_value(tags, "height")).value_or(kTreeM) / kTreeM, 0.4, 2.5);
    for (const std::string& tag : unread_lengths(tags, {"height"})) {
      place_.skipped.push_back(
          {source_, 0, name, fmt::format("{} is no length: {:g} m", tag, kTreeM)});
    }
  }
  // A bench looks to its right, seen along its heading; directions are clockwise from north.
  if (const auto towards = length_in(tag_value(tags, "direction"))) {
    prop.yaw_rad = geometry::wrapped_rad(std::numbers::pi - *towards * kDegree);
  }
  place_.props.push_back(prop);
}

void MapProps::note_other(const OsmPoint& point) {
  constexpr std::array<const char*, 13> kSeen = {
      "building",    "building:part",    "barrier", "man_made",  "natural",
      "power",       "highway",          "amenity", "emergency", "historic",
      "advertising", "public_transport", "railway"};
  if (!place_.inside.contains(point.position)) return;
  for (const char* key : kSeen) {
    const std::string& value = tag_value(point.tags, key);
    if (value.empty() || value == "no") continue;
    if (!is_used(key, value)) others_[fmt::format("{}={}", key, value)].push_back(point.id);
    return;
  }
}

void MapProps::add(const OsmPoint& point) {
  for (const NamedProp& named : kProps) {
    if (tag_value(point.tags, named.key) != named.value) continue;
    return add(named.kind, point.position, point.tags,
               static_cast<std::uint32_t>(point.id & 0xFFFF), fmt::format("node {}", point.id));
  }
  note_other(point);
}

void MapProps::add_row(const OsmLine& line) {
  constexpr double kApartM = 8;
  double since = kApartM;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const Vector2d way = line.points[i + 1] - line.points[i];
    const double length = way.norm();
    for (double at = kApartM - since; at <= length; at += kApartM) {
      if (at < 0) continue;
      const Vector2d position = line.points[i] + at / std::max(length, 1e-9) * way;
      add(world::PropKind::tree, position, line.tags,
          static_cast<std::uint32_t>(place_.props.size()), fmt::format("way {}", line.id));
    }
    since = std::fmod(since + length, kApartM);
  }
}

void MapProps::list() {
  constexpr std::size_t kMaxIds = 10;
  for (const auto& [kind, ids] : others_) {
    const std::size_t shown = std::min(ids.size(), kMaxIds);
    const std::vector<std::int64_t> first(ids.begin(),
                                          ids.begin() + static_cast<std::ptrdiff_t>(shown));
    place_.skipped.push_back(
        {source_, 0,
         fmt::format("{} {}", ids.size() == 1 ? "node" : "nodes", fmt::join(first, ", ")),
         ids.size() == shown ? fmt::format("{} is not drawn", kind)
                             : fmt::format("{} is not drawn, nor are {} more nodes of the kind",
                                           kind, ids.size() - shown)});
  }
  if (outside_ > 0) {
    place_.skipped.push_back(
        {source_, 0, "edge",
         fmt::format("{} trees, lamps and other props are outside of it", outside_)});
  }
  if (too_many_ > 0) {
    place_.skipped.push_back(
        {source_, 0, "props",
         fmt::format("{} more than the {} that a scenario has at most", too_many_, kMaxProps)});
  }
}

}  // namespace throng::imports
