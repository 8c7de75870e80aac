// A project that uses everything that Menge's files may say, also what no example does: it loads
// without a word of complaint, whosever results are wanted, and runs with every model.
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "crowd/project/project.h"
#include "crowd/state/model.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

/// A square room of 20 m in two halves, with a pillar for its obstacles.
const std::string kMesh = R"(10
-10 -10
0 -10
10 -10
10 10
0 10
-10 10
-8 -8
-7 -8
-7 -7
-8 -7
1
1 4 0 1
4
6 7 0 1
7 8 0 2
8 9 0 3
9 6 0 0
west
1
-5 0
4 0 1 4 5
0.1 0 1
1 0
4 0 1 2 3
east
1
5 0
4 1 2 3 4
0.1 0 1
1 0
0
)";

const std::string kScene = R"(<?xml version="1.0"?>
<Experiment version="2.0">
  <SpatialQuery type="nav_mesh" file_name="room.nav" test_visibility="1"/>
  <Common time_step="0.1"/>
  <Helbing agent_scale="2000" obstacle_scale="4000" reaction_time="0.5" body_force="1200"
           friction="2400" force_distance="0.015"/>
  <Johansson agent_scale="25" obstacle_scale="35" reaction_time="0.5" force_distance="0.15"
             stride_time="0.5"/>
  <Karamouzas orient_weight="0.8" fov="200" reaction_time="0.4" wall_steepness="2" wall_distance="2"
              colliding_count="5" d_min="1" d_mid="8" d_max="10" agent_force="4"/>
  <Zanlungo agent_scale="2000" obstacle_scale="4000" reaction_time="0.5" force_distance="0.005"/>
  <GCF reaction_time="0.5" max_agent_dist="2" max_agent_force="3" agent_interp_width="0.1"
       agent_force_strength="0.35" speed_color="0"/>
  <Dummy stddev="0.01"/>
  <OpenSteer max_force="8" leak_through="0.1" reaction_time="0.5"/>
  <Elevation type="{elevation}"/>
  <AgentProfile name="one">
    <Common max_speed="2" max_accel="5" pref_speed="1.3" r="0.2" neighbor_dist="5" max_neighbors="10"
            max_angle_vel="360" obstacleSet="1" class="1" priority="0"/>
    <ORCA tau="3" tauObst="0.15"/>
    <PedVO tau="3" tauObst="0.15" turningBias="1.2" factor="1.57" buffer="0.9" density_aware="1"/>
    <Helbing mass="80"/>
    <Johansson fov_weight="0.16"/>
    <Karamouzas personal_space="0.69" anticipation="8"/>
    <Zanlungo mass="80"/>
    <GCF stand_depth="0.18" move_scale="0.53" slow_width="0.25" sway_change="0.05"/>
    <OpenSteer tau="3" tauObst="6"/>
  </AgentProfile>
  <AgentProfile name="other" inherits="one">
    <Common class="2" priority="0.5">
      <Property name="pref_speed" dist="n" mean="1.3" stddev="0.2" seed="5"/>
      <Property name="max_speed" dist="u" min="1.8" max="2.2"/>
      <Property name="max_accel" dist="c" value="5"/>
      <Property name="r" dist="u" min="0.15" max="0.25"/>
      <Property name="max_angle_vel" dist="u" min="90" max="180"/>
      <Property name="neighbor_dist" dist="c" value="6"/>
      <Property name="max_neighbors" dist="u" min="8" max="12"/>
    </Common>
    <ORCA><Property name="tau" dist="u" min="2" max="3"/></ORCA>
    <GCF><Property name="facing_min" dist="c" value="0.18"/></GCF>
    <VelModifier type="scale" scale="0.9"/>
    <VelModifier type="fundamental_diagram" factor_dist="c" factor_value="1.57" buffer_dist="u"
                 buffer_min="0.8" buffer_max="0.9" sigma_agent="1.5" sigma_obstacle="0.75"/>
    <VelModifier type="height_field" file_name="slope.ht" dir_weight="1.2" up_hill_scale="1"
                 down_hill_scale="0.2"/>
  </AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="one"/>
    <StateSelector type="const" name="Explicit"/>
    <Generator type="explicit" displace_dist="u" displace_min="0" displace_max="0.1">
      <Agent p_x="-9" p_y="9"/><Agent p_x="-7" p_y="9"/>
    </Generator>
    <Generator type="nav_mesh_explicit" file_name="room.nav" group_name="west">
      <Agent p_x="-5" p_y="9"/>
    </Generator>
  </AgentGroup>
  <AgentGroup>
    <ProfileSelector type="random"><Profile name="one"/><Profile name="other"/></ProfileSelector>
    <StateSelector type="const" name="Wander"/>
    <Generator type="rect_grid" anchor_x="-9" anchor_y="0" offset_x="1" offset_y="1" count_x="5"
               count_y="2" rotation="5" displace_dist="n" displace_mean="0" displace_stddev="0.05"/>
  </AgentGroup>
  <AgentGroup>
    <ProfileSelector type="weighted"><Profile name="one" weight="1"/><Profile name="other"
                                                                            weight="3"/>
    </ProfileSelector>
    <StateSelector type="const" name="Field"/>
    <Generator type="hex_lattice" anchor_x="5" anchor_y="-9" alignment="center" row_direction="x"
               density="1" width="4" population="9" rotation="0" displace_dist="c"
               displace_value="0.01"/>
  </AgentGroup>
  <ObstacleSet type="nav_mesh" file_name="room.nav" class="1"/>
  <ObstacleSet type="explicit" class="2">
    <Obstacle closed="1"><Vertex p_x="-4" p_y="-4"/><Vertex p_x="-3" p_y="-4"/>
      <Vertex p_x="-3" p_y="-3"/></Obstacle>
  </ObstacleSet>
