#include "world/scenario_crowd.h"

#include "base/error.h"
#include "crowd/description/menge_files/read.h"

namespace throng::world {

crowd::CrowdDescription build_crowd(const Scenario& scenario) {
  if (!scenario.has_crowd()) {
    throw InputError({scenario.id, "/crowd", "nothing: only recorded people can be in it",
                      "the scene and behavior of a crowd to simulate"});
  }
  if (scenario.built_crowd) return *scenario.built_crowd;
  return {crowd::read_scene(scenario.scene_file), crowd::read_behavior(scenario.behavior_file)};
}

}  // namespace throng::world
