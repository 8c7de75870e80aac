// Small scenes and behaviors written to files for the tests.
#pragma once

#include <fmt/core.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/files/resources.h"
#include "crowd/simulation.h"

namespace throng::crowd::test {

/// A folder that is removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("throng_crowd_{}_{}", getpid(), next_number())) {
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  static int next_number() {
    static int number = 0;
    return number++;
  }

  std::filesystem::path path_;
};

inline Simulation load(const std::string& scene, const std::string& behavior,
                       const LoadOptions& options = {}) {
  const TemporaryFolder folder;
  return {folder.write("scene.xml", scene), folder.write("behavior.xml", behavior), options};
}

/// A scene of agents of one profile; `agents` are <Agent> elements, `extra` more elements.
inline std::string scene_with(const std::string& agents, const std::string& common = "",
                              const std::string& state = "Start", const std::string& extra = "",
                              double time_step_s = 0.1) {
  return fmt::format(R"(<Experiment version="2.0">
  <SpatialQuery type="kd-tree"/>
  <Common time_step="{}"/>
  <AgentProfile name="a"><Common {}/><ORCA tau="3" tauObst="0.5"/></AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="a"/>
    <StateSelector type="const" name="{}"/>
    <Generator type="explicit">{}</Generator>
  </AgentGroup>
  {}
</Experiment>)",
                     time_step_s, common, state, agents, extra);
}

inline std::string agent_at(double x, double y) {
  return fmt::format(R"(<Agent p_x="{}" p_y="{}"/>)", x, y);
}

/// Everyone walks to the mirror image of where they start.
inline std::string mirror_behavior() {
  return R"(<BFSM>
  <State name="Start" final="0"><GoalSelector type="mirror" mirror_x="1" mirror_y="1"/>
    <VelComponent type="goal"/></State>
  <State name="Stop" final="1"><GoalSelector type="identity"/><VelComponent type="goal"/></State>
  <Transition from="Start" to="Stop"><Condition type="goal_reached" distance="0.1"/></Transition>
</BFSM>)";
}

/// Agents stand in state Start and go to state End when the condition holds.
inline std::string condition_behavior(const std::string& condition, const std::string& goals = "") {
  return fmt::format(R"(<BFSM>{}
  <State name="Start" final="0"/>
  <State name="End" final="1"/>
  <Transition from="Start" to="End">{}</Transition>
</BFSM>)",
                     goals, condition);
}

inline const std::string& state_name(const Simulation& simulation, std::size_t agent) {
  return simulation.state_names()[simulation.states()[agent]];
}

inline std::filesystem::path city_square(const std::string& file) {
  return source_folder() / "scenarios/city_square" / file;
}

inline Simulation load_city_square(std::uint64_t seed) {
  return {
      city_square("square_scene.xml"), city_square("nearest_exit_behavior.xml"), {.seed = seed}};
}

}  // namespace throng::crowd::test
