// Any project, trajectory or resource file. The first line of an input names the kind; the rest is
// the file. Resources are used by a small crowd for a few steps.
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>

#include "crowd/output/scb.h"
#include "crowd/project/project.h"
#include "tests/fuzz/fuzz_folder.h"
#include "tests/fuzz/fuzz_steps.h"

namespace throng::crowd::fuzz {
namespace {

constexpr const char* kScene = R"(<Experiment version="2.0">
  {spatial}
  <Common time_step="0.1"/>
  {elevation}
  <AgentProfile name="a"><Common class="1"/></AgentProfile>
  <AgentGroup>
    <ProfileSelector type="const" name="a"/>
    <StateSelector type="const" name="Walk"/>
    <Generator type="explicit"><Agent p_x="0" p_y="0"/><Agent p_x="1" p_y="0.5"/></Generator>
  </AgentGroup>
  {obstacles}
</Experiment>)";

constexpr const char* kBehavior = R"(<BFSM>
  <GoalSet id="0"><Goal type="point" id="0" x="5" y="5"/><Goal type="circle" id="1" x="-3" y="2" radius="1"/></GoalSet>
  {modifier}
  <State name="Walk" final="0">{selector}{velocity}</State>
</BFSM>)";

constexpr const char* kNearest = R"(<GoalSelector type="nearest" goal_set="0"/>)";
constexpr const char* kKdTree = R"(<SpatialQuery type="kd-tree"/>)";
constexpr const char* kToGoal = R"(<VelComponent type="goal"/>)";

/// Elements of the scene and the behavior that name a kind of resource.
using Elements = std::map<std::string, std::string>;

std::string filled(std::string text, const Elements& elements, const Elements& otherwise) {
  for (const auto& [name, standard] : otherwise) {
    const auto given = elements.find(name);
    const std::string& with = given != elements.end() ? given->second : standard;
    const std::size_t at = text.find("{" + name + "}");
    if (at != std::string::npos) text.replace(at, name.size() + 2, with);
  }
  return text;
}

void use_resource(const Folder& folder, const Elements& elements) {
  const Elements standard = {{"spatial", kKdTree}, {"elevation", ""},      {"obstacles", ""},
                             {"modifier", ""},     {"selector", kNearest}, {"velocity", kToGoal}};
  load_and_step(folder.write("scene.xml", filled(kScene, elements, standard)),
                folder.write("behavior.xml", filled(kBehavior, elements, standard)), {});
}

const std::map<std::string_view, Elements>& resources() {
  static const std::map<std::string_view, Elements> kResources = {
      {"road_map", {{"velocity", R"(<VelComponent type="road_map" file_name="resource"/>)"}}},
      {"vel_field", {{"velocity", R"(<VelComponent type="vel_field" file_name="resource"/>)"}}},
      {"smooth_field",
       {{"velocity", R"(<VelComponent type="vel_field" file_name="resource" use_nearest="0"/>)"}}},
      {"nav_mesh",
       {{"spatial", R"(<SpatialQuery type="nav_mesh" file_name="resource"/>)"},
        {"elevation", R"(<Elevation type="nav_mesh" file_name="resource"/>)"},
        {"obstacles", R"(<ObstacleSet type="nav_mesh" file_name="resource" class="1"/>)"},
        {"selector",
         R"(<GoalSelector type="nearest_nav_mesh" goal_set="0" file_name="resource"/>)"},
        {"velocity", R"(<VelComponent type="nav_mesh" file_name="resource"/>)"}}},
      {"formation", {{"modifier", R"(<VelModifier type="formation" file_name="resource"/>)"}}},
      {"height_field",
       {{"elevation", R"(<Elevation type="height_field" file_name="resource"/>)"},
        {"modifier", R"(<VelModifier type="height_field" file_name="resource"/>)"}}},
  };
  return kResources;
}

/// A gray image of 3 by 2 pixels.
constexpr std::array<unsigned char, 73> kHills = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
    0x52, 0x00, 0x00, 0x00, 0x03, 0x00, 0x00, 0x00, 0x02, 0x08, 0x00, 0x00, 0x00, 0x00, 0xb8,
    0x1f, 0x39, 0xc6, 0x00, 0x00, 0x00, 0x10, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x10,
    0x68, 0xf8, 0xc0, 0xe0, 0xa0, 0xf0, 0x1f, 0x00, 0x0a, 0x27, 0x02, 0xe0, 0x0e, 0x08, 0x82,
    0x79, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};

constexpr const char* kHillsXml = R"(<HeightField file_name="hills.png" cell_size="1" vert_scale="2"
  x="-4" y="-4" kernel="1"/>)";

void read_scb(const std::filesystem::path& path) {
  ScbReader reader(path);
  constexpr std::size_t kMaxFrames = 4;
  for (std::size_t i = 0; i < std::min(reader.frame_count(), kMaxFrames); ++i) reader.frame(i);
}

}  // namespace
}  // namespace throng::crowd::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace throng::crowd;
  static const fuzz::Folder folder;
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::size_t line = input.find('\n');
  if (line == std::string_view::npos) return 0;
  const std::string_view kind = input.substr(0, line);
  const bool is_image = kind == "image";
  const std::string_view rest = input.substr(line + 1);
  folder.write("hills.png",
               is_image ? rest
                        : std::string_view(reinterpret_cast<const char*>(fuzz::kHills.data()),
                                           fuzz::kHills.size()));
  const auto file = folder.write("resource", is_image ? fuzz::kHillsXml : rest);
  try {
    if (kind == "project") load_project(file);
    if (kind == "scb") fuzz::read_scb(file);
  } catch (const throng::InputError&) {
  } catch (const throng::EnvironmentError&) {
  }
  const auto known = fuzz::resources().find(is_image ? "height_field" : kind);
  if (known != fuzz::resources().end()) fuzz::use_resource(folder, known->second);
  return 0;
}