</Experiment>)";

const std::string kGoals = R"(
  <GoalSet id="0">
    <Goal type="point" id="0" x="8" y="8" capacity="100" weight="2"/>
    <Goal type="circle" id="1" x="8" y="-8" radius="1"/>
    <Goal type="AABB" id="2" min_x="-9" min_y="-2" max_x="-8" max_y="2"/>
    <Goal type="OBB" id="3" x="7" y="0" width="2" height="1" angle="30"/>
    <Goal type="path" id="4" speed="1" closed="1" shape="obb" x="0" y="0" width="1" height="1"
          angle="45"><Point x="0" y="5"/><Point x="5" y="5"/><Point x="5" y="0"/></Goal>
  </GoalSet>
  <GoalSet id="1">
    <Goal type="path" id="0" speed="0.5" closed="0" shape="aabb" min_x="-0.5" min_y="-0.5"
          max_x="0.5" max_y="0.5"><Point x="0" y="-5"/><Point x="5" y="-5"/></Goal>
    <Goal type="path" id="1" speed="2" closed="0" shape="point" x="0" y="0">
      <Point x="1" y="1"/><Point x="2" y="1"/></Goal>
    <Goal type="path" id="2" speed="2" closed="1" shape="circle" x="0" y="0" radius="1">
      <Point x="1" y="1"/><Point x="2" y="1"/></Goal>
  </GoalSet>)";

