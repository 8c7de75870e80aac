#include "annotate/people_sheet/people_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "base/error.h"
#include "tests/render/synthetic_people.h"

namespace throng::annotate {
namespace {

class PeopleSheetTest : public testing::Test {
 protected:
  PeopleSheetTest() {
    options.portraits = {0, 2};
    options.crowd = {0, 1, 2};
    options.width_px = 800;
    options.device = {"software"};
  }

  skinning::Population people = render::synthetic_people(3);
  SheetOptions options;
};

int brightness(const Sheet& sheet, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(sheet.width) +
                              static_cast<std::size_t>(x));
  return sheet.rgb[at] + sheet.rgb[at + 1] + sheet.rgb[at + 2];
}

TEST_F(PeopleSheetTest, ShowsSomebodyInEveryImage) {
  const Sheet sheet = draw_people_sheet(people, options);
  EXPECT_EQ(sheet.width, 800);
  ASSERT_EQ(sheet.rgb.size(), 3U * 800U * static_cast<std::size_t>(sheet.height));
  // 2 x 2 portraits, 3 drones, 6 x 8 moments, 15 poses, 2 x 2 levels.
  EXPECT_EQ(sheet.cells.size(), 4U + 3U + 48U + 15U + 4U);
  for (const SheetCell& cell : sheet.cells) {
    EXPECT_GE(cell.x, 0);
    EXPECT_LE(cell.x + cell.width, sheet.width);
    EXPECT_LE(cell.y + cell.height, sheet.height);
    const auto area = static_cast<std::uint64_t>(cell.width) * cell.height;
    EXPECT_GT(cell.person_px, area / 200) << cell.label;
    EXPECT_LT(cell.person_px, area / 2) << cell.label;
    std::set<int> shades;
    for (int y = cell.y; y < cell.y + cell.height; ++y) {
      for (int x = cell.x; x < cell.x + cell.width; ++x) shades.insert(brightness(sheet, x, y));
    }
    EXPECT_GT(shades.size(), 20U) << cell.label << ": nothing but one colour";
  }
}

TEST_F(PeopleSheetTest, ImagesDoNotOverlap) {
  const Sheet sheet = draw_people_sheet(people, options);
  for (std::size_t i = 0; i < sheet.cells.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const SheetCell& a = sheet.cells[i];
      const SheetCell& b = sheet.cells[j];
      const bool apart = a.x >= b.x + b.width || b.x >= a.x + a.width || a.y >= b.y + b.height ||
                         b.y >= a.y + a.height;
      EXPECT_TRUE(apart) << a.label << " and " << b.label;
    }
  }
}

TEST_F(PeopleSheetTest, IsTheSameForTheSameSeedOnly) {
  const Sheet first = draw_people_sheet(people, options);
  EXPECT_EQ(draw_people_sheet(people, options).rgb, first.rgb);
  options.seed = 2;
  EXPECT_NE(draw_people_sheet(people, options).rgb, first.rgb);
}

TEST_F(PeopleSheetTest, ShowsDronesViewsFromThreeHeights) {
  const Sheet sheet = draw_people_sheet(people, options);
  for (const char* label : {"15 m high", "30 m high", "50 m high"}) {
    EXPECT_EQ(std::count_if(sheet.cells.begin(), sheet.cells.end(),
                            [&](const SheetCell& cell) { return cell.label == label; }),
              1)
        << label;
  }
}

TEST_F(PeopleSheetTest, ReportsProgressAndStopsWhenAsked) {
  double last = -1;
  int reports = 0;
  EXPECT_THROW(draw_people_sheet(people, options,
                                 [&](double share, std::string_view) {
                                   EXPECT_GT(share, last);
                                   EXPECT_LT(share, 1);
                                   last = share;
                                   if (++reports == 5) throw Cancelled();
                                 }),
               Cancelled);
  EXPECT_EQ(reports, 5);
}

}  // namespace
}  // namespace throng::annotate
