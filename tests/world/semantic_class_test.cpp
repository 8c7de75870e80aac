#include "world/semantic_class.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

#include "base/files.h"

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
    const SemanticClassInfo& info = info_of(class_of(static_cast<PropKind>(kind)));
    EXPECT_EQ(info.name, prop_types().at(kind).name);
    EXPECT_EQ(info.group, SemanticGroup::prop);
  }
}

// As in cityscapesscripts' table of labels, and UAVid's table of colors.
TEST(SemanticClass, MapsToOtherDatasets) {
  const struct {
    SemanticClass value;
    int label;
    std::string_view label_name;
    int train_id;
    std::string_view uavid;
  } expected[] = {
      {SemanticClass::road, 7, "road", 0, "road"},
      {SemanticClass::pavement, 8, "sidewalk", 1, "background clutter"},
      {SemanticClass::building, 11, "building", 2, "building"},
      {SemanticClass::roof, 11, "building", 2, "building"},
      {SemanticClass::wall, 12, "wall", 3, "building"},
      {SemanticClass::fence, 13, "fence", 4, "background clutter"},
      {SemanticClass::lamp_post, 17, "pole", 5, "background clutter"},
      {SemanticClass::tree, 21, "vegetation", 8, "tree"},
      {SemanticClass::grass, 22, "terrain", 9, "low vegetation"},
      {SemanticClass::sky, 23, "sky", 10, "background clutter"},
      {SemanticClass::person, 24, "person", 11, "human"},
      {SemanticClass::car, 26, "car", 13, "static car"},
      {SemanticClass::train, 31, "train", 16, "background clutter"},
      {SemanticClass::bench, 4, "static", 255, "background clutter"},
  };
  for (const auto& [value, label, label_name, train_id, uavid] : expected) {
    const SemanticClassInfo& info = info_of(value);
    EXPECT_EQ(info.cityscapes, label) << info.name;
    EXPECT_EQ(cityscapes_class(info.cityscapes).name, label_name);
    EXPECT_EQ(cityscapes_class(info.cityscapes).train_id, train_id) << info.name;
    EXPECT_EQ(uavid_classes()[info.uavid].name, uavid) << info.name;
  }
  for (const SemanticClassInfo& info : semantic_classes()) {
    EXPECT_EQ(cityscapes_class(info.cityscapes).id, info.cityscapes);
    EXPECT_LT(info.uavid, uavid_classes().size());
  }
}

TEST(SemanticClass, DocsListEveryClass) {
  const std::string docs =
      read_file(std::filesystem::path(THRONG_SOURCE_DIR) / "docs/formats_pixels.md");
  for (const SemanticClassInfo& info : semantic_classes()) {
    const std::string row = fmt::format("| {} | `{}` |", static_cast<int>(info.value), info.name);
    const std::string mapped = fmt::format("| {} | {} |\n", cityscapes_class(info.cityscapes).name,
                                           uavid_classes()[info.uavid].name);
    const std::size_t at = docs.find(row);
    ASSERT_NE(at, std::string::npos) << row;
    const std::size_t end = docs.find('\n', at) + 1;
    EXPECT_TRUE(docs.substr(at, end - at).ends_with(mapped)) << row;
  }
}

}  // namespace
}  // namespace throng::world
