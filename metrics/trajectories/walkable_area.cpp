#include "metrics/trajectories/walkable_area.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/geometry/algorithms/append.hpp>
#include <boost/geometry/algorithms/area.hpp>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/difference.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>

namespace throng::metrics {

namespace {

namespace bg = boost::geometry;

using AreaPoint = bg::model::d2::point_xy<double>;
using AreaPolygon = bg::model::polygon<AreaPoint, false>;
using AreaPolygons = bg::model::multi_polygon<AreaPolygon>;

AreaPolygon to_area(const std::vector<Eigen::Vector2d>& corners) {
  AreaPolygon polygon;
  for (const Eigen::Vector2d& corner : corners) {
    bg::append(polygon.outer(), AreaPoint(corner.x(), corner.y()));
  }
  bg::correct(polygon);
  return polygon;
}

/// The box around everybody's positions, with a margin.
world::Rectangle box_of_people(const world::Trace& trace) {
  constexpr double kMarginM = 1;
  world::Rectangle box{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  bool is_first = true;
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
      if (trace.header.role[agent] != world::AgentRole::person || !trace.present(step, agent)) {
        continue;
      }
      const Eigen::Vector2d place = trace.position[trace.at(step, agent)].cast<double>();
      box.min = is_first ? place : box.min.cwiseMin(place).eval();
      box.max = is_first ? place : box.max.cwiseMax(place).eval();
      is_first = false;
    }
  }
  box.min.array() -= kMarginM;
  box.max.array() += kMarginM;
  return box;
}

std::string ring_text(const AreaPolygon::ring_type& ring) {
  std::string text;
  for (const AreaPoint& point : ring) {
    text += fmt::format("{}{:.12g} {:.12g}", text.empty() ? "" : ", ", point.x(), point.y());
  }
  return "(" + text + ")";
}

}  // namespace

std::string walkable_area_wkt(const world::Trace& trace, const world::Scenario* scenario) {
  world::Rectangle box = box_of_people(trace);
  if (scenario != nullptr) {
    box.min = box.min.cwiseMin(scenario->ground.min).eval();
    box.max = box.max.cwiseMax(scenario->ground.max).eval();
  }
  AreaPolygons area{
      to_area({box.min, {box.max.x(), box.min.y()}, box.max, {box.min.x(), box.max.y()}})};
  if (scenario != nullptr) {
    for (const world::Building& building : scenario->buildings) {
      AreaPolygons rest;
      bg::difference(area, to_area(building.footprint), rest);
      area = std::move(rest);
    }
  }
  const auto largest = std::max_element(
      area.begin(), area.end(),
      [](const AreaPolygon& a, const AreaPolygon& b) { return bg::area(a) < bg::area(b); });
  if (largest == area.end()) return "";
  std::string text = "POLYGON (" + ring_text(largest->outer());
  for (const AreaPolygon::ring_type& hole : largest->inners()) text += ", " + ring_text(hole);
  return text + ")";
}

}  // namespace throng::metrics
