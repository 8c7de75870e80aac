// Sizes and surfaces by tags: values of wiki.openstreetmap.org and the table of docs.
#include "places/imports/osm/osm_tags.h"

#include <gtest/gtest.h>

#include "places/imports/osm/osm_buildings.h"

namespace throng::imports {
namespace {

TEST(StreetKinds, HaveWidthsByKindLanesAndTag) {
  const auto width = [](const Tags& tags) { return way_kind(tags).value().width_m; };
  EXPECT_EQ(width({{"highway", "residential"}}), 6);
  EXPECT_EQ(width({{"highway", "residential"}, {"lanes", "4"}}), 12) << "3 m per lane";
  EXPECT_EQ(width({{"highway", "residential"}, {"lanes", "0"}}), 3) << "one lane at least";
  EXPECT_EQ(width({{"highway", "residential"}, {"lanes", "30"}}), 40);
  EXPECT_EQ(width({{"highway", "footway"}, {"lanes", "4"}}), 2.5) << "no lanes on a footway";
  EXPECT_EQ(width({{"highway", "residential"}, {"lanes", "2"}, {"width", "9.5"}}), 9.5);
  EXPECT_EQ(width({{"highway", "path"}, {"width", "0.3"}}), 1);
  EXPECT_EQ(width({{"highway", "path"}, {"width", "80"}}), 40);
  EXPECT_EQ(width({{"highway", "path"}, {"width", "wide"}}), 1.8);
}

TEST(StreetKinds, AreForCarsOrForPeople) {
  for (const char* name : {"primary", "secondary", "tertiary", "residential", "service"}) {
    EXPECT_TRUE(way_kind({{"highway", name}}).value().road) << name;
    EXPECT_EQ(way_kind({{"highway", name}}).value().material, "asphalt");
  }
  for (const char* name : {"footway", "path", "steps", "pedestrian", "living_street"}) {
    EXPECT_FALSE(way_kind({{"highway", name}}).value().road) << name;
  }
  for (const char* name : {"motorway", "construction", "proposed", "", "Footway"}) {
    EXPECT_FALSE(way_kind({{"highway", name}})) << name;
  }
  EXPECT_FALSE(way_kind({}));
  EXPECT_TRUE(way_kind({{"highway", "residential"}, {"lanes", "2"}}).value().center_line);
  EXPECT_FALSE(way_kind({{"highway", "primary"}, {"lanes", "1"}}).value().center_line);
}

TEST(BuildingHeights, PreferHeightThenLevelsThenKind) {
  EXPECT_EQ(building_height_m({{"building", "house"}, {"height", "9"}, {"building:levels", "7"}}),
            9);
  EXPECT_EQ(building_height_m({{"building", "house"}, {"building:levels", "7"}}), 21);
  EXPECT_EQ(building_height_m({{"building", "house"}, {"height", "0"}}), 6);
  EXPECT_EQ(building_height_m({{"building", "house"}, {"height", "tall"}}), 6);
  EXPECT_EQ(building_height_m({{"building", "house"}, {"building:levels", "0"}}), 6);
  for (const char* kind : {"garage", "shed", "kiosk", "roof", "carport"}) {
    EXPECT_EQ(building_height_m({{"building", kind}}), 3) << kind;
  }
  EXPECT_EQ(building_height_m({{"building", "yes"}}), 9);
  EXPECT_EQ(building_height_m({{"building", "yes"}, {"height", "0.5"}}), 2) << "2 m at least";
  EXPECT_EQ(building_height_m({{"building", "yes"}, {"height", "950"}}), 900);
  EXPECT_EQ(
      building_height_m({{"building:levels", "2"}, {"roof:height", "1.5"}, {"roof:levels", "4"}}),
      7.5)
      << "the roof's height before its levels";
}

TEST(BuildingHeights, AreReadInEverySpelling) {
  for (const auto& [height, meters] :
       {std::pair("12 meters", 12.0), std::pair("~12", 12.0), std::pair("12,5", 12.5),
        std::pair("40 ft", 12.192), std::pair("22' 3\"", 6.7818)}) {
    EXPECT_NEAR(building_height_m({{"building", "yes"}, {"height", height}}), meters, 1e-9);
  }
  EXPECT_EQ(building_height_m({{"building", "yes"}, {"building:levels", "2;3"}}), 9);
  EXPECT_EQ(building_height_m({{"building", "yes"}, {"building:levels", "2,5"}}), 7.5);
  EXPECT_EQ(building_height_m({{"building", "yes"}, {"building:height", "14"}}), 14);
  EXPECT_EQ(building_height_m({{"building", "yes"}, {"est_height", "14"}}), 14);
  EXPECT_EQ(building_height_m({{"building", "yes"}, {"levels", "5"}}), 15);
  EXPECT_EQ(
      building_height_m({{"building", "yes"}, {"building:levels", "0"}, {"roof:levels", "1"}}), 3)
      << "a house that is all roof";
  EXPECT_NEAR(building_base_m({{"building:part", "yes"}, {"min_height", "10'"}}), 3.048, 1e-9);
}

TEST(BuildingHeights, ThatCannotBeReadAreNamed) {
  using Names = std::vector<std::string>;
  const auto unread = [](const char* key, const char* value) {
    return unread_building_sizes({{"building", "yes"}, {key, value}});
  };
  EXPECT_EQ(unread("height", "tall"), Names{"height=tall"});
  EXPECT_EQ(unread("height", "1200"), Names{"height=1200"}) << "centimeters?";
  EXPECT_EQ(unread("building:levels", "500"), Names{"building:levels=500"});
  EXPECT_EQ(unread("height", "828"), Names{});
  EXPECT_EQ(unread("height", "0"), Names{"height=0"});
  EXPECT_EQ(unread("building:levels", "three"), Names{"building:levels=three"});
  EXPECT_EQ(unread("building:levels", "0"), Names{"building:levels=0"});
  EXPECT_EQ(unread("min_height", "low"), Names{"min_height=low"});
  EXPECT_EQ(unread("roof:height", "steep"), Names{"roof:height=steep"});
  EXPECT_EQ(unread("min_height", "0"), Names{});
  EXPECT_EQ(unread("building:min_level", "-1"), Names{}) << "begins below the ground";
  EXPECT_EQ(unread("height", "12 m"), Names{});
}

TEST(BuildingBases, AreHeightsOrLevels) {
  EXPECT_EQ(building_base_m({}), 0);
  EXPECT_EQ(building_base_m({{"min_height", "4.5"}, {"building:min_level", "3"}}), 4.5);
  EXPECT_EQ(building_base_m({{"building:min_level", "3"}}), 9);
  EXPECT_EQ(building_base_m({{"min_height", "low"}}), 0);
}

TEST(Water, HasManyTags) {
  for (const auto& [key, value] :
       {std::pair("natural", "water"), std::pair("water", "pond"),
        std::pair("waterway", "riverbank"), std::pair("waterway", "dock"),
        std::pair("landuse", "basin"), std::pair("landuse", "reservoir"),
        std::pair("leisure", "swimming_pool")}) {
    EXPECT_TRUE(is_water({{key, value}})) << key << "=" << value;
  }
  EXPECT_FALSE(is_water({{"natural", "wood"}}));
  EXPECT_FALSE(is_water({{"waterway", "stream"}}));
}

TEST(Underground, IsSaidInThreeTags) {
  EXPECT_TRUE(is_underground({{"location", "underground"}}));
  EXPECT_TRUE(is_underground({{"parking", "underground"}}));
  EXPECT_TRUE(is_underground({{"tunnel", "yes"}}));
  EXPECT_FALSE(is_underground({{"tunnel", "no"}, {"location", "roof"}}));
}

TEST(Surfaces, AreGrassDirtAndPaving) {
  const auto surface = [](const char* key, const char* value) {
    return surface_material({{key, value}});
  };
  EXPECT_EQ(surface("leisure", "park"), "grass");
  EXPECT_EQ(surface("landuse", "farmland"), "dirt");
  EXPECT_EQ(surface("natural", "sand"), "dirt");
  EXPECT_EQ(surface("amenity", "parking"), "asphalt");
  EXPECT_EQ(surface("amenity", "fountain"), "concrete");
  EXPECT_EQ(surface("highway", "pedestrian"), "pavers");
  EXPECT_EQ(surface("landuse", "residential"), "");
  EXPECT_EQ(surface("amenity", "school"), "");
}

TEST(Barriers, HaveTheirHeights) {
  EXPECT_EQ(find_barrier({{"barrier", "wall"}}).value().height_m, 2);
  EXPECT_EQ(find_barrier({{"barrier", "hedge"}}).value().width_m, 0.8);
  EXPECT_EQ(find_barrier({{"barrier", "fence"}, {"height", "3"}}).value().height_m, 3);
  EXPECT_EQ(find_barrier({{"barrier", "fence"}, {"height", "0.05"}}).value().height_m, 1.2);
  EXPECT_EQ(find_barrier({{"barrier", "wall"}, {"height", "200"}}).value().height_m, 50);
  for (const char* open : {"kerb", "bollard", "gate", "yes", ""}) {
    EXPECT_FALSE(find_barrier({{"barrier", open}})) << open;
  }
}

TEST(BuildingTags, KnowTheWordNo) {
  EXPECT_TRUE(is_building({{"building", "yes"}}));
  EXPECT_FALSE(is_building({{"building", "no"}}));
  EXPECT_FALSE(is_building({{"building:part", "yes"}}));
  EXPECT_TRUE(is_building_part({{"building:part", "roof"}}));
  EXPECT_FALSE(is_building_part({{"building:part", "no"}}));
}

}  // namespace
}  // namespace throng::imports
