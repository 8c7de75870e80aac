#include "render/people/device_palettes.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/render/synthetic_people.h"

namespace throng::render {
namespace {

TEST(DevicePalettes, TooManyPeopleAreToldHowManyFit) {
  const skinning::Population people = synthetic_people(5);
  const std::uint64_t each =
      people.palettes_per_character * skinning::kBoneCount * sizeof(skinning::PackedBone);
  EXPECT_NO_THROW(device_palettes(people, 5 * each));
  try {
    device_palettes(people, 5 * each - 1);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("5 of them"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("at most 4"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace throng::render
