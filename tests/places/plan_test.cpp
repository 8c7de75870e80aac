#include "places/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  Drawing draw() { return draw_plan(world::load_scenario(yard.write(folder), "yard"), 600); }

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
