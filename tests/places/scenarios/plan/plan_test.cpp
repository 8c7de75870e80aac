#include "places/scenarios/plan/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/places/scenarios/yard.h"
#include "world/fields/read_scenario.h"

namespace throng::scenarios {
namespace {

using drawing::Drawing;
using drawing::Shape;
using ::testing::Contains;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::StartsWith;
using throng::testing::TemporaryFolder;
using throng::testing::Yard;

std::vector<std::string> labels(const Drawing& drawing) {
  std::vector<std::string> texts;
  for (const Shape& shape : drawing.shapes) {
    if (shape.kind == Shape::Kind::text) texts.push_back(shape.text);
  }
  return texts;
}

class PlanOfYard : public ::testing::Test {
 protected:
  Drawing draw(std::span<const world::DronePath> paths = {}) {
    return draw_plan(world::load_scenario(yard.write(folder), "yard"), 600, paths);
  }

  TemporaryFolder folder;
  Yard yard;
};

TEST_F(PlanOfYard, SaysExitsWidthsFlowsAndDrones) {
  EXPECT_THAT(labels(draw()),
              IsSupersetOf({"gate 3 m", "nearest exit for 16", "d1, 20 m up", "hut", "10 m"}));
}

TEST_F(PlanOfYard, HasRoomForTheWholeLegend) {
  const world::Scenario scenario = world::load_scenario(yard.write(folder), "yard");
  for (const int size_px : {200, 600, 800, 1000, 3000}) {
    const Drawing drawing = draw_plan(scenario, size_px);
    EXPECT_THAT(labels(drawing), IsSupersetOf({"building", "hazard"}));
    for (const Shape& shape : drawing.shapes) {
      for (const auto& point : shape.points) {
        EXPECT_LE(point.y(), drawing.height_px) << size_px << " " << shape.text;
      }
    }
  }
}

TEST_F(PlanOfYard, SaysHowManyComeWhere) {
  const std::string there = yard.generator;
  yard.generator = there + R"(</AgentGroup><AgentGroup>
    <ProfileSelector type="const" name="adult"/><StateSelector type="const" name="Walk"/>
    <Generator type="explicit"><Agent p_x="-9" p_y="-8"/><Agent p_x="-8" p_y="-8"/></Generator>
    <Arrivals type="table"><At time="5" count="7"/><At time="9" count="4"/></Arrivals>)";
  EXPECT_THAT(labels(draw()), Contains("11 enter"));
  EXPECT_THAT(labels(draw()), Contains("nearest exit for 16")) << "of the people present";
}

TEST_F(PlanOfYard, ShowsTheWaysOfDronesInsteadOfTheScenariosStarts) {
  const std::vector<world::DronePath> paths = {{"scout", {{-5, 0, 8}, {5, 0, 8}, {5, 10, 8}}},
                                               {"guide", {{-9, -9, 12}}}};
  const Drawing drawing = draw(paths);
  EXPECT_THAT(labels(drawing), IsSupersetOf({"scout, 8 m up", "guide, 12 m up"}));
  EXPECT_THAT(labels(drawing), Not(Contains(StartsWith("d1, "))));
  // 60 m are 600 px: 10 m to the right, then 10 m up.
  const auto way =
      std::find_if(drawing.shapes.begin(), drawing.shapes.end(), [](const Shape& shape) {
        return shape.kind == Shape::Kind::line && shape.arrow && shape.points.size() == 3;
      });
  ASSERT_NE(way, drawing.shapes.end());
  EXPECT_LT((way->points[1] - way->points[0] - Eigen::Vector2d(100, 0)).norm(), 1e-6);
  EXPECT_LT((way->points[2] - way->points[1] - Eigen::Vector2d(0, -100)).norm(), 1e-6);
}

TEST_F(PlanOfYard, IsDrawnToScaleWithNorthUp) {
  yard.scenario["name"] = "x<y&z";
  const Drawing drawing = draw();
  // 60 m are 600 px: the hut's first corner (-8, 4) is 22 m right of and 34 m above the lower left.
  bool found = false;
  for (const Shape& shape : drawing.shapes) {
    if (shape.kind != Shape::Kind::polygon || shape.points.size() != 4) continue;
    const Eigen::Vector2d size = shape.points[2] - shape.points[0];
    if (std::abs(size.x() - 40) > 1e-6 || std::abs(size.y() + 40) > 1e-6) continue;
    found = true;
  }
  EXPECT_TRUE(found) << "a square of 4 m, its third corner right of and above the first";
  EXPECT_THAT(labels(drawing), Contains("x<y&z"));
}

}  // namespace
}  // namespace throng::scenarios
