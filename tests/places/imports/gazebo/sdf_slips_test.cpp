// Worlds that are not quite right: decimal commas, names that are there twice, and values that
// libsdformat refuses. The messages are throng's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "tests/places/imports/gazebo/world_text.h"

namespace throng::imports {
namespace {

using imports_testing::box_model;
using imports_testing::building_at;
using imports_testing::is_listed;
using imports_testing::read_world_text;
using imports_testing::world_error;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using throng::testing::TemporaryFolder;

TEST(DecimalCommas, AreRefusedWithElementAndLine) {
  EXPECT_THAT(world_error(box_model("a", 4, 4, 3, "5,5 5,25 1.5 0 0 0")),
              AllOf(HasSubstr("w.world"), HasSubstr("line 3"),
                    HasSubstr("model a/<pose>: \"5,5 5,25 1.5 0 0 0\""),
                    HasSubstr("\"5.5 5.25 1.5 0 0 0\"")));
  for (const char* element :
       {"<gravity>0 0 -9,8</gravity>",
        "<physics type='ode'><max_step_size>0,001</max_step_size>"
        "</physics>",
        "<state world_name='w'><model name='a'><scale>1,5 1 1</scale></model></state>",
        "<road name='r'><width>7,3</width><point>0 0 0</point></road>",
        "<light name='s' type='point'><diffuse>0,5 0,5 0,5 1</diffuse></light>",
        "<light name='s' type='point'><diffuse>1,1,1,1</diffuse></light>"}) {
    EXPECT_THAT(world_error(element), AllOf(HasSubstr("line 3"), HasSubstr("decimal points")))
        << element;
  }
}

TEST(DecimalCommas, InIncludedModelsAreRefusedToo) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / "models/m/model.config",
                        "<model><name>m</name><sdf version='1.6'>model.sdf</sdf></model>");
  write_file_atomically(
      folder.path() / "models/m/model.sdf",
      "<sdf version='1.6'>\n" + box_model("m", 2, 2, 3, "0,5 0 0 0 0 0") + "</sdf>");
  write_file_atomically(folder.path() / "w.sdf",
                        "<sdf version='1.6'><world name='w'><include><uri>model://m</uri>"
                        "</include></world></sdf>");
  try {
    read_sdf(folder.path() / "w.sdf", {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("m/model.sdf"), HasSubstr("line 2")));
  }
}

TEST(DecimalCommas, InWordsAndPluginsAreNone) {
  EXPECT_EQ(world_error("<model name='1,5'><static>1</static><link name='a, b'/><plugin name='p' "
                        "filename='p.so'><list>1,2,3</list></plugin></model>"),
            "accepted");
}

TEST(Names, ThatAreThereTwiceAreTwoThings) {
  const ImportedScenario scenario = read_world_text(
      "<include><uri>model://hut</uri><pose>5 5 0 0 0 0</pose></include>"
      "<include><uri>model://hut</uri><pose>-9 5 0 0 0 0</pose></include>"
      "<include><name>hut_0</name><uri>model://hut</uri><pose>0 -9 0 0 0 0</pose></include>" +
      box_model("hut", 2, 2, 3, "0 20 0 0 0 0") + box_model("tower", 2, 2, 3, "9 20 0 0 0 0") +
      box_model("tower", 2, 2, 3, "-9 20 0 0 0 0"));
  EXPECT_EQ(scenario.buildings.size(), 6);
  for (const auto& [x, y] : {std::pair(5, 5), std::pair(-9, 5), std::pair(0, -9), std::pair(0, 20),
                             std::pair(9, 20), std::pair(-9, 20)}) {
    EXPECT_NE(building_at(scenario, {x, y}), nullptr) << x << ", " << y;
  }
  EXPECT_TRUE(scenario.skipped.empty());
}

