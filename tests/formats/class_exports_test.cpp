// Exports of instances and semantic classes per pixel, against the dataset's files.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <set>

#include "base/files/files.h"
#include "base/files/resources.h"
#include "base/graphics/images/raster.h"
#include "formats/dataset/class_mappings.h"
#include "formats/dataset/raster_files.h"
#include "tests/formats/dataset_fixture.h"
#include "tests/formats/readers.h"

namespace throng::formats {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using world::SemanticClass;
using world::SemanticClassInfo;
using ClassExports = SmallDataset;

TEST_F(ClassExports, PanopticListsExactlyTheSegmentsOfTheImage) {
  const fs::path out = exported("coco-panoptic");
  const json list = json::parse(read_file(out / "annotations/panoptic_train.json"));
  ASSERT_EQ(list.at("annotations").size(), 12U);
  const auto category_of = [](std::uint32_t id) {
    if (id == 0xFF0000) return 4;
    return id == 0x400004 ? 5 : 1;
  };
  std::size_t umbrellas = 0;
  for (const json& annotation : list.at("annotations")) {
    const auto ids = read_instances(
        out / "panoptic_train" / annotation.at("file_name").get<std::string>(), 160, 120);
    std::map<std::uint32_t, std::uint64_t> areas;
    for (const std::uint32_t id : ids) ++areas[id];
    areas.erase(0);
    ASSERT_EQ(annotation.at("segments_info").size(), areas.size());
    for (const json& segment : annotation.at("segments_info")) {
      EXPECT_EQ(segment.at("area"), areas.at(segment.at("id")));
      EXPECT_EQ(segment.at("category_id"), category_of(segment.at("id")));
      umbrellas += segment.at("category_id") == 5 ? 1 : 0;
    }
  }
  EXPECT_GT(umbrellas, 0U);
  EXPECT_EQ(list.at("categories").at(4).at("name"), "accessory");
}

/// Checks the members that panopticapi's converters remove from each category, and that its
/// generator of ids gets distinct colors.
void expect_categories_of_panopticapi(const fs::path& out) {
  const json list = json::parse(read_file(out / "annotations/panoptic_train.json"));
  EXPECT_EQ(list.at("categories"), json::parse(read_file(out / "panoptic_coco_categories.json")));
  std::set<json> colors = {{0, 0, 0}};
  for (const json& category : list.at("categories")) {
    EXPECT_TRUE(category.at("isthing").is_number_integer());
    const json& color = category.at("color");
    ASSERT_EQ(color.size(), 3U);
    for (const json& channel : color) {
      EXPECT_GE(channel, 0);
      EXPECT_LE(channel, 255);
    }
    EXPECT_TRUE(colors.insert(color).second) << color << " again, of " << category.at("name");
  }
}

TEST_F(ClassExports, CategoriesOfPanopticHaveColors) {
  expect_categories_of_panopticapi(exported("coco-panoptic"));
}

TEST_F(ClassExports, SemanticCategoriesOfPanopticHaveColors) {
  annotations_.emplace_back("semantic");
  write_manifest();
  expect_categories_of_panopticapi(exported("coco-panoptic"));
}

TEST_F(ClassExports, PanopticDividesTheGroundByItsClasses) {
  annotations_.emplace_back("semantic");
  write_manifest();
  const fs::path out = exported("coco-panoptic");
  const json list = json::parse(read_file(out / "annotations/panoptic_train.json"));
  std::map<std::string, int> categories;
  for (const json& category : list.at("categories")) {
    categories[category.at("name")] = category.at("id");
  }
  EXPECT_EQ(categories.size(), list.at("categories").size());
  EXPECT_EQ(categories.count("roof"), 0U) << "a part of a building";
  for (const json& annotation : list.at("annotations")) {
    const std::string file = annotation.at("file_name");
    const auto ids = read_instances(out / "panoptic_train" / file, 160, 120);
    std::map<std::uint32_t, std::uint64_t> areas;
    for (const std::uint32_t id : ids) ++areas[id];
    areas.erase(0);
    ASSERT_EQ(annotation.at("segments_info").size(), areas.size());
    for (const json& segment : annotation.at("segments_info")) {
      const std::uint32_t id = segment.at("id");
      EXPECT_EQ(segment.at("area"), areas.at(id));
      const std::string expected = id == 0xFF000D   ? "grass"
                                   : id == 0xFF000B ? "pavement"
                                   : id == 0x400004 ? "umbrella"
                                                    : "person";
      EXPECT_EQ(segment.at("category_id"), categories.at(expected)) << id;
    }
    EXPECT_EQ(areas.count(0xFF000D), 1U);
    EXPECT_EQ(areas.count(0xFF0000), 0U);
  }
}

TEST_F(ClassExports, SemanticClassesBecomeThoseOfOtherDatasets) {
  annotations_.emplace_back("semantic");
  write_manifest();
  const auto samples = [](const fs::path& path) { return images::read_raster(path).samples; };
  const fs::path cityscapes = exported("cityscapes");
  const fs::path uavid = exported("uavid");
  std::size_t images = 0;
  const json whole = coco();
  for (const json& image : whole.at("images")) {
    const fs::path file =
        fs::path(image.at("file_name").get<std::string>()).lexically_relative("images");
    const auto classes = samples((root_ / "semantic" / file).replace_extension(".png"));
    const std::string sequence =
        image.at("run").get<std::string>() + "-" + image.at("camera_id").get<std::string>();
    const std::string stem = cityscapes / "gtFine/train" / sequence /
                             (sequence + "-" + file.stem().string() + "_gtFine_");
    const auto label_ids = samples(stem + "labelIds.png");
    const auto train_ids = samples(stem + "labelTrainIds.png");
    const auto instance_ids = samples(stem + "instanceIds.png");
    ASSERT_EQ(label_ids.size(), classes.size());
    const std::map<int, std::array<int, 2>> expected = {
        {0, {23, 10}}, {4, {24, 11}}, {5, {5, 255}}, {11, {8, 1}}, {13, {22, 9}}};
    for (std::size_t i = 0; i < classes.size(); ++i) {
      ASSERT_EQ(label_ids[i], expected.at(classes[i])[0]);
      ASSERT_EQ(train_ids[i], expected.at(classes[i])[1]);
      ASSERT_EQ(classes[i] == 4 ? instance_ids[i] / 1000 : instance_ids[i], label_ids[i]);
    }
    ++images;
  }
  EXPECT_EQ(images, 12U);
  std::size_t labels = 0;
  for (const auto& entry : fs::recursive_directory_iterator(uavid / "uavid_train")) {
    if (entry.path().extension() != ".png") continue;
    ++labels;
    const auto colors = samples(entry.path());
    for (std::size_t i = 0; i < colors.size(); i += 3) {
      const std::array<int, 3> color{colors[i], colors[i + 1], colors[i + 2]};
      const bool is_known = color == std::array{0, 0, 0} || color == std::array{64, 64, 0} ||
                            color == std::array{128, 128, 0};
      ASSERT_TRUE(is_known);
    }
  }
  EXPECT_EQ(labels, 12U);
}

// As in cityscapesscripts' table of labels, and UAVid's table of colors.
TEST(ClassMappings, AreThoseOfTheOtherDatasets) {
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
    EXPECT_EQ(cityscapes_class(value).id, label) << label_name;
    EXPECT_EQ(cityscapes_class(value).name, label_name);
    EXPECT_EQ(cityscapes_class(value).train_id, train_id) << label_name;
    EXPECT_EQ(uavid_class(value).name, uavid) << label_name;
  }
}

TEST(ClassMappings, DocsListEveryClass) {
  const std::string docs = read_file(source_folder() / "docs/formats_pixels.md");
  for (const SemanticClassInfo& info : world::semantic_classes()) {
    const std::string row = fmt::format("| {} | `{}` |", static_cast<int>(info.value), info.name);
    const std::string mapped = fmt::format("| {} | {} |\n", cityscapes_class(info.value).name,
                                           uavid_class(info.value).name);
    const std::size_t at = docs.find(row);
    ASSERT_NE(at, std::string::npos) << row;
    const std::size_t end = docs.find('\n', at) + 1;
    EXPECT_TRUE(docs.substr(at, end - at).ends_with(mapped)) << row;
  }
}

}  // namespace
}  // namespace throng::formats
