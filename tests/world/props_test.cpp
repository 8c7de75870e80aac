// Props in scenario files: what is read, what is refused, what is scattered.
#include "world/props.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "tests/world/temporary_folder.h"
#include "world/fields/read_scenario.h"
#include "world/scenario.h"

namespace throng::world {
namespace {

class PropsTest : public ::testing::Test {
 protected:
  /// A place with one building, one exit at x = 10 and these further fields.
  Scenario load(const std::string& more, const std::string& ground = "") const {
    const std::string text = fmt::format(
        R"({{"name": "n", "crowd": {{"scene": "a.xml", "behavior": "a.xml"}},
            "ground": {{"min": [-50, -50], "max": [50, 50], "material": "asphalt"{}}},
            "inside": {{"min": [-10, -10], "max": [10, 10]}},
            "exits": [{{"id": "e", "from": [10, -1], "to": [10, 1], "goals": [[0, 0]]}}],
            "buildings": [{{"id": "b", "footprint": [[-5, 5], [5, 5], [5, 9], [-5, 9]],
                            "height_m": 5}}]{}}})",
        ground, more);
    write_file_atomically(folder_.path() / "a.xml", "<a/>");
    write_file_atomically(folder_.path() / "s.json", text);
    return load_scenario(folder_.path() / "s.json", "s");
  }

  std::string refused_at(const std::string& more, const std::string& ground = "") const {
    try {
      load(more, ground);
    } catch (const InputError& error) {
      return error.problems().front().where;
    }
    return "nothing";
  }

  throng::testing::TemporaryFolder folder_;
};

TEST_F(PropsTest, AreReadAsTheyStand) {
  const Scenario scenario = load(
      R"(, "props": [{"kind": "car", "position": [-20, 3], "yaw_deg": 90, "scale": 0.5},
                     {"kind": "tree", "position": [0, -8]}])");
  ASSERT_EQ(scenario.props.size(), 2U);
  EXPECT_EQ(scenario.props[0].kind, PropKind::car);
  EXPECT_NEAR(scenario.props[0].yaw_rad, 1.5707963, 1e-6);
  EXPECT_EQ(scenario.props[1].kind, PropKind::tree);
  // A car of half the size that heads along +y covers 0.45 m to its sides and 1.075 m ahead.
  EXPECT_NEAR(distance_to(scenario.props[0], {-18.55, 3}), 1, 1e-9);
  EXPECT_NEAR(distance_to(scenario.props[0], {-20, 5.075}), 1, 1e-9);
  EXPECT_EQ(distance_to(scenario.props[0], {-20, 4}), 0);
}

TEST_F(PropsTest, PlantersCoverAsMuchGroundAsTheyAreLarge) {
  const Scenario scenario = load(R"(, "props": [{"kind": "bush", "position": [-20, 0]},
                                                {"kind": "planter", "position": [-30, 0]}])");
  ASSERT_EQ(scenario.props.size(), 2U);
  EXPECT_EQ(prop_type(scenario.props[0].kind).semantic_class, SemanticClass::bush);
  EXPECT_EQ(prop_type(scenario.props[1].kind).semantic_class, SemanticClass::planter);
  EXPECT_NEAR(distance_to(scenario.props[0], {-18, 0}), 1.3, 1e-9);
  EXPECT_NEAR(distance_to(scenario.props[1], {-30, 1.4}), 1, 1e-9);
}

TEST_F(PropsTest, MistakesAreNamedByTheirPointer) {
  EXPECT_EQ(refused_at(R"(, "props": [{"kind": "unicorn", "position": [0, 0]}])"), "/props/0/kind");
  EXPECT_EQ(refused_at(R"(, "props": [{"kind": "bin"}])"), "/props/0/position");
  EXPECT_EQ(refused_at(R"(, "props": [{"kind": "bin", "position": [0, 0], "size": 1}])"),
            "/props/0/size");
  EXPECT_EQ(refused_at(R"(, "scatter": [{"kinds": [], "area": [[0, 0], [1, 0], [1, 1]],
                                          "count": 3, "seed": 1}])"),
            "/scatter/0/kinds");
}

