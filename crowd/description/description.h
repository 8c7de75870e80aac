// The description of a simulation: a scene (Menge's <Experiment>: profiles, groups, obstacles) and
// a behavior (<BFSM>: goals, states, transitions), each as a value. builder.h creates descriptions
// in code; menge_files/ reads and writes them.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "crowd/description/node.h"

namespace throng::crowd {

/// An XML document of Menge with the files that it names.
struct Description {
  Node root;
  std::string name;  ///< name of the file, or "scene" or "behavior"; used in messages
  std::filesystem::path folder = {};   ///< base of relative file names in attributes
  std::vector<Problem> warnings = {};  ///< warnings of the reader
  /// Content of text files that attributes name and that exist only in memory: road maps, vector
  /// fields, formations, navigation meshes. Used instead of files of the folder with the same name.
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