/// Everybody goes from state to state twice a second or so.
const std::string kBehavior = R"(<?xml version="1.0"?>
<BFSM>{goals}
  <VelModifier type="scale" scale="1.1"/>
  <State name="Explicit" final="0">
    <GoalSelector type="explicit" goal_set="0" goal="0" persistent="1"/>
    <VelComponent type="nav_mesh" file_name="room.nav" heading_threshold="15"/>
    <Action type="set_property" property="pref_speed" dist="u" min="1" max="1.4" exit_reset="1"/>
    <Action type="add_obstacle" operand="2" exit_reset="1"/>
  </State>
  <State name="Wander" final="0">
    <GoalSelector type="random" goal_set="0"/><VelComponent type="goal"/>
    <Action type="offset_property" property="r" dist="c" value="0.01"/>
    <Action type="remove_obstacle" operand="2"/>
  </State>
  <State name="Weighted" final="0">
    <GoalSelector type="weighted" goal_set="0"/>
    <VelComponent type="road_map" file_name="roads.txt"/>
    <Action type="scale_property" property="max_accel" dist="n" mean="1" stddev="0.05"
            exit_reset="1"/>
    <Action type="set_obstacle" operand="3" exit_reset="1"/>
  </State>
  <State name="Nearest" final="0">
    <GoalSelector type="nearest" goal_set="1"/><VelComponent type="goal"/>
    <Action type="set_xproperty" property="pref_speed" origin="0" value="1" scale="0.01"
            exit_reset="1"/>
    <Action type="set_property" property="max_angle_vel" dist="c" value="3" exit_reset="1"/>
  </State>
  <State name="Farthest" final="0">
    <GoalSelector type="farthest" goal_set="1"/><VelComponent type="goal"/>
    <Action type="timed_stress" duration_dist="u" duration_min="1" duration_max="2"
            neighbor_dist_dist="c" neighbor_dist_value="-0.04" max_neighbors_dist="c"
            max_neighbors_value="-0.2" radius_dist="c" radius_value="0.1" pref_speed_dist="c"
            pref_speed_value="0.6" time_horizon_dist="c" time_horizon_value="-0.2"
            exit_behavior="cool down" cool_duration_dist="c" cool_duration_value="5"/>
  </State>
  <State name="NearMesh" final="0">
    <GoalSelector type="nearest_nav_mesh" goal_set="0" file_name="room.nav"/>
    <VelComponent type="nav_mesh" file_name="room.nav"/>
    <Action type="distance_stress" shape="circle" x="0" y="0" radius="2" inner_dist="c"
            inner_value="1" outer_dist="c" outer_value="5" fall_off="linear"
            exit_behavior="reset"/>
  </State>
  <State name="FarMesh" final="0">
    <GoalSelector type="farthest_nav_mesh" goal_set="0" file_name="room.nav"/>
    <VelComponent type="goal"/>
    <Action type="distance_stress" shape="obb" x="0" y="0" width="2" height="2" angle="10"
            inner_dist="c" inner_value="1" outer_dist="n" outer_mean="5" outer_stddev="0.1"
            fall_off="quadratic" exit_behavior="pause"/>
  </State>
  <State name="Mirror" final="0">
    <GoalSelector type="mirror" mirror_x="1"/><VelComponent type="goal"/>
    <VelModifier type="formation" file_name="wedge.txt"/>
  </State>
  <State name="Offset" final="0">
    <GoalSelector type="offset" dist="u" min_x="-1" max_x="1" min_y="-1" max_y="1"/>
    <VelComponent type="goal"/>
  </State>
  <State name="OffsetConstant" final="0">
    <GoalSelector type="offset" dist="c" x_value="1" y_value="0"/><VelComponent type="goal"/>
  </State>
  <State name="Shared" final="0">
    <GoalSelector type="shared" state_name="Nearest"/><VelComponent type="goal"/>
  </State>
  <State name="Field" final="0">
    <GoalSelector type="identity"/><VelComponent type="vel_field" file_name="field.txt"/>
  </State>
  <State name="FieldBetween" final="0">
    <VelComponent type="vel_field" file_name="field.txt" use_nearest="0"/>
    <VelModifier type="scale" scale="0.5"/>
  </State>
  <State name="Constant" final="0"><VelComponent type="const" x="0.5" y="0"/></State>
  <State name="Direction" final="0"><VelComponent type="const_dir" x="-1" y="1"/></State>
  <State name="Away" final="0">
    <Action type="teleport" dist="u" min_x="-2" max_x="2" min_y="6" max_y="8"/>
    <VelComponent type="zero"/>
  </State>
  <State name="Pause" final="1"/>

  <Transition from="Explicit,Wander" to="Weighted">
    <Condition type="timer" per_agent="1" dist="n" mean="0.5" stddev="0.1"/>
  </Transition>
  <Transition from="Weighted" to="Nearest">
    <Condition type="and">
      <Condition type="timer" per_agent="0" dist="u" min="0.3" max="0.6"/>
      <Condition type="not"><Condition type="or">
        <Condition type="circle" center_x="100" center_y="0" radius="1" inside="1"/>
        <Condition type="AABB" min_x="-50" min_y="-50" max_x="50" max_y="50" inside="0"/>
      </Condition></Condition>
    </Condition>
  </Transition>
  <Transition from="Nearest">
    <Condition type="timer" per_agent="1" dist="c" value="0.4"/>
    <Target type="prob"><State name="Farthest" weight="1"/><State name="NearMesh" weight="2"/>
      <State name="FarMesh"/></Target>
  </Transition>
  <Transition from="Farthest,NearMesh,FarMesh" to="Mirror">
    <Condition type="or">
      <Condition type="goal_reached" distance="0.5"/>
      <Condition type="timer" per_agent="1" dist="u" min="0.2" max="0.5"/>
    </Condition>
  </Transition>
  <Transition from="Mirror" to="Offset">
    <Condition type="and">
      <Condition type="timer" per_agent="1" dist="c" value="0.5"/>
      <Condition type="OBB" pivot_x="-50" pivot_y="-50" width="100" height="100" angle="0"
                 inside="1"/>
    </Condition>
  </Transition>
  <Transition from="Offset" to="OffsetConstant">
    <Condition type="timer" per_agent="1" dist="c" value="0.3"/></Transition>
  <Transition from="OffsetConstant" to="Shared">
    <Condition type="timer" per_agent="1" dist="c" value="0.3"/></Transition>
  <Transition from="Shared" to="Constant">
    <Condition type="timer" per_agent="1" dist="c" value="0.3"/></Transition>
  <Transition from="Field" to="FieldBetween">
    <Condition type="timer" per_agent="1" dist="c" value="0.5"/></Transition>
  <Transition from="FieldBetween" to="Constant">
    <Condition type="clear_AABB" relative="1" min_x="100" max_x="101" min_y="0" max_y="1"
               agent_class="2"/></Transition>
  <Transition from="Constant" to="Direction">
    <Condition type="timer" per_agent="1" dist="c" value="0.3"/></Transition>
  <Transition from="Direction" to="Away">
    <Condition type="timer" per_agent="1" dist="c" value="0.3"/></Transition>
  <Transition from="Away" to="Pause"><Condition type="auto"/></Transition>
  <Transition from="Pause">
    <Condition type="timer" per_agent="1" dist="c" value="1"/><Target type="return"/></Transition>

  <EventSystem conservative="1">
    <Target name="wanderers" type="named_state_member" state="Wander" is_member="1"/>
    <Target name="others" type="named_state_member" state="Wander" is_member="0"/>
    <Target name="first" type="agent_id" id="0"/>
    <Effect name="hurry" type="scale_agent_property" property="pref_speed" dist="c" value="1.1"/>
    <Effect name="grow" type="offset_agent_property" property="r" dist="u" min="0" max="0.01"/>
    <Effect name="turn" type="set_agent_property" property="max_angle_vel" dist="c" value="2"/>
    <Effect name="put" type="set_agent_state" reenter="1"><StateSelector type="const"
                                                                        name="Mirror"/></Effect>
    <Effect name="change" type="change_state" state="Offset" force_reentry="1"/>
    <Event name="a"><Trigger type="state_population" name="t1" state="Wander"
                             behavior="on_decrease"/>
      <Response effect="hurry" target="wanderers"/><Response effect="grow" target="others"/></Event>
    <Event name="b"><Trigger type="state_population" name="t2" state="Mirror" behavior="rise_to"
                             threshold="3"/><Response effect="put" target="first"/></Event>
    <Event name="c"><Trigger type="state_population" name="t3" state="Field" behavior="drop_to"
                             threshold="1"/><Response effect="change" target="first"/></Event>
    <Event name="d"><Trigger type="state_population" name="t4" state="Mirror"
                             behavior="while_higher" threshold="5"/>
      <Response effect="turn" target="others"/></Event>
    <Event name="e"><Trigger type="state_population" name="t5" state="Mirror"
                             behavior="while_lower" threshold="1"/>
      <Response effect="turn" target="first"/></Event>
    <Event name="f"><Trigger type="state_population" name="t6" state="Offset"
                             behavior="on_increase"/><Response effect="turn" target="first"/></Event>
    <Event name="g"><Trigger type="external" name="t7"/>
      <Response effect="turn" target="first"/></Event>
  </EventSystem>
