// The description of a simulation: a scene (Menge's <Experiment>: profiles, groups, obstacles) and
// a behavior (<BFSM>: goals, states, transitions), each as a value. builder.h builds them in code,
// menge_files/ reads and writes them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "crowd/description/node.h"

namespace throng::crowd {

struct Description {
  Node root;
  std::string name;                    ///< for messages: the file's name, or what was built
  std::filesystem::path folder = {};   ///< what the files that attributes name are relative to
  std::vector<Problem> warnings = {};  ///< from reading the file
  /// Text files that attributes name and that are on no disk: road maps, vector fields, formations,
  /// navigation meshes. They come before files of the folder.
  std::map<std::string, std::string> files = {};
};

struct SceneDescription : Description {
  SceneDescription() : Description{Node("Experiment", {{"version", "2.0"}}), "scene"} {}
  explicit SceneDescription(Description read) : Description(std::move(read)) {}
};

struct BehaviorDescription : Description {
  BehaviorDescription() : Description{Node("BFSM"), "behavior"} {}
  explicit BehaviorDescription(Description read) : Description(std::move(read)) {}
};

struct CrowdDescription {
  SceneDescription scene;
  BehaviorDescription behavior;
};

}  // namespace throng::crowd
