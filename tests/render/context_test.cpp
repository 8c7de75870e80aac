#include "render/gl/context.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "base/error.h"

namespace throng::render {
namespace {

/// Sets THRONG_DEVICE for one test.
class DeviceVariable {
 public:
  explicit DeviceVariable(const char* value) { setenv("THRONG_DEVICE", value, 1); }
  ~DeviceVariable() { unsetenv("THRONG_DEVICE"); }
  DeviceVariable(const DeviceVariable&) = delete;
  DeviceVariable& operator=(const DeviceVariable&) = delete;
};

TEST(Context, SoftwareIsMesaOnTheCpu) {
  const Context context("software");
  EXPECT_THAT(context.description(), testing::HasSubstr("llvmpipe"));
  EXPECT_THAT(context.description(), testing::HasSubstr("4.5"));
}

TEST(Context, AutoAlwaysFindsADeviceWhereSoftwareDoes) {
  EXPECT_FALSE(Context("auto").description().empty());
}

TEST(Context, ContextsLiveSideBySide) {
  const Context one("software");
  {
    const Context two("software");
    one.make_current();
    two.make_current();
  }
  EXPECT_NO_THROW(one.make_current());
}

TEST(Context, AGpuDrawsOrTheErrorNamesThePackage) {
  try {
    EXPECT_THAT(Context("gpu").description(), testing::Not(testing::HasSubstr("llvmpipe")));
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("libnvidia-gl"));
    EXPECT_THAT(error.what(), testing::HasSubstr("libegl1"));
  }
}

TEST(Context, AGpuThatIsNotThereIsNotReplacedByAnother) {
  try {
    const Context context("gpu:97");
    FAIL() << context.description();
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("gpu:97"));
  }
}

TEST(Context, AnUnknownDeviceIsAnInputError) {
  for (const char* name : {"gpu:", "gpu:x", "gpu:1x", "gpu:-1", "gpus"}) {
    EXPECT_THROW(Context{name}, InputError) << name;
  }
  EXPECT_THROW(Context("matrox"), InputError);
  EXPECT_THROW(Context(""), InputError);
}

TEST(Context, TheEnvironmentDecidesAuto) {
  {
    const DeviceVariable variable("software");
    EXPECT_THAT(Context("auto").description(), testing::HasSubstr("llvmpipe"));
  }
  const DeviceVariable variable("toaster");
  EXPECT_THROW(Context("auto"), InputError);
  EXPECT_NO_THROW(Context("software")) << "an explicit choice is not overridden";
}

}  // namespace
}  // namespace throng::render
