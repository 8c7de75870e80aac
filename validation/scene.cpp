#include "validation/scene.h"

#include <fmt/core.h>
#include <stdlib.h>  // mkdtemp

#include <cerrno>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "base/files.h"

namespace throng::validation {

namespace fs = std::filesystem;
using Eigen::Vector2d;

namespace {

/// A folder of its own, removed at the end.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "throng_scene_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
      throw EnvironmentError(fmt::format("cannot make a folder {}: {}", pattern,
                                         std::system_category().message(errno)));
    }
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  fs::path write(const std::string& name, const std::string& text) const {
    write_file_atomically(path_ / name, text);
    return path_ / name;
  }

 private:
  fs::path path_;
};

std::string obstacles(const std::vector<Polygon>& walls, int obstacle_class) {
  if (walls.empty()) return "";
  std::string text = fmt::format(R"(<ObstacleSet type="explicit" class="{}">)", obstacle_class);
  for (const Polygon& wall : walls) {
    text += R"(<Obstacle closed="1">)";
    for (const Vector2d& corner : wall) {
      text += fmt::format(R"(<Vertex p_x="{}" p_y="{}"/>)", corner.x(), corner.y());
    }
    text += "</Obstacle>";
  }
  return text + "</ObstacleSet>\n";
}

std::string profile(const Group& group, std::size_t number, const Tested& tested) {
  return fmt::format(
      R"(<AgentProfile name="p{}"><Common r="{}" max_accel="5" max_speed="2.5" obstacleSet="1" class="{}">
<Property name="pref_speed" {}/></Common>{}</AgentProfile>
)",
      number, group.radius_m, number, group.speed, tested.profile);
}

std::string people(const Group& group, std::size_t number) {
  std::string text = fmt::format(
      R"(<AgentGroup><ProfileSelector type="const" name="p{}"/><StateSelector type="const" name="{}"/>
<Generator type="explicit" displace_dist="u" displace_min="0" displace_max="{}">)",
      number, group.state, group.aside_m);
  for (const Vector2d& place : group.places) {
    text += fmt::format(R"(<Agent p_x="{}" p_y="{}"/>)", place.x(), place.y());
  }
  return text + "</Generator>" + group.more + "</AgentGroup>\n";
}

std::string experiment(const Scene& scene, const Tested& tested) {
  std::string text = fmt::format(
      R"(<Experiment version="2.0"><SpatialQuery type="kd-tree"/><Common time_step="{}"/>
)",
      scene.dt_s);
  text += tested.constants;
  for (std::size_t i = 0; i < scene.groups.size(); ++i) text += profile(scene.groups[i], i, tested);
  for (std::size_t i = 0; i < scene.groups.size(); ++i) text += people(scene.groups[i], i);
  return text + obstacles(scene.walls, 1) + obstacles(scene.later_walls, 2) + "</Experiment>\n";
}

bool is_by_velocity(const std::string& model) {
  return model == "orca" || model == "weidmann" || model == "ttc" || model == "pedvo" ||
         model == "dummy";
}

}  // namespace

Polygon box(double min_x, double min_y, double max_x, double max_y) {
  return {{min_x, min_y}, {max_x, min_y}, {max_x, max_y}, {min_x, max_y}};
}

std::vector<Vector2d> lattice(const Vector2d& low, const Vector2d& high, std::size_t count) {
  const Vector2d size = high - low;
  const double spacing = std::sqrt(size.x() * size.y() / static_cast<double>(count));
  const auto rows = static_cast<std::size_t>(std::max(1.0, std::round(size.y() / spacing)));
  const std::size_t columns = (count + rows - 1) / rows;
  const Vector2d step(size.x() / static_cast<double>(columns),
                      size.y() / static_cast<double>(rows));
  std::vector<Vector2d> places;
  places.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t column = i / rows;
    const std::size_t row = i % rows;
    const Vector2d cell(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
    places.emplace_back(low + cell.cwiseProduct(step));
  }
  return places;
}

std::string walk_to(int goal_set, const std::string& state) {
  return fmt::format(
      R"(<State name="{}" final="0"><GoalSelector type="nearest" goal_set="{}"/><VelComponent type="auto"/></State>
)",
      state, goal_set);
}

std::string goal_box(int goal_set, double min_x, double min_y, double max_x, double max_y) {
  return fmt::format(
      R"(<GoalSet id="{}"><Goal id="0" type="AABB" min_x="{}" min_y="{}" max_x="{}" max_y="{}"/></GoalSet>
)",
      goal_set, min_x, min_y, max_x, max_y);
}

std::string leave_at_goal(const std::string& state) {
  return fmt::format(
      R"(<State name="Gone" final="1"><Action type="leave"/></State>
<Transition from="{}" to="Gone"><Condition type="goal_reached" distance="0"/></Transition>
)",
      state);
}

crowd::Simulation load(const Scene& scene, const Tested& tested, std::uint64_t seed) {
  const Folder folder;
  for (const auto& [name, text] : scene.files) folder.write(name, text);
  crowd::LoadOptions options;
  options.seed = seed;
  options.model = tested.model;
  options.sub_steps = is_by_velocity(tested.model) ? 0 : 4;
  return {folder.write("scene.xml", experiment(scene, tested)),
          folder.write("behavior.xml", "<BFSM>\n" + scene.behavior + "</BFSM>\n"), options};
}

}  // namespace throng::validation
