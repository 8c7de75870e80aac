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

TEST(SemanticClass, EveryKindOfPropHasTheClassOfItsName) {
  for (std::size_t kind = 0; kind < kPropKinds; ++kind) {
    const SemanticClassInfo& info =
        semantic_class_info(semantic_class(static_cast<PropKind>(kind)));
    EXPECT_EQ(info.name, prop_types().at(kind).name);
    EXPECT_EQ(info.group, SemanticGroup::prop);
  }
}

}  // namespace
}  // namespace throng::world
