#include "places/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error.h"
#include "base/files.h"
#include "tests/places/yard.h"

namespace throng::places {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using throng::testing::TemporaryFolder;
using throng::testing::Yard;

class PlanOfYard : public ::testing::Test {
 protected:
  Drawing draw(std::span<const world::DronePath> paths = {}) {
    return draw_plan(world::load_scenario(yard.write(folder), "yard"), 600, paths);
  }

  TemporaryFolder folder;
  Yard yard;
};

TEST_F(PlanOfYard, SaysExitsWidthsFlowsAndDrones) {
  const std::string svg = to_svg(draw());
  EXPECT_THAT(svg, StartsWith("<svg"));
  for (const char* words :
       {">gate 3 m<", ">16 nearest here<", ">d1, 20 m up<", ">hut<", ">10 m<"}) {
    EXPECT_THAT(svg, HasSubstr(words));
  }
}

TEST_F(PlanOfYard, SaysHowManyComeWhere) {
  const std::string there = yard.generator;
  yard.generator = there + R"(</AgentGroup><AgentGroup>
    <ProfileSelector type="const" name="adult"/><StateSelector type="const" name="Walk"/>
    <Generator type="explicit"><Agent p_x="-9" p_y="-8"/><Agent p_x="-8" p_y="-8"/></Generator>
    <Arrivals type="table"><At time="5" count="7"/><At time="9" count="4"/></Arrivals>)";
  const std::string svg = to_svg(draw());
  EXPECT_THAT(svg, HasSubstr(">11 come<"));
  EXPECT_THAT(svg, HasSubstr(">16 nearest here<")) << "of those who are there";
}

TEST_F(PlanOfYard, ShowsTheWaysOfDronesInsteadOfTheScenariosStarts) {
  const std::vector<world::DronePath> paths = {{"scout", {{-5, 0, 8}, {5, 0, 8}, {5, 10, 8}}},
                                               {"guide", {{-9, -9, 12}}}};
  const Drawing drawing = draw(paths);
  const std::string svg = to_svg(drawing);
  EXPECT_THAT(svg, HasSubstr(">scout, 8 m up<"));
  EXPECT_THAT(svg, HasSubstr(">guide, 12 m up<"));
  EXPECT_THAT(svg, ::testing::Not(HasSubstr(">d1, ")));
  // 60 m are 600 px: 10 m to the right, then 10 m up.
  const auto way = std::find_if(drawing.marks.begin(), drawing.marks.end(), [](const Mark& mark) {
    return mark.kind == Mark::Kind::line && mark.arrow && mark.points.size() == 3;
  });
  ASSERT_NE(way, drawing.marks.end());
  EXPECT_LT((way->points[1] - way->points[0] - Eigen::Vector2d(100, 0)).norm(), 1e-6);
  EXPECT_LT((way->points[2] - way->points[1] - Eigen::Vector2d(0, -100)).norm(), 1e-6);
}

TEST_F(PlanOfYard, IsDrawnToScaleWithNorthUp) {
  yard.scenario["name"] = "x<y&z";
  const Drawing drawing = draw();
  // 60 m are 600 px: the hut's first corner (-8, 4) is 22 m right of and 34 m above the lower left.
  bool found = false;
  for (const Mark& mark : drawing.marks) {
    if (mark.kind != Mark::Kind::polygon || mark.points.size() != 4) continue;
    const Eigen::Vector2d size = mark.points[2] - mark.points[0];
    if (std::abs(size.x() - 40) > 1e-6 || std::abs(size.y() + 40) > 1e-6) continue;
    found = true;
  }
  EXPECT_TRUE(found) << "a square of 4 m, its third corner right of and above the first";
  EXPECT_THAT(to_svg(drawing), HasSubstr("x&lt;y&amp;z"));
}

TEST_F(PlanOfYard, IsWrittenAsTheSuffixSays) {
  const Drawing drawing = draw();
  write_plan(drawing, folder.path() / "plan.png");
  write_plan(drawing, folder.path() / "plan.svg");
  EXPECT_THAT(read_file(folder.path() / "plan.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(read_file(folder.path() / "plan.svg"), StartsWith("<svg"));
  EXPECT_THROW(write_plan(drawing, folder.path() / "plan.bmp"), InputError);
}

}  // namespace
}  // namespace throng::places
