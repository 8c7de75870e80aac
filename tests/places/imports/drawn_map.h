// Small maps for tests, drawn in meters.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/files/files.h"
#include "base/geometry/polygon.h"
#include "places/imports/osm/osm_map.h"
#include "tests/world/temporary_folder.h"

namespace throng::imports_testing {

using imports::Corners;
using imports::Gate;
using imports::GeoPoint;
using imports::ImportedScenario;
using imports::OsmFile;
using imports::read_osm;
using imports::read_osm_file;

// A map on a grid of meters about 0, 0, where a degree has 110.574 km north and 111.320 km east.
class DrawnMap {
 public:
  int node(double x, double y, const std::string& more = "") {
    text_ += fmt::format("<node id='{}' lat='{:.9f}' lon='{:.9f}' {}/>", ++last_, y / 110'574,
                         x / 111'320, more);
    return last_;
  }
  int tagged_node(double x, double y, const std::string& tags) {
    text_ += fmt::format("<node id='{}' lat='{:.9f}' lon='{:.9f}'>{}</node>", ++last_, y / 110'574,
                         x / 111'320, tag_text(tags));
    return last_;
  }
  std::vector<int> ring(const std::vector<std::pair<double, double>>& corners) {
    std::vector<int> nodes;
    for (const auto& [x, y] : corners) nodes.push_back(node(x, y));
    nodes.push_back(nodes.front());
    return nodes;
  }
  std::vector<int> box(double x1, double y1, double x2, double y2) {
    return ring({{x1, y1}, {x2, y1}, {x2, y2}, {x1, y2}});
  }
  int way(const std::vector<int>& nodes, const std::string& tags, const std::string& more = "") {
    text_ += fmt::format("<way id='{}' {}>", ++last_, more);
    for (const int node : nodes) text_ += fmt::format("<nd ref='{}'/>", node);
    text_ += tag_text(tags) + "</way>";
    return last_;
  }
  int relation(const std::string& members, const std::string& tags, const std::string& more = "") {
    text_ +=
        fmt::format("<relation id='{}' {}>{}{}</relation>", ++last_, more, members, tag_text(tags));
    return last_;
  }
  /// A member for relation().
  static std::string member(int way, const char* role) {
    return fmt::format("<member type='way' ref='{}' role='{}'/>", way, role);
  }
  /// The extract as text, 111 m x 111 m about the origin.
  std::string text() const {
    return "<osm version='0.6'><bounds minlat='-0.0005' minlon='-0.0005' maxlat='0.0005' "
           "maxlon='0.0005'/>" +
           text_ + "</osm>";
  }
  ImportedScenario read(const std::vector<Gate>& gates = {}) const {
    const throng::testing::TemporaryFolder folder;
    write_file_atomically(folder.path() / "m.osm", text());
    return read_osm(folder.path() / "m.osm", {GeoPoint{0, 0}, gates});
  }
  OsmFile read_file() const {
    const throng::testing::TemporaryFolder folder;
    write_file_atomically(folder.path() / "m.osm", text());
    return read_osm_file(folder.path() / "m.osm", GeoPoint{0, 0});
  }

 private:
  // "building=yes height=5"; an underscore pair "__" is a space in a value.
  static std::string tag_text(const std::string& words) {
    std::string tags;
    for (std::size_t at = 0; at < words.size();) {
      const std::size_t end = std::min(words.find(' ', at), words.size());
      const std::string word = words.substr(at, end - at);
      const std::size_t sign = word.find('=');
      std::string value = word.substr(sign + 1);
      for (std::size_t two = value.find("__"); two != std::string::npos; two = value.find("__")) {
        value.replace(two, 2, " ");
      }
      tags += fmt::format("<tag k='{}' v='{}'/>", word.substr(0, sign), value);
      at = end + 1;
    }
    return tags;
  }
  std::string text_;
  int last_ = 0;
};

inline double height_at(const ImportedScenario& scenario, const Eigen::Vector2d& point) {
  for (const world::Building& building : scenario.buildings) {
    if (geometry::distance_to(building.footprint, point) == 0) return building.height_m;
  }
  return 0;
}

inline bool stops_people(const ImportedScenario& scenario, const Eigen::Vector2d& point) {
  return std::any_of(
      scenario.obstacles.begin(), scenario.obstacles.end(),
      [&](const Corners& corners) { return geometry::distance_to(corners, point) == 0; });
}

/// As elements are called in messages.
inline std::string way_text(int way) { return fmt::format("way {}", way); }

/// Whether something was listed as skipped with these words.
inline bool mentions(const std::vector<imports::Skipped>& skipped, const std::string& words) {
  return std::any_of(skipped.begin(), skipped.end(), [&](const imports::Skipped& one) {
    return one.text().find(words) != std::string::npos;
  });
}

}  // namespace throng::imports_testing
