// A yard between four walls with one door, as files: the least that is a scenario without faults.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/world/temporary_folder.h"

namespace throng::testing {

struct Yard {
  nlohmann::json scenario = nlohmann::json::parse(R"({
    "name": "Yard",
    "crowd": {"scene": "scene.xml", "behavior": "behavior.xml"},
    "ground": {"min": [-30, -30], "max": [30, 30], "material": "pavers"},
    "inside": {"min": [-12, -12], "max": [12, 12]},
    "exits": [{"id": "gate", "from": [10, -1.5], "to": [10, 1.5], "goals": [[3, 0]]}],
    "buildings": [{"id": "hut", "footprint": [[-8, 4], [-4, 4], [-4, 8], [-8, 8]], "height_m": 4}],
    "drones": [{"id": "d1", "start": [0, 0, 20]}]
  })");
  /// Walls 1 m thick around the yard, with a gap of 3 m in the east; the hut.
  std::string obstacles = box(-11, -11, -10, 11) + box(-10, 10, 11, 11) + box(-10, -11, 11, -10) +
                          box(10, 1.5, 11, 10) + box(10, -10, 11, -1.5) + box(-8, 4, -4, 8);
  std::string generator =
      R"(<Generator type="rect_grid" anchor_x="-3" anchor_y="-3" offset_x="1" offset_y="1"
          count_x="4" count_y="4"/>)";
  std::string goals = R"(<GoalSet id="3"><Goal id="0" type="point" x="14" y="0"/></GoalSet>)";
  std::string selector = R"(<GoalSelector type="nearest" goal_set="3"/>)";

  static std::string box(double x0, double y0, double x1, double y1) {
    const auto vertex = [](double x, double y) {
      return "<Vertex p_x=\"" + std::to_string(x) + "\" p_y=\"" + std::to_string(y) + "\"/>";
    };
    return "<Obstacle closed=\"1\">" + vertex(x0, y0) + vertex(x1, y0) + vertex(x1, y1) +
           vertex(x0, y1) + "</Obstacle>";
  }

  std::filesystem::path write(const TemporaryFolder& folder) const {
    folder.write(
        "scene.xml",
        R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Common time_step="0.1"/>
      <AgentProfile name="adult"><Common r="0.25"/></AgentProfile>
      <AgentGroup><ProfileSelector type="const" name="adult"/>
        <StateSelector type="const" name="Walk"/>)" +
            generator + R"(</AgentGroup><ObstacleSet type="explicit" class="1">)" + obstacles +
            "</ObstacleSet></Experiment>");
    folder.write("behavior.xml", "<BFSM>" + goals + R"(<State name="Walk" final="1">)" + selector +
                                     R"(<VelComponent type="auto"/></State></BFSM>)");
    return folder.write("yard.json", scenario.dump(1));
  }
};

}  // namespace throng::testing