TEST_F(PropsTest, NothingStandsInBuildingsOrInTheWayOfExits) {
  const auto bin_at = [](double x, double y) {
    return fmt::format(R"(, "props": [{{"kind": "bin", "position": [{}, {}]}}])", x, y);
  };
  EXPECT_EQ(refused_at(bin_at(0, 6)), "/props/0/position");
  EXPECT_EQ(refused_at(bin_at(0, 4.9)), "/props/0/position") << "its edge is in the wall";
  EXPECT_EQ(refused_at(bin_at(0, 4.5)), "nothing");
  EXPECT_EQ(refused_at(bin_at(12, 0)), "/props/0/position") << "behind the door";
  EXPECT_EQ(refused_at(bin_at(8, 1.2)), "/props/0/position") << "before the door's edge";
  EXPECT_EQ(refused_at(bin_at(8, 1.5)), "nothing");
  EXPECT_EQ(refused_at(bin_at(14, 0)), "nothing");
  EXPECT_EQ(refused_at(R"(, "props": [{"kind": "car", "position": [10, 2.5], "yaw_deg": 90}])"),
            "/props/0/position")
      << "a car beside the door reaches into its way";
}

TEST_F(PropsTest, ScatteredPropsStayInTheirAreaAndOffEverythingElse) {
  const std::string more =
      R"(, "props": [{"kind": "tree", "position": [0, 0]}],
          "scatter": [{"kinds": ["tree", "bench"], "area": [[-12, -12], [14, -12], [14, 12], [-12, 12]],
                       "count": 40, "seed": 5, "apart_m": 2}])";
  const Scenario scenario = load(more);
  ASSERT_GT(scenario.props.size(), 30U);
  ASSERT_LE(scenario.props.size(), 41U);
  for (std::size_t i = 1; i < scenario.props.size(); ++i) {
    const Prop& prop = scenario.props[i];
    EXPECT_LE(prop.position.cwiseAbs().maxCoeff(), 14);
    EXPECT_FALSE(prop.position.y() > 5 && prop.position.y() < 9 && std::abs(prop.position.x()) < 5);
    EXPECT_FALSE(prop.position.x() > 7 && std::abs(prop.position.y()) < 1);
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE((prop.position - scenario.props[j].position).norm(), 2);
    }
  }
  const Scenario again = load(more);
  ASSERT_EQ(again.props.size(), scenario.props.size());
  EXPECT_EQ(again.props.back().position, scenario.props.back().position);
  EXPECT_EQ(again.props.back().look, scenario.props.back().look);
}

TEST_F(PropsTest, MeshesAreFilesInTheScenariosFolder) {
  EXPECT_EQ(refused_at(R"(, "meshes": [{"file": "no.obj", "position": [0, 0, 0]}])"),
            "/meshes/0/file");
  EXPECT_EQ(refused_at(R"(, "meshes": [{"file": "../a.xml", "position": [0, 0, 0]}])"),
            "/meshes/0/file");
  EXPECT_EQ(refused_at(R"(, "meshes": [{"file": "/etc/passwd", "position": [0, 0, 0]}])"),
            "/meshes/0/file");
  const Scenario scenario =
      load(R"(, "meshes": [{"file": "a.xml", "position": [1, 2, 3], "scale": 2}])");
  ASSERT_EQ(scenario.meshes.size(), 1U);
  EXPECT_EQ(scenario.meshes[0].file, folder_.path() / "a.xml");
  EXPECT_EQ(scenario.meshes[0].position, Eigen::Vector3d(1, 2, 3));
}

TEST_F(PropsTest, GroundHasAreasAndMarkings) {
  const Scenario scenario = load(
      "", R"(, "areas": [{"corners": [[0, 0], [0, 5], [5, 5]], "material": "grass", "kerb": 1}],
              "markings": [{"kind": "crossing", "from": [0, 0], "to": [6, 0]}])");
  ASSERT_EQ(scenario.areas.size(), 1U);
  EXPECT_TRUE(scenario.areas[0].kerb);
  EXPECT_EQ(scenario.areas[0].corners[1], Eigen::Vector2d(0, 5)) << "turned counter-clockwise";
  ASSERT_EQ(scenario.markings.size(), 1U);
  EXPECT_EQ(scenario.markings[0].width_m, 4);
  EXPECT_EQ(refused_at("", R"(, "areas": [{"corners": [[0, 0], [0, 5]], "material": "grass"}])"),
            "/ground/areas/0/corners");
  EXPECT_EQ(
      refused_at("", R"(, "areas": [{"corners": [[0, 0], [0, 5], [5, 5]], "material": "lava"}])"),
      "/ground/areas/0/material");
  EXPECT_EQ(refused_at("", R"(, "markings": [{"kind": "arrow", "from": [0, 0], "to": [6, 0]}])"),
            "/ground/markings/0/kind");
}

}  // namespace
}  // namespace throng::world
