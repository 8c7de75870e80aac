#include "sim/planning/guidance_check.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "base/text/suggest.h"

namespace throng::sim {

namespace {

struct GuidanceField {
  GuidanceFields bit;
  std::string_view name;      // in the job
  std::string_view expected;  // of a policy that needs it
  bool (*given)(const DroneMission&);
};

constexpr std::array kFields{
    GuidanceField{kFieldWaypoints, "waypoints", "at least one point",
                  [](const DroneMission& m) { return !m.waypoints.empty(); }},
    GuidanceField{kFieldCenter, "center", "a point [x, y]",
                  [](const DroneMission& m) { return m.guidance.center.has_value(); }},
    GuidanceField{kFieldRadius, "radius_m", "a radius",
                  [](const DroneMission& m) { return m.guidance.radius_m.has_value(); }},
    GuidanceField{kFieldArea, "area", "an area",
                  [](const DroneMission& m) { return m.guidance.area.has_value(); }},
    GuidanceField{kFieldOverlap, "overlap", "a share",
                  [](const DroneMission& m) { return m.guidance.overlap.has_value(); }},
    GuidanceField{kFieldExits, "exits", "ids of exits",
                  [](const DroneMission& m) { return !m.guidance.exits.empty(); }},
    GuidanceField{kFieldSetpoints, "setpoints", "at least one set-point",
                  [](const DroneMission& m) { return !m.guidance.setpoints.empty(); }},
    GuidanceField{kFieldLeadSpeed, "lead_speed_mps", "a speed",
                  [](const DroneMission& m) { return m.guidance.lead_speed_mps.has_value(); }},
    GuidanceField{kFieldBatch, "batch", "a number of people",
                  [](const DroneMission& m) { return m.guidance.batch.has_value(); }},
    GuidanceField{kFieldPerception, "perception", "its observations",
                  [](const DroneMission& m) { return m.guidance.perception.has_value(); }},
    GuidanceField{kFieldBeacon, "beacon", "true or false",
                  [](const DroneMission& m) { return m.guidance.beacon.has_value(); }},
};

void check_exits(const DroneMission& mission, const world::Scenario& scenario,
                 const std::string& pointer, std::vector<Problem>& problems) {
  for (std::size_t i = 0; i < mission.guidance.exits.size(); ++i) {
    const std::string& id = mission.guidance.exits[i];
    const auto known = std::find_if(scenario.exits.begin(), scenario.exits.end(),
                                    [&](const world::Exit& exit) { return exit.id == id; });
    const std::string where = fmt::format("{}/exits/{}", pointer, i);
    if (known == scenario.exits.end()) {
      std::vector<std::string_view> ids;
      for (const world::Exit& exit : scenario.exits) ids.push_back(exit.id);
      problems.push_back(unknown_name("", where, "exit", id, ids));
    } else if (!known->open) {
      problems.push_back({"", where, fmt::format("\"{}\", which is closed", id), "an open exit"});
    }
  }
}

void check_setpoints(const DroneMission& mission, const std::string& pointer,
                     std::vector<Problem>& problems) {
  const std::vector<PilotSample>& samples = mission.guidance.setpoints;
  for (std::size_t i = 0; mission.camera.gimbal.is_rigid() && i < samples.size(); ++i) {
    if (!samples[i].gimbal) continue;
    problems.push_back({"", fmt::format("{}/setpoints/{}/6", pointer, i),
                        "a direction of the gimbal",
                        "none, since the camera's gimbal.model is rigid"});
    break;
  }
  for (std::size_t i = 1; i < samples.size(); ++i) {
    if (samples[i].time_s > samples[i - 1].time_s) continue;
    problems.push_back(
        {"", fmt::format("{}/setpoints/{}/0", pointer, i),
         fmt::format("{:g} s after {:g} s", samples[i].time_s, samples[i - 1].time_s),
         "a later time than that of the set-point before"});
    return;
  }
}

}  // namespace

void check_guidance(const PolicyEntry& policy, const DroneMission& mission,
                    const world::Scenario& scenario, const std::string& pointer,
                    std::vector<Problem>& problems) {
  for (const GuidanceField& field : kFields) {
    const std::string where = fmt::format("{}/{}", pointer, field.name);
    if ((policy.needs & field.bit) != 0 && !field.given(mission)) {
      problems.push_back({"", where, "none",
                          fmt::format("{} for the policy \"{}\"", field.expected, policy.name)});
    } else if (((policy.needs | policy.takes) & field.bit) == 0 && field.given(mission)) {
      problems.push_back(
          {"", where, "a value",
           fmt::format("none, since the policy \"{}\" has no use for it", policy.name)});
    }
  }
  check_exits(mission, scenario, pointer, problems);
  check_setpoints(mission, pointer, problems);
}

}  // namespace throng::sim