TEST(Names, OfNestedModelsAndVisualsMayBeThereTwiceToo) {
  const ImportedScenario scenario = read_world_text(
      "<model name='m'><static>1</static><include><uri>model://hut</uri><pose>4 0 0 0 0 0</pose>"
      "</include><include><uri>model://hut</uri><pose>-4 0 0 0 0 0</pose></include><link name='l'>"
      "<visual name='v'><pose>20 0 3 0 0 0</pose><geometry><box><size>2 2 6</size></box></geometry>"
      "</visual><visual name='v'><pose>-20 0 3 0 0 0</pose><geometry><box><size>2 2 6</size></box>"
      "</geometry></visual></link></model>",
      "1.7");
  for (const double x : {4, -4, 20, -20}) EXPECT_NE(building_at(scenario, {x, 0}), nullptr) << x;
}

TEST(Messages, AreNotThoseOfLibraries) {
  const ImportedScenario scenario = read_world_text(
      box_model("a", 4, 4, 3) +
      "<model name='b'><link name='l'><visual name='v'><geometry><box>\n<size>5 x 1</size></box>"
      "</geometry></visual></link></model><model><link name='l'/></model>"
      "<include><uri>model://nowhere</uri></include>");
  EXPECT_EQ(scenario.buildings.size(), 1);
  EXPECT_TRUE(is_listed(scenario,
                        "w.world:5: model b/link l/visual v: <size> is \"5 x 1\"; "
                        "expected numbers"));
  EXPECT_TRUE(is_listed(scenario, "no file for \"model://nowhere\""));
  for (const Skipped& skipped : scenario.skipped) {
    EXPECT_THAT(skipped.text(), Not(HasSubstr("Error reading element")));
    EXPECT_THAT(skipped.text(), Not(HasSubstr("Unable to")));
  }
}

TEST(Messages, NameSizesWithUnits) {
  const ImportedScenario scenario = read_world_text(
      box_model("a", 4, 4, 3) + box_model("b", 4, 4, 3, "20m 0 0 0 0 0") +
      "<model name='c'><link name='l'><visual name='v'><geometry>\n<sphere><radius>3m</radius>"
      "</sphere></geometry></visual></link></model>");
  EXPECT_EQ(scenario.buildings.size(), 1);
  EXPECT_TRUE(scenario.objects.empty());
  EXPECT_TRUE(is_listed(scenario, "w.world:4: model b: <pose> is \"20m 0 0 0 0 0\""));
  EXPECT_TRUE(is_listed(scenario, "w.world:6: model c/link l/visual v: <radius> is \"3m\""));
}

TEST(Messages, SayWhyAMeshCannotBeRead) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& mesh) {
    write_file_atomically(folder.path() / "m.dae", mesh);
    write_file_atomically(folder.path() / "w.sdf",
                          "<sdf version='1.6'><world name='w'><model name='m'><link name='l'>"
                          "<visual name='v'><geometry><mesh><uri>m.dae</uri></mesh></geometry>"
                          "</visual></link></model></world></sdf>");
    return read_sdf(folder.path() / "w.sdf", {}).skipped.at(0).text();
  };
  EXPECT_THAT(read("version https://git-lfs.github.com/spec/v1\n"),
              HasSubstr("a pointer of Git LFS"));
  EXPECT_THAT(read(""), HasSubstr("which is empty"));
  EXPECT_THAT(read("<COLLADA>"), AllOf(HasSubstr("no mesh can be read"), Not(HasSubstr("XML"))));
}

TEST(Messages, NameTheFaultOfXml) {
  EXPECT_THAT(world_error("<model name='a'><link></model>"),
              AllOf(HasSubstr("line 3"), HasSubstr("do not match"), Not(HasSubstr("XML_ERROR"))));
  EXPECT_THAT(world_error("<model name=a/>"), Not(HasSubstr("XML_ERROR")));
  ::testing::internal::CaptureStderr();
  read_world_text(box_model("a", 4, 4, 3) + "<model name='b'><pose>one</pose></model>");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << "no parser complains by itself";
}

}  // namespace
}  // namespace throng::imports