</BFSM>)";

std::string with(std::string text, const std::string& name, const std::string& value) {
  const std::size_t at = text.find(name);
  return text.replace(at, name.size(), value);
}

void write_slope(const test::TemporaryFolder& folder) {
  std::array<std::uint8_t, 400> pixels{};
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i % 20);
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = 20;
  header.height = 20;
  header.format = PNG_FORMAT_GRAY;
  std::string bytes(8192, '\0');
  png_alloc_size_t size = bytes.size();
  ASSERT_NE(png_image_write_to_memory(&header, bytes.data(), &size, 0, pixels.data(), 0, nullptr),
            0);
  bytes.resize(size);
  folder.write("slope.png", bytes);
  folder.write("slope.ht", R"(<HeightField file_name="slope.png" cell_size="1" vert_scale="2"
    x="-10" y="-10" kernel="biweight"/>)");
}

/// The project in a folder, on this kind of ground.
Project write_project(const test::TemporaryFolder& folder, const std::string& elevation) {
  write_slope(folder);
  folder.write("room.nav", kMesh);
  folder.write("roads.txt", "4\n2 -5 0\n2 0 0\n2 5 5\n2 5 -5\n4\n0 1\n1 2\n1 3\n2 3\n");
  folder.write("field.txt", "2 2\n10\n-10 -10\n1 0\n0 1\n-1 0\n0 -1\n");
  folder.write("wedge.txt", "3\n 0 2 3\n -2 0 1\n 2 0 1\n 0 1\n");
  folder.write("scene.xml", with(kScene, "{elevation}", elevation));
  folder.write("behavior.xml", with(kBehavior, "{goals}", kGoals));
  return load_project(folder.write("project.xml", R"(<?xml version="1.0"?>
<Project scene="scene.xml" behavior="behavior.xml" view="view.xml" model="orca" output="out.scb"
         scbVersion="2.4" duration="4" timeStep="0.1" subSteps="1" random="11" dumpPath="images"/>)"));
}

std::string join_problems(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += problem.text() + "\n";
  return text;
}

class MengeVocabulary : public testing::TestWithParam<std::string> {};

TEST_P(MengeVocabulary, LoadsAndRunsWithoutComplaint) {
  for (const Compat compat : {Compat::none, Compat::menge, Compat::huang2016}) {
    const test::TemporaryFolder folder;
    Project project =
        write_project(folder, compat == Compat::none ? "height_field\" file_name=\"slope.ht"
                                                     : "nav_mesh\" file_name=\"room.nav");
    EXPECT_EQ(join_problems(project.warnings), "");
    project.options.compat = compat;
    project.options.model = GetParam();
    Simulation crowd = load_simulation(project);
    EXPECT_EQ(join_problems(crowd.warnings()), "");
    EXPECT_GE(crowd.agent_count(), 22U) << "hexagonal rows are completed";
    std::vector<bool> visited(crowd.state_names().size());
    while (crowd.time_s() < project.duration_s) {
      crowd.step();
      for (const std::uint8_t state : crowd.states()) visited[state] = true;
    }
    crowd.fire("t7");
    crowd.step();
    for (const Eigen::Vector2f& p : crowd.positions()) EXPECT_TRUE(p.allFinite());
    EXPECT_GE(std::count(visited.begin(), visited.end(), true), 15) << "of 17 states";
  }
}

std::vector<std::string> model_names() {
  std::vector<std::string> names;
  for (const ModelEntry& model : models()) names.emplace_back(model.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Models, MengeVocabulary, testing::ValuesIn(model_names()),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace throng::crowd
