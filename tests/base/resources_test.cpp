#include "base/resources.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace throng {
namespace {

TEST(Resources, TheEnvironmentWinsOverTheSourceTree) {
  constexpr const char* kVariable = "THRONG_TEST_RESOURCES";
  EXPECT_EQ(resource_folder(kVariable, "nothing_of_that_name", "/source"), "/source");
  ::setenv(kVariable, "/chosen", 1);
  EXPECT_EQ(resource_folder(kVariable, "nothing_of_that_name", "/source"), "/chosen");
  ::setenv(kVariable, "", 1);
  EXPECT_EQ(resource_folder(kVariable, "nothing_of_that_name", "/source"), "/source");
  ::unsetenv(kVariable);
}

TEST(Resources, TheProgramKnowsItself) { EXPECT_EQ(program_path().filename(), "test_base"); }

}  // namespace
}  // namespace throng
