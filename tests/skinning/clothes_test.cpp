// Garments read from descriptions, over all people of a library.
#include "skinning/wardrobe/clothes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/skinning/baked_people.h"

namespace throng::skinning {
namespace {

std::vector<std::string> names_in(std::string_view wears) {
  std::vector<std::string> names;
  for (const Clothing& clothing : clothes_in(wears)) {
    names.push_back(std::string(to_string(clothing.slot)) + " " + std::string(clothing.type));
  }
  return names;
}

TEST(Clothes, HaveASlotAndAType) {
  EXPECT_EQ(names_in("t-shirt, jeans, trainers"),
            (std::vector<std::string>{"upper t-shirt", "lower jeans", "shoes trainers"}));
  EXPECT_EQ(names_in("dress, boots"), (std::vector<std::string>{"whole dress", "shoes boots"}));
  EXPECT_TRUE(names_in("").empty());
  EXPECT_EQ(names_in("armor, jeans"), (std::vector<std::string>{"lower jeans"}));
}

using BakedClothes = BakedPeopleTest;

TEST_F(BakedClothes, EveryWordOfADescriptionIsKnown) {
  for (const Character& character : people_->characters) {
    if (character.wears.empty()) continue;
    const auto words = 1 + std::count(character.wears.begin(), character.wears.end(), ',');
    const std::vector<std::string> names = names_in(character.wears);
    EXPECT_EQ(names.size(), static_cast<std::size_t>(words)) << character.wears;
    const auto wears = [&](std::string_view slot) {
      return std::any_of(names.begin(), names.end(),
                         [&](const std::string& name) { return name.starts_with(slot); });
    };
    EXPECT_TRUE(wears("whole") || (wears("upper") && wears("lower"))) << character.wears;
  }
}

}  // namespace
}  // namespace throng::skinning
