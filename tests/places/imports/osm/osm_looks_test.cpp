#include "places/imports/osm/osm_looks.h"

#include <gtest/gtest.h>

#include "base/geometry/angle.h"

namespace throng::imports {
namespace {

using world::Covering;
using world::Facade;
using world::RoofKind;

TEST(OsmLooks, RoofsAreReadFromTags) {
  const Tags tags = {{"building", "yes"},           {"roof:shape", "half-hipped"},
                     {"roof:material", "slate"},    {"roof:colour", "#336699"},
                     {"roof:angle", "35"},          {"roof:direction", "E"},
                     {"building:colour", "Maroon"}, {"building:material", "brick"}};
  const BuildingLooks looks = building_looks(tags, 3.5);
  EXPECT_EQ(looks.facade, Facade::brick);
  EXPECT_EQ(looks.roof.kind, RoofKind::half_hipped);
  EXPECT_EQ(looks.roof.covering, Covering::slate);
  EXPECT_EQ(looks.roof.height_m, 3.5);
  EXPECT_NEAR(looks.roof.pitch_rad.value(), 35 * kDegree, 1e-12);
  EXPECT_NEAR(looks.roof.falls_rad.value(), 0, 1e-12) << "east is +x";
  EXPECT_GT(looks.roof.paint.value()[2], looks.roof.paint.value()[0]) << "blue";
  EXPECT_GT(looks.paint.value()[0], 10 * looks.paint.value()[1] + 0.05F) << "maroon";
  EXPECT_TRUE(undrawn_looks(tags).empty());
}

TEST(OsmLooks, DirectionsAreCompassBearings) {
  const auto falls_deg = [](const char* text) {
    return building_looks({{"roof:direction", text}}, {}).roof.falls_rad.value() / kDegree;
  };
  EXPECT_NEAR(falls_deg("N"), 90, 1e-9);
  EXPECT_NEAR(falls_deg("135"), -45, 1e-9);
  EXPECT_NEAR(falls_deg("SW"), -135, 1e-9);
}

TEST(OsmLooks, ShortColorsAreReadAsCssDoes) {
  const auto paint = [](const char* text) {
    return building_looks({{"roof:colour", text}}, {}).roof.paint;
  };
  EXPECT_TRUE((paint("#a53").value() == paint("#aa5533").value()).all());
  EXPECT_TRUE((paint("light_grey").value() == paint("lightgray").value()).all());
  for (const char* odd : {"#12", "#12345g", "reddish", "#", ""}) {
    EXPECT_FALSE(paint(odd).has_value()) << odd;
  }
}

TEST(OsmLooks, ListTagsThatAreNotDrawnAsTheySay) {
  const Tags tags = {{"roof:shape", "onion"},          {"roof:material", "thatch"},
                     {"roof:colour", "reddish"},       {"roof:angle", "steep"},
                     {"roof:orientation", "across"},   {"building:material", "wood"},
                     {"roof:direction", "downstairs"}, {"building:colour", "#ff"}};
  EXPECT_EQ(undrawn_looks(tags).size(), tags.size());
  EXPECT_EQ(building_looks(tags, {}).roof.kind, RoofKind::dome) << "what looks most alike";
  EXPECT_EQ(building_looks(tags, {}).roof.covering, Covering::by_id);
}

TEST(OsmLooks, PartsInheritWhatTheyLack) {
  Tags part = {{"roof:shape", "flat"}};
  inherit_looks({{"roof:shape", "gabled"}, {"building:colour", "white"}, {"height", "9"}}, part);
  EXPECT_EQ(part, (Tags{{"roof:shape", "flat"}, {"building:colour", "white"}}));
}

}  // namespace
}  // namespace throng::imports
