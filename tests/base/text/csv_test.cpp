#include "base/text/csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace throng {
namespace {

using ::testing::ElementsAre;

TEST(CsvCells, AreSeparatedByCommas) {
  EXPECT_THAT(csv_cells("a,b,,d"), ElementsAre("a", "b", "", "d"));
  EXPECT_THAT(csv_cells("a;b", ';'), ElementsAre("a", "b"));
  EXPECT_THAT(csv_cells(""), ElementsAre(""));
  EXPECT_THAT(csv_cells("a,b\r"), ElementsAre("a", "b"));
}

TEST(CsvCells, MayBeQuoted) {
  EXPECT_THAT(csv_cells(R"("a,b",c)"), ElementsAre("a,b", "c"));
  EXPECT_THAT(csv_cells(R"("say ""hi""",2)"), ElementsAre(R"(say "hi")", "2"));
}

}  // namespace
}  // namespace throng
