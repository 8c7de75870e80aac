#include "base/files/resources.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace throng {
namespace {

TEST(Resources, TheEnvironmentWinsOverTheSourceTree) {
  constexpr const char* kVariable = "THRONG_TEST_RESOURCES";
  EXPECT_EQ(resource_folder(kVariable, "nothing_of_that_name", "docs"), source_folder() / "docs");
  ::setenv(kVariable, "/chosen", 1);
  EXPECT_EQ(resource_folder(kVariable, "nothing_of_that_name", "docs"), "/chosen");
  ::setenv(kVariable, "", 1);
  EXPECT_EQ(resource_folder(kVariable, "nothing_of_that_name", "docs"), source_folder() / "docs");
  ::unsetenv(kVariable);
}

TEST(Resources, TheSourcesAreWhereTheyWere) {
  EXPECT_TRUE(
      std::filesystem::is_regular_file(source_folder() / "tests/base/files/resources_test.cpp"));
}

TEST(Resources, TheProgramKnowsItself) { EXPECT_EQ(program_path().filename(), "test_base"); }

}  // namespace
}  // namespace throng
