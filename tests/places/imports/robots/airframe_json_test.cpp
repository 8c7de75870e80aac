// Robots as airframes: the fields that jobs read, and robots that throng does not fly.
#include "places/imports/robots/airframe_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "base/error.h"
#include "places/imports/robots/robot_reader.h"
#include "spec/job/spec.h"
#include "tests/places/imports/robots/folder.h"

namespace throng::imports {
namespace {

using nlohmann::json;

Robot racer() {
  return read_robot(robots_folder() / "racer_with_camera/model.sdf", {robots_folder()});
}

json make_airframe(const Robot& robot, const AirframeChoices& choices = {}) {
  std::vector<std::string> assumptions;
  return airframe_json(robot, "robot.sdf", choices, assumptions);
}

std::string find_refusal(const Robot& robot, const AirframeChoices& choices = {}) {
  try {
    make_airframe(robot, choices);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AirframeJson, RotorsAreRelativeToTheCenterOfMass) {
  const Robot robot = racer();
  const json airframe = make_airframe(robot);
  EXPECT_NEAR(airframe["rotors"][0]["at_m"][0].get<double>(), 0.15 - robot.center.x(), 1e-6);
  EXPECT_NEAR(airframe["rotors"][0]["at_m"][1].get<double>(), -0.1, 1e-6);
  EXPECT_EQ(airframe["rotors"][0]["turns"], "counterclockwise");
  EXPECT_EQ(airframe["battery_wh"], 37);
  EXPECT_EQ(airframe["motor_down_s"], 0.03);
}

TEST(AirframeJson, TheCameraOfTheAirframeIsThatOfItsDrone) {
  const json airframe = make_airframe(racer());
  json job = {{"scenario", "city_square/everyday"},
              {"drones", json::array({{{"id", "d1"}, {"airframe", airframe}}})}};
  const jobs::JobSpec spec = jobs::parse_job(job.dump(), "job");
  const jobs::CameraSpec& camera = spec.drones.at(0).camera;
  EXPECT_EQ(camera.width, 800);
  EXPECT_NEAR(camera.pitch_deg, -28.65, 0.01);
  EXPECT_NEAR(camera.yaw_deg, 17.19, 0.01);
  EXPECT_NEAR(camera.mount_m.x(), 0.1 + 0.0191067 - racer().center.x(), 1e-4);
  EXPECT_EQ(camera.gimbal.model, camera::GimbalModel::rigid);
  EXPECT_EQ(camera.lens.k1, -0.1);
  // The drone's own fields count where they say otherwise.
  job["drones"][0]["camera"] = {{"pitch_deg", -60}, {"preset", "dji_phantom_4"}};
  const jobs::JobSpec other = jobs::parse_job(job.dump(), "job");
  EXPECT_EQ(other.drones.at(0).camera.pitch_deg, -60);
  EXPECT_NE(other.drones.at(0).camera.width, 800);
  EXPECT_NEAR(other.drones.at(0).camera.yaw_deg, 17.19, 0.01);
}

TEST(AirframeJson, ACameraOfAnAirframeIsCheckedAtItsPointer) {
  json airframe = make_airframe(racer());
  airframe["camera"]["pitch_deg"] = 80;
  airframe["camera"]["zoom"] = 2;
  const json job = {{"scenario", "city_square/everyday"},
                    {"drones", json::array({{{"id", "d1"}, {"airframe", airframe}}})}};
  try {
    jobs::parse_job(job.dump(), "job");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("/drones/0/airframe/camera/pitch_deg"), std::string::npos) << text;
    EXPECT_NE(text.find("/drones/0/airframe/camera/zoom"), std::string::npos) << text;
  }
}

TEST(AirframeJson, ABaseGivesWhatTheDescriptionDoesNot) {
  Robot robot = racer();
  robot.rotors.clear();
  EXPECT_NE(find_refusal(robot).find("--base"), std::string::npos);
  const json airframe = make_airframe(robot, {sim::find_airframe("hector"), ""});
  EXPECT_NEAR(airframe["mass_kg"].get<double>(), 1.1, 1e-6);
  EXPECT_EQ(airframe["arm_m"], 0.275);
  EXPECT_TRUE(airframe.contains("electric_motor"));
  EXPECT_EQ(airframe["autopilot"]["max_tilt_deg"], 45);
  // Errors of sensors that the description states are its own.
  EXPECT_EQ(airframe["sensors"]["gps_hz"], 8);
  EXPECT_EQ(airframe["sensors"]["pressure_pa"], 1.2);
}

TEST(AirframeJson, HectorsPropulsionIsThatOfTheAirframeHector) {
  const json airframe = make_airframe(read_robot(robots_folder() / "quad.urdf", {}));
  EXPECT_NEAR(airframe["mass_kg"].get<double>(), 1.25, 1e-6);
  EXPECT_TRUE(airframe.contains("electric_motor"));
  EXPECT_EQ(airframe["height_m"], 0.15);  // hector's, since a mesh collides
}

TEST(AirframeJson, RobotsThatAreNoQuadcoptersAreRefused) {
  Robot robot = racer();
  robot.rotors.pop_back();
  EXPECT_NE(find_refusal(robot).find("3 rotors"), std::string::npos);
  robot = racer();
  robot.rotors[2].thrust_n_s2 *= 1.5;
  EXPECT_NE(find_refusal(robot).find("four equal rotors"), std::string::npos);
  robot = racer();
  robot.rotors[1].axis = Eigen::Vector3d(1, 0, 1).normalized();
  EXPECT_NE(find_refusal(robot).find("tilted by 45 degrees"), std::string::npos);
  robot = racer();
  robot.inertia *= 1e3;  // in g m²
  EXPECT_NE(find_refusal(robot).find("as if all mass lay"), std::string::npos);
  robot = racer();
  robot.mass_kg = 3;
  EXPECT_NE(find_refusal(robot).find("for a weight of"), std::string::npos) << find_refusal(robot);
}

TEST(AirframeJson, AnUnknownCameraIsAnsweredWithTheNearestName) {
  EXPECT_NE(find_refusal(racer(), {std::nullopt, "veiw"}).find("did you mean \"view\""),
            std::string::npos);
}

}  // namespace
}  // namespace throng::imports
