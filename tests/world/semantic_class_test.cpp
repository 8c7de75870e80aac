#include "world/semantic_class.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string_view>

namespace throng::world {
namespace {

TEST(SemanticClass, NamesAndColorsAreDistinctAndFound) {
  std::set<std::string_view> names;
  std::set<std::array<std::uint8_t, 3>> colors;
  for (const SemanticClassInfo& info : semantic_classes()) {
    EXPECT_EQ(semantic_class_named(info.name), info.value);
    names.insert(info.name);
    colors.insert(info.color);
  }
  EXPECT_EQ(names.size(), kSemanticClasses);
  EXPECT_EQ(colors.size(), kSemanticClasses);
  EXPECT_FALSE(semantic_class_named("unicorn"));
}

TEST(SemanticClass, EveryKindOfPropHasTheClassOfItsNameIfThereIsOne) {
  for (const PropType& type : prop_types()) {
    EXPECT_EQ(semantic_class_named(type.name).value_or(type.semantic_class), type.semantic_class);
    EXPECT_EQ(semantic_class_info(type.semantic_class).group, SemanticGroup::prop) << type.name;
  }
}

}  // namespace
}  // namespace throng::world
