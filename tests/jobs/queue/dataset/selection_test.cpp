#include "jobs/queue/dataset/selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"

namespace throng::jobs {
namespace {

using testing::ElementsAre;

TEST(Selection, NothingSaidIsEverything) {
  EXPECT_TRUE(Selection{}.holds("images/run000/d1/000001.jpg"));
  EXPECT_TRUE(Selection{}.holds("README.md"));
}

TEST(Selection, IncludesFoldersFilesFormatsAndCoco) {
  const Selection chosen{{"images", "coco", "mot", "metrics.json"}};
  EXPECT_TRUE(chosen.holds("images/run000/d1/000001.jpg"));
  EXPECT_TRUE(chosen.holds("annotations/instances.json"));
  EXPECT_TRUE(chosen.holds("formats/mot/train/run000-d1/gt/gt.txt"));
  EXPECT_TRUE(chosen.holds("metrics.json"));
  EXPECT_FALSE(chosen.holds("formats/mots/train/a.txt"));
  EXPECT_FALSE(chosen.holds("imagesets/a.jpg"));
  EXPECT_FALSE(chosen.holds("metrics/run000.json"));
}

TEST(Selection, RunsHaveTheirFilesAndShareTheOthers) {
  const Selection chosen{{}, {0, 12}};
  EXPECT_TRUE(chosen.holds("images/run000/d1/000001.jpg"));
  EXPECT_TRUE(chosen.holds("metrics/run012.json"));
  EXPECT_TRUE(chosen.holds("annotations/instances.json"));
  EXPECT_TRUE(chosen.holds("formats/mot/train/run000-d1/gt/gt.txt"));
  EXPECT_FALSE(chosen.holds("images/run001/d1/000001.jpg"));
  EXPECT_FALSE(chosen.holds("formats/yolo-detect/labels/train/run001_d1_000003.txt"));
  EXPECT_TRUE(chosen.holds("running/a.txt"));
}

TEST(Selection, ListsOfRunsAreRead) {
  EXPECT_THAT(parse_runs("0-3,7", 8, "?runs"), ElementsAre(0, 1, 2, 3, 7));
  EXPECT_THAT(parse_runs("2,1,1-2", 3, "?runs"), ElementsAre(1, 2));
  for (const char* wrong : {"", "8", "-1", "1-", "3-1", "1,,2", "a", "1;2", "99999999999"}) {
    EXPECT_THROW(parse_runs(wrong, 8, "?runs"), InputError) << wrong;
  }
}

}  // namespace
}  // namespace throng::jobs
