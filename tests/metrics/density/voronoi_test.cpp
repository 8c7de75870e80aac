#include "metrics/density/voronoi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <numbers>

#include "base/compute/random.h"
#include "base/geometry/point_grid.h"
#include "base/geometry/polygon.h"
#include "tests/metrics/walks.h"

namespace throng::metrics {
namespace {

using Eigen::Vector2d;

constexpr double kDiscM2 = std::numbers::pi * kCellRadiusM * kCellRadiusM;

VoronoiCell make_cell(const std::vector<Vector2d>& people, std::size_t index,
                      const std::vector<world::Building>& buildings = {}) {
  return VoronoiCutter(buildings).cell(geometry::PointGrid(people, 0.8), index);
}

TEST(Voronoi, ALonePersonHasTheWholeDisc) {
  EXPECT_NEAR(make_cell({{3, 4}}, 0).area_m2, kDiscM2, 1e-9);
}

TEST(Voronoi, InALatticeEverybodyHasOneMesh) {
  std::vector<Vector2d> people;
  for (int row = 0; row < 9; ++row) {
    for (int column = 0; column < 9; ++column) people.emplace_back(0.5 * column, 0.8 * row);
  }
  const VoronoiCell cell = make_cell(people, 40);
  EXPECT_NEAR(cell.area_m2, 0.4, 1e-9);
  EXPECT_NEAR(cell.density_per_m2(), 2.5, 1e-9);
}

// Two lanes in a corridor that is 2 m wide, people 1 m apart: half of the corridor's meter each.
TEST(Voronoi, TwoLanesInACorridorShareIt) {
  std::vector<Vector2d> people;
  for (int i = 0; i < 11; ++i) {
    people.emplace_back(i, 0.5);
    people.emplace_back(i, 1.5);
  }
  const std::vector<world::Building> walls = {box({-20, -3}, {30, 0}), box({-20, 2}, {30, 5})};
  const VoronoiCell cell = make_cell(people, 10, walls);
  EXPECT_NEAR(cell.area_m2, 1, 1e-9);
  EXPECT_NEAR(area_in(cell, std::vector<Vector2d>{{5, 0}, {9, 0}, {9, 0.5}, {5, 0.5}}), 0.25, 1e-9);
}

TEST(Voronoi, GroundBehindAThinWallBelongsToNobodyHere) {
  const VoronoiCell cell = make_cell({{-1, 0}}, 0, {box({0, -9}, {0.1, 9})});
  // The part of the disc on this side of x = 0: a segment of half angle 120 degrees.
  const double angle = 2 * std::numbers::pi / 3;
  const double segment = kCellRadiusM * kCellRadiusM * (angle - std::sin(angle) * std::cos(angle));
  EXPECT_NEAR(cell.area_m2, segment, 0.02);
}

TEST(Voronoi, APillarIsAHole) {
  const VoronoiCell cell = make_cell({{0, 0}}, 0, {box({0.5, -0.25}, {1, 0.25})});
  EXPECT_EQ(cell.rings.size(), 2U);
  EXPECT_NEAR(cell.area_m2, kDiscM2 - 0.25, 1e-9);
  const std::vector<Vector2d> right = {{0, -3}, {3, -3}, {3, 3}, {0, 3}};
  EXPECT_NEAR(area_in(cell, right), 0.5 * kDiscM2 - 0.25, 1e-9);
}

TEST(Voronoi, PeopleAtOnePlaceShareACell) {
  const std::vector<Vector2d> people = {{0, 0}, {0, 0}, {30, 30}};
  EXPECT_NEAR(make_cell(people, 0).density_per_m2(), 2 / kDiscM2, 1e-9);
}

// Against an implementation by others, for cells that no cut-off reaches.
TEST(Voronoi, AgreesWithBoostPolygon) {
  constexpr int kPerM = 1000000;
  std::vector<Vector2d> people;
  std::vector<boost::polygon::point_data<int>> points;
  Random random(7, Stream::wind);
  for (int i = 0; i < 400; ++i) {
    const int x = static_cast<int>(random.uniform() * 10 * kPerM);
    const int y = static_cast<int>(random.uniform() * 10 * kPerM);
    points.emplace_back(x, y);
    people.emplace_back(static_cast<double>(x) / kPerM, static_cast<double>(y) / kPerM);
  }
  boost::polygon::voronoi_diagram<double> diagram;
  boost::polygon::construct_voronoi(points.begin(), points.end(), &diagram);
  const geometry::PointGrid grid(people, 0.8);
  const VoronoiCutter cutter({});
  int compared = 0;
  for (const auto& boost_cell : diagram.cells()) {
    const std::size_t index = boost_cell.source_index();
    const auto middle = (people[index].array() - 5).abs();
    if ((middle > 3).any()) continue;
    Ring ring;
    const auto* edge = boost_cell.incident_edge();
    do {
      ring.emplace_back(edge->vertex0()->x() / kPerM, edge->vertex0()->y() / kPerM);
      edge = edge->next();
    } while (edge != boost_cell.incident_edge());
    EXPECT_NEAR(cutter.cell(grid, index).area_m2, geometry::signed_area(ring), 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace throng::metrics
