// Robots of SDF and URDF: masses, rotors, cameras and noise, and what is refused with its line.
#include "places/imports/robots/robot_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "tests/places/imports/robots/folder.h"
#include "tests/world/temporary_folder.h"

namespace throng::imports {
namespace {

using throng::testing::TemporaryFolder;

Robot racer_with_camera() {
  return read_robot(robots_folder() / "racer_with_camera/model.sdf", {robots_folder()});
}

bool is_skipped(const Robot& robot, const std::string& words) {
  return std::any_of(robot.skipped.begin(), robot.skipped.end(), [&](const Skipped& skipped) {
    return skipped.text().find(words) != std::string::npos;
  });
}

/// The problems of a robot with this text, one in each line.
std::string find_refusal(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  write_file_atomically(folder.path() / name, text);
  try {
    read_robot(folder.path() / name, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(RobotReader, MassesAndInertiasOfAllMergedLinksAreSummedAboutTheirCenter) {
  const Robot robot = racer_with_camera();
  // A body of 1 kg at (0, 0, 0), four propellers of 0.01 kg at (±0.15, ±0.1, 0.05), a camera of
  // 0.06 kg at (0.1, 0, -0.02), all 0.3 m up, as the pose of the model that is merged says.
  EXPECT_NEAR(robot.mass_kg, 1.1, 1e-9);
  EXPECT_NEAR(robot.center.x(), 0.06 * 0.1 / 1.1, 1e-9);
  EXPECT_NEAR(robot.center.y(), 0, 1e-9);
  EXPECT_NEAR(robot.center.z(), 0.3 + (0.04 * 0.05 - 0.06 * 0.02) / 1.1, 1e-9);
  // Links without <inertia> are points; SDF's default would be 1 kg m².
  const double x2 = 0.04 * 0.15 * 0.15 + 0.06 * 0.1 * 0.1 - 1.1 * std::pow(robot.center.x(), 2);
  const double y2 = 0.04 * 0.1 * 0.1;
  EXPECT_NEAR(robot.inertia(2, 2), 0.02 + x2 + y2, 1e-9);
}

TEST(RobotReader, RotorsLieWhereTheirLinksAre) {
  const Robot robot = racer_with_camera();
  ASSERT_EQ(robot.rotors.size(), 4U);
  const RobotRotor& first = robot.rotors[0];
  EXPECT_EQ(first.name, "propeller_0");
  EXPECT_NEAR((first.position - Eigen::Vector3d(0.15, -0.1, 0.35)).norm(), 0, 1e-9);
  EXPECT_EQ(first.sense, 1);
  EXPECT_EQ(robot.rotors[2].sense, -1);
  EXPECT_EQ(first.thrust_n_s2, 6e-6);
  EXPECT_EQ(first.torque_per_thrust_m, 0.012);
  EXPECT_EQ(first.drag_n_s2_m, 5e-5);
  ASSERT_TRUE(first.radius_m);
  EXPECT_NEAR(*first.radius_m, 0.07, 1e-9);
  ASSERT_TRUE(robot.battery_wh);
  EXPECT_NEAR(*robot.battery_wh, 37, 1e-9);
}

TEST(RobotReader, CamerasHaveThePoseOfLinkAndSensor) {
  const Robot robot = racer_with_camera();
  ASSERT_EQ(robot.cameras.size(), 1U);
  const CameraSensor& camera = robot.cameras[0];
  EXPECT_FALSE(camera.is_movable);
  EXPECT_EQ(camera.width, 800);
  const Eigen::Vector3d expected(0.1 + 0.02 * std::cos(0.3), 0.02 * std::sin(0.3), 0.28);
  EXPECT_NEAR((camera.pose.translation() - expected).norm(), 0, 1e-9);
  const Eigen::Vector3d ahead = camera.pose.linear().col(0);
  EXPECT_NEAR(std::asin(ahead.z()), -0.5, 1e-9);
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), 0.3, 1e-9);
  EXPECT_EQ(camera.distortion.k1, -0.1);
  EXPECT_EQ(camera.distortion.p1, 0.001);
}

TEST(RobotReader, NoiseIsADensityWhateverTheRate) {
  const Robot robot = racer_with_camera();
  ASSERT_TRUE(robot.sensors.gyroscope);
  EXPECT_NEAR(robot.sensors.gyroscope->density.z(), 0.04 / 20, 1e-12);  // at 400 Hz
  ASSERT_TRUE(robot.sensors.accelerometer);
  EXPECT_NEAR(robot.sensors.accelerometer->turn_on, 0.05, 1e-12);
  EXPECT_EQ(robot.sensors.gps_hz, 8);
}

TEST(RobotReader, ElementsWithoutCounterpartAreListedWithFileAndLine) {
  const Robot robot = racer_with_camera();
  EXPECT_TRUE(is_skipped(robot, "racer/model.sdf:26: plugin wings (libwings.so)"));
  EXPECT_TRUE(is_skipped(robot, "frame/model.sdf:"));
  EXPECT_TRUE(is_skipped(robot, "sensor ranger"));
  EXPECT_TRUE(is_skipped(robot, "link propeller_3: no <inertia>"));
}

TEST(RobotReader, UrdfIsReadWithItsGazeboExtensions) {
  const Robot robot = read_robot(robots_folder() / "quad.urdf", {});
  EXPECT_NEAR(robot.mass_kg, 1.25, 1e-9);
  EXPECT_NEAR(robot.center.x(), (1.2 * 0.01 + 0.05 * 0.1) / 1.25, 1e-9);
  ASSERT_EQ(robot.cameras.size(), 1U);
  EXPECT_NEAR(std::asin(robot.cameras[0].pose.linear()(2, 0)), -0.7, 1e-6);
  EXPECT_NEAR(robot.cameras[0].pose.translation().x(), 0.1, 1e-6);
  EXPECT_TRUE(robot.has_hector_propulsion);
  ASSERT_TRUE(robot.sensors.gyroscope);
  EXPECT_NEAR(robot.sensors.gyroscope->density.z(), 0.0015, 1e-12);
  EXPECT_FALSE(robot.height_m);  // a mesh collides
  EXPECT_TRUE(is_skipped(robot, "quad.urdf:25: plugin sonar"));
}

TEST(RobotReader, AMissingIncludeIsAnErrorSinceItsMassIsMissing) {
  const std::string text = find_refusal(
      "r.sdf",
      "<sdf version='1.9'><model name='m'>\n<include merge='true'><uri>model://nowhere</uri>"
      "</include>\n<link name='l'/></model></sdf>");
  EXPECT_NE(text.find("line 2"), std::string::npos) << text;
  EXPECT_NE(text.find("nowhere"), std::string::npos) << text;
}

TEST(RobotReader, SaysOnlyThatAnIncludeIsMissing) {
  const std::string text = find_refusal(
      "r.sdf",
      "<sdf version='1.9'><model name='m'>\n<include><uri>model://nowhere</uri></include>\n"
      "<link name='l'/><joint name='j' type='fixed'><parent>nowhere::l</parent><child>l</child>"
      "</joint></model></sdf>");
  EXPECT_NE(text.find("line 2: found no file for \"model://nowhere\""), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(RobotReader, NamesThatNothingHasAreSaidOnce) {
  const std::string text = find_refusal(
      "r.sdf",
      "<sdf version='1.9'><model name='m'><link name='l'/><frame name='f' attached_to='q'/>"
      "<joint name='j' type='fixed'><parent>l</parent><child>y</child></joint></model></sdf>");
  EXPECT_NE(text.find("found \"q\", to which frame \"f\" refers"), std::string::npos) << text;
  EXPECT_NE(text.find("found \"y\", to which joint \"j\" refers"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(RobotReader, AModelThatIncludesItselfIsRefused) {
  const TemporaryFolder folder;
  for (const auto& [name, other] : {std::pair("a", "b"), std::pair("b", "a")}) {
    const std::string model = name;
    write_file_atomically(folder.path() / model / "model.config",
                          "<model><sdf version='1.9'>model.sdf</sdf></model>");
    write_file_atomically(folder.path() / model / "model.sdf",
                          "<sdf version='1.9'><model name='" + model +
                              "'>\n<include merge='true'><uri>model://" + other +
                              "</uri></include></model></sdf>");
  }
  try {
    read_robot(folder.path() / "a/model.sdf", {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos) << error.what();
  }
}

TEST(RobotReader, ProblemsOfUrdfAreNamedWithTheirLines) {
  const auto robot = [](const std::string& body) {
    return find_refusal("r.urdf", "<robot name='r'>\n" + body + "\n</robot>");
  };
  const std::string good =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial>";
  struct Case {
    std::string body;
    std::string expected;
  };
  for (const Case& one : {
           Case{"", "no <link>"},
           Case{"<link name='a'>\n<inertial><mass value='heavy'/>"
                "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>",
                "line 3, <mass>: found value=\"heavy\""},
           Case{"<link name='a'><inertial><mass value='-1'/>"
                "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>",
                "a mass of -1 kg"},
           Case{"<link name='a'><inertial><mass value='1'/>"
                "<inertia ixx='1' ixy='0' ixz='0' iyy='-1' iyz='0' izz='1'/></inertial></link>",
                "least principal moment"},
           Case{"<link name='arm'>" + good + "</link>\n<link name='b'>" + good +
                    "</link>\n<joint name='j' type='fixed'><parent link='armm'/><child link='b'/>"
                    "</joint>",
                "unknown link \"armm\"; did you mean \"arm\"?"},
           Case{"<link name='a'>" + good + "</link><link name='b'>" + good + "</link>",
                "without a parent"},
           Case{"<link name='a'>" + good + "</link><link name='b'>" + good +
                    "</link><joint name='j' type='welded'><parent link='a'/><child link='b'/>"
                    "</joint>",
                "type \"welded\""},
       }) {
    const std::string text = robot(one.body);
    EXPECT_NE(text.find(one.expected), std::string::npos) << one.body << "\n" << text;
  }
}

TEST(RobotReader, LinksThatTheConversionDropsAreMissed) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
      "</inertial>";
  const std::string text =
      find_refusal("r.urdf", "<robot name='r'><link name='a'>" + inertial +
                                 "</link><link name='bare'/><link name='c'>" + inertial +
                                 "</link><joint name='j' type='continuous'><parent link='a'/>"
                                 "<child link='bare'/></joint><joint name='k' type='continuous'>"
                                 "<parent link='bare'/><child link='c'/></joint></robot>");
  EXPECT_NE(text.find("1 kg of 2 kg"), std::string::npos) << text;
}

TEST(RobotReader, AXacroFileIsRefusedWithTheCommandThatExpandsIt) {
  const std::string text =
      find_refusal("quad.urdf.xacro",
                   "<robot xmlns:xacro='http://www.ros.org/wiki/xacro'>\n<xacro:include "
                   "filename='base.xacro'/></robot>");
  EXPECT_NE(text.find("xacro "), std::string::npos) << text;
  EXPECT_NE(text.find("-o quad.urdf"), std::string::npos) << text;
}

TEST(RobotReader, OtherFilesAreRefused) {
  EXPECT_NE(find_refusal("r.sdf", "no xml"), "");
  EXPECT_NE(find_refusal("r.sdf", "<robot"), "");
  EXPECT_NE(find_refusal("r.sdf", ""), "");
  EXPECT_NE(find_refusal("w.sdf", "<sdf version='1.9'><world name='w'/></sdf>").find("a world"),
            std::string::npos);
  EXPECT_THROW(read_robot("/nowhere/robot.sdf", {}), InputError);
}

TEST(RobotReader, APluginsNumberThatIsNoneIsNamed) {
  const std::string text = find_refusal(
      "r.sdf",
      "<sdf version='1.9'><model name='m'><link name='rotor'><inertial><mass>1</mass></inertial>"
      "</link>\n<plugin name='p' filename='motor.so'><linkName>rotor</linkName>"
      "<turningDirection>cw</turningDirection>\n<motorConstant>strong</motorConstant>"
      "</plugin></model></sdf>");
  EXPECT_NE(text.find("<motorConstant>strong"), std::string::npos) << text;
  EXPECT_NE(text.find("line 2"), std::string::npos) << text;
}

}  // namespace
}  // namespace throng::imports
