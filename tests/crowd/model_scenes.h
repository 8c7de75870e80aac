// Scenes with all models' elements, as Menge's examples have them.
#pragma once

#include <string>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd::test {

inline const std::string& model_constants() {
  static const std::string kConstants = R"(
  <GCF reaction_time="0.5" max_agent_dist="2" max_agent_force="3" agent_interp_width="0.1"
       agent_force_strength="0.35"/>
  <Johansson agent_scale="25" obstacle_scale="35" reaction_time="0.5" force_distance="0.15"
       stride_time="0.5"/>
  <Karamouzas orient_weight="0.8" fov="200" reaction_time="0.4" wall_steepness="2"
       wall_distance="2" colliding_count="5" d_min="1" d_mid="8" d_max="10" agent_force="4"/>
  <Zanlungo agent_scale="2000" obstacle_scale="4000" reaction_time="0.5" force_distance="0.015"/>
  <Dummy stddev="0"/>)";
  return kConstants;
}

inline std::string model_profile(const std::string& name, const std::string& common,
                                 const std::string& pedvo = "") {
  return fmt::format(R"(
  <AgentProfile name="{}">
    <Common max_neighbors="10" neighbor_dist="5" r="0.2" pref_speed="1.34" max_speed="2"
            max_accel="5"/>
    <Common {}/>
    <PedVO tau="3" tauObst="0.1" {}/>
    <GCF stand_depth="0.18" move_scale="0.53" slow_width="0.25" sway_change="0.05"/>
    <Johansson fov_weight="0.16"/>
    <Karamouzas personal_space="0.69" anticipation="8"/>
    <ORCA tau="3" tauObst="0.15"/>
    <Zanlungo mass="80"/>
  </AgentProfile>)",
                     name, common, pedvo);
}

inline std::string group(const std::string& profile, const std::string& state,
                         const std::string& agents) {
  return fmt::format(R"(
  <AgentGroup>
    <ProfileSelector type="const" name="{}"/><StateSelector type="const" name="{}"/>
    <Generator type="explicit">{}</Generator>
  </AgentGroup>)",
                     profile, state, agents);
}

inline std::string scene_text(const std::string& content) {
  return fmt::format(R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/>
  <Common time_step="0.1"/>{}{}</Experiment>)",
                     model_constants(), content);
}

/// Agents in state Start; `extra` more elements.
inline std::string model_scene(const std::string& agents, const std::string& common = "",
                               const std::string& extra = "") {
  return scene_text(model_profile("a", common) + group("a", "Start", agents) + extra);
}

/// Agents that stand, for model_scene.
inline std::string standing_group(const std::string& agents) { return group("a", "Stand", agents); }

/// Two agents of which each has its own profile.
inline std::string two_profiles_scene(const std::string& first_common,
                                      const std::string& second_common, const std::string& pedvo,
                                      const std::string& first, const std::string& second) {
  return scene_text(model_profile("a", first_common, pedvo) +
                    model_profile("b", second_common, pedvo) + group("a", "Start", first) +
                    group("b", "Start", second));
}

/// A column of agents, 0.5 m apart, along the x axis.
inline std::string column_scene(const std::string& pedvo) {
  std::string agents;
  for (int i = 0; i < 12; ++i) agents += agent_at(0.5 * i, 0);
  return scene_text(model_profile("a", "", pedvo) + group("a", "Start", agents));
}

/// A square of `count` agents, 1 m apart.
inline std::string model_crowd_scene(int count) {
  std::string agents;
  for (int i = 0; i < count; ++i) agents += agent_at(i % 20 - 7.3, i / 20 - 5.9);
  return model_scene(agents);
}

inline std::string box(double min_x, double min_y, double max_x, double max_y) {
  return fmt::format(R"(<ObstacleSet type="explicit" class="1"><Obstacle closed="1">
    <Vertex p_x="{0}" p_y="{1}"/><Vertex p_x="{2}" p_y="{1}"/><Vertex p_x="{2}" p_y="{3}"/>
    <Vertex p_x="{0}" p_y="{3}"/></Obstacle></ObstacleSet>)",
                     min_x, min_y, max_x, max_y);
}

/// Everyone in Start goes to one point; those in Stand stand.
inline std::string to_point_behavior(double x, double y) {
  return fmt::format(R"(<BFSM><GoalSet id="0"><Goal type="point" id="0" x="{}" y="{}"/></GoalSet>
  <State name="Start" final="0"><GoalSelector type="explicit" goal_set="0" goal="0"/>
    <VelComponent type="goal"/></State>
  <State name="Stand" final="1"><VelComponent type="zero"/></State>
  <Transition from="Start" to="Stand"><Condition type="goal_reached" distance="0.2"/></Transition>
</BFSM>)",
                     x, y);
}

inline std::string eastward_behavior(const std::string& modifier) {
  return fmt::format(R"(<BFSM><State name="Start" final="0">
  <VelComponent type="const_dir" x="1" y="0"/>{}</State></BFSM>)",
                     modifier);
}

}  // namespace throng::crowd::test
