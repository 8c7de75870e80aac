#include "annotate/people_sheet/sheet_shots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "skinning/animate/motion.h"

namespace throng::annotate {

namespace {

using render::PersonInstance;
using skinning::ClipSet;
using skinning::Population;

// The sun stands behind the viewer's left shoulder.
const double kHeading = render::Environment{}.sun_azimuth_rad + std::numbers::pi - 0.7;

// Looks at `target` from `distance_m` away; `px_per_m` there.
camera::Camera camera_on(const Eigen::Vector3d& target, double distance_m, double pitch_rad,
                         double px_per_m, int width, int height) {
  const Eigen::Vector3d ahead(std::cos(kHeading) * std::cos(pitch_rad),
                              std::sin(kHeading) * std::cos(pitch_rad), std::sin(pitch_rad));
  const double focal_px = px_per_m * distance_m;
  return {{width, height, focal_px, focal_px, 0.5 * (width - 1), 0.5 * (height - 1)},
          camera::pose_looking(target - distance_m * ahead, kHeading, pitch_rad)};
}

// From far away, so that there is next to no perspective.
camera::Camera portrait_camera(int width, int height) {
  constexpr double kShownM = 2.15;
  constexpr double kFarM = 20;
  return camera_on({0, 0, 0.98}, kFarM, -8 * kDegree, height / kShownM, width, height);
}

// How far somebody who faces the viewer is turned to show this side.
PersonInstance posed(const skinning::Appearance& look, const skinning::PoseBlend& pose,
                     double turn_rad) {
  PersonInstance person;
  person.appearance = look;
  person.yaw_rad = static_cast<float>(kHeading + std::numbers::pi + turn_rad);
  person.pose = pose;
  return person;
}

// A moment of somebody's motion.
struct Moment {
  const char* clip;
  double speed_mps = 0;
  double share = 0;  ///< of the clip
};

skinning::PoseBlend choose_pose(const Population& population, std::uint32_t character,
                                const Moment& moment) {
  const double stature_m = population.characters[character].stature_m;
  const double stride =
      moment.speed_mps > 0 ? skinning::stride_length_m(moment.speed_mps, stature_m) / stature_m : 0;
  const skinning::Clip& clip = ClipSet(population).nearest(moment.clip, stride);
  return skinning::blend_frame(clip, moment.share * (clip.cyclic ? clip.frames : clip.frames - 1));
}

constexpr std::size_t kLevelColumns = 16;

constexpr double kSide = 90 * kDegree;

std::string make_caption(const skinning::Character& who) {
  return fmt::format("{}, {}, {:.2f} m", who.name, static_cast<int>(who.age_years), who.stature_m);
}

Moment moment_of_passer_by(Random& random) {
  const double share = random.uniform();
  const double speed_mps = std::clamp(random.normal(1.3, 0.22), 0.6, 1.9);
  const double draw = random.uniform();
  if (draw < 0.05) return {"phone", 0, 0.5 + 0.5 * share};
  if (draw < 0.13) return {"idle", 0, share};
  if (draw < 0.17) return {"idle_left", 0, share};
  if (draw < 0.21) return {"run", random.uniform(2.4, 3.6), share};
  return {"walk", speed_mps, share};
}

double share_of_umbrellas(const Population& population,
                          const std::vector<std::uint32_t>& characters) {
  const auto carriers =
      std::count_if(characters.begin(), characters.end(), [&](std::uint32_t character) {
        return population.characters[character].carries == skinning::Carry::umbrella;
      });
  return static_cast<double>(carriers) / static_cast<double>(characters.size());
}

// People on a grid that is shaken: two streams that meet, and some who stand.
std::vector<PersonInstance> place_crowd(const Population& population, const SheetOptions& options,
                                        double half_m) {
  constexpr double kApartM = 2.5;
  const auto count = static_cast<int>(std::ceil(half_m / kApartM));
  std::vector<PersonInstance> people;
  skinning::Styling styling;
  styling.umbrellas = share_of_umbrellas(population, options.crowd);
  std::uint32_t candidate = 0;
  for (int row = -count; row <= count; ++row) {
    for (int column = -count; column <= count; ++column) {
      Random random(options.seed, Stream::environment, people.size());
      PersonInstance person;
      do {
        person.appearance =
            skinning::sample_appearance(population, options.seed, candidate++, styling);
      } while (std::find(options.crowd.begin(), options.crowd.end(), person.appearance.character) ==
               options.crowd.end());
      person.agent = static_cast<std::uint32_t>(people.size());
      person.position = {static_cast<float>(kApartM * (row + random.uniform(-0.38, 0.38))),
                         static_cast<float>(kApartM * (column + random.uniform(-0.38, 0.38))), 0};
      const double stream = random.uniform() < 0.5 ? 0.3 : 0.3 + std::numbers::pi;
      person.yaw_rad = static_cast<float>(stream + random.normal(0, 0.35));
      person.pose =
          choose_pose(population, person.appearance.character, moment_of_passer_by(random));
      people.push_back(person);
    }
  }
  return people;
}

SheetShot motion_shot(const Population& population, const skinning::Appearance& look,
                      const Moment& moment, double turn_rad, const std::string& label, int width) {
  return {label,
          portrait_camera(width, width * 3 / 2),
          {posed(look, choose_pose(population, look.character, moment), turn_rad)}};
}

}  // namespace

std::vector<SheetRow> portrait_rows(const Population& population, const SheetOptions& options) {
  const std::size_t columns = options.portraits.size() <= 24 ? 8 : 12;
  const int width = options.width_px / static_cast<int>(2 * columns);
  std::vector<SheetRow> rows;
  for (std::size_t i = 0; i < options.portraits.size(); ++i) {
    if (i % columns == 0) {
      rows.push_back({i == 0 ? "From the front and from the side" : "", {}});
    }
    const std::uint32_t character = options.portraits[i];
    const skinning::Appearance look = skinning::appearance_as(population, character, options.seed);
    const double share = static_cast<double>(look.phase_offset);
    const auto standing = choose_pose(population, character, {"idle", 0, share});
    const auto walking = choose_pose(population, character, {"walk", 1.35, share});
    const camera::Camera camera = portrait_camera(width, 2 * width);
    rows.back().shots.push_back(
        {make_caption(population.characters[character]), camera, {posed(look, standing, 0)}});
    rows.back().shots.push_back({"", camera, {posed(look, walking, kSide)}});
  }
  return rows;
}

std::vector<SheetRow> act_rows(const Population& population, const SheetOptions& options) {
  constexpr std::size_t kColumns = 10;
  constexpr double kTurn = 35 * kDegree;
  const int width = options.width_px / static_cast<int>(kColumns);
  std::vector<SheetRow> rows;
  std::size_t shots = 0;
  for (const skinning::Clip& clip : population.clips) {
    const bool sits = clip.name.starts_with("sit");
    if (!sits && !clip.name.starts_with("act_")) continue;
    if (shots % kColumns == 0) rows.push_back({shots == 0 ? "On the spot" : "", {}});
    const std::uint32_t character = options.portraits[shots % options.portraits.size()];
    const skinning::Appearance look = skinning::appearance_as(population, character, options.seed);
    const Moment moment{clip.name.c_str(), 0, sits ? 0.4 : 0.65};
    const std::string label = sits ? clip.name : clip.name.substr(4);
    rows.back().shots.push_back(motion_shot(population, look, moment, kTurn, label, width));
    ++shots;
  }
  return rows;
}

SheetRow drone_row(const Population& population, const SheetOptions& options) {
  constexpr std::array<double, 3> kHeightsM = {15, 30, 50};
  // The image is the middle of that of a camera with 1920 pixels across 78 degrees.
  constexpr double kFocalPx = 1185.5;
  const int width = options.width_px / static_cast<int>(kHeightsM.size());
  const int height = width * 3 / 4;
  SheetRow row{"From drones that look down by 45 degrees (1920 pixels across 78 degrees)", {}};
  for (const double height_m : kHeightsM) {
    const double distance_m = height_m * std::numbers::sqrt2;
    const double half_m = 0.62 * width * distance_m / kFocalPx + 3;
    row.shots.push_back(
        {fmt::format("{:.0f} m high", height_m),
         camera_on({0, 0, 0}, distance_m, -45 * kDegree, kFocalPx / distance_m, width, height),
         place_crowd(population, options, half_m)});
  }
  return row;
}

std::vector<SheetRow> motion_rows(const Population& population, const SheetOptions& options) {
  struct Way {
    const char* name;
    const char* clip;
    double speed_mps;
  };
  constexpr std::array<Way, 6> kWays = {{{"slow walk", "walk", 0.6},
                                         {"walk", "walk", 1.35},
                                         {"fast walk", "walk", 1.9},
                                         {"jog", "run", 2.6},
                                         {"run", "run", 4.0},
                                         {"panic", "panic", 3.4}}};
  constexpr int kPhases = 8;
  const int width = options.width_px / (2 * kPhases);
  const skinning::Appearance look =
      skinning::appearance_as(population, options.portraits.front(), options.seed);
  std::vector<SheetRow> rows;
  for (std::size_t way = 0; way < kWays.size(); ++way) {
    if (way % 2 == 0) rows.push_back({way == 0 ? "Gaits, in eighths of a stride" : "", {}});
    const Way& shown = kWays[way];
    for (int phase = 0; phase < kPhases; ++phase) {
      const Moment moment{shown.clip, shown.speed_mps, static_cast<double>(phase) / kPhases};
      const std::string label =
          phase == 0 ? fmt::format("{} {:g} m/s", shown.name, shown.speed_mps) : "";
      rows.back().shots.push_back(motion_shot(population, look, moment, kSide, label, width));
    }
  }
  constexpr std::array<Moment, 15> kPoses = {{{"idle", 0, 0.95},
                                              {"idle_left", 0, 0.4},
                                              {"phone", 0, 1},
                                              {"look_up", 0, 1},
                                              {"look_up_left", 0, 1},
                                              {"walk_look_up", 1.2, 0.25},
                                              {"turn_90", 0, 0.3},
                                              {"turn_90", 0, 0.7},
                                              {"fall_forwards", 0, 0.3},
                                              {"fall_forwards", 0, 0.6},
                                              {"fall_forwards", 0, 1},
                                              {"fall_backwards", 0, 0.3},
                                              {"fall_backwards", 0, 0.6},
                                              {"fall_backwards", 0, 1},
                                              {"panic", 4.5, 0.4}}};
  rows.push_back({"Standing, turning, falling", {}});
  for (const Moment& moment : kPoses) {
    rows.back().shots.push_back(
        motion_shot(population, look, moment, 35 * kDegree, moment.clip, width));
  }
  return rows;
}

LevelsApart levels_apart(const Population& population, const SheetOptions& options) {
  LevelsApart apart;
  Population& copy = apart.population;
  copy.texture_size = population.texture_size;
  copy.clips = population.clips;
  copy.palettes_per_character = population.palettes_per_character;
  std::map<std::int32_t, std::int32_t> layers;
  for (const std::uint32_t who : options.portraits) {
    const skinning::Character& character = population.characters[who];
    if (copy.characters.size() + character.levels.size() > kLevelColumns) break;
    for (std::size_t level = 0; level < character.levels.size(); ++level) {
      skinning::Mesh mesh = character.levels[level];
      for (skinning::Part& part : mesh.parts) {
        for (std::int32_t* used : {&part.texture, &part.shades}) {
          if (*used < 0) continue;
          const auto [layer, is_new] =
              layers.try_emplace(*used, static_cast<std::int32_t>(copy.textures.size()));
          if (is_new) copy.textures.push_back(population.textures[static_cast<std::size_t>(*used)]);
          *used = layer->second;
        }
      }
      apart.labels.push_back(fmt::format("level {}: {}", level, mesh.indices.size() / 3));
      skinning::Character& single = copy.characters.emplace_back();
      single.name = character.name;
      single.stature_m = character.stature_m;
      single.tints = character.tints;
      single.levels.push_back(std::move(mesh));
      for (std::uint32_t palette = 0; palette < population.palettes_per_character; ++palette) {
        copy.palettes.push_back(population.palette(who, palette));
      }
    }
  }
  return apart;
}

std::vector<SheetRow> level_rows(const LevelsApart& apart, const SheetOptions& options) {
  const Population& population = apart.population;
  const int width = options.width_px / static_cast<int>(kLevelColumns);
  std::vector<SheetRow> rows;
  skinning::Appearance look;
  for (std::uint32_t i = 0; i < population.characters.size(); ++i) {
    if (i % kLevelColumns == 0) {
      rows.push_back({i == 0 ? "Levels of detail and their triangles, all drawn large" : "", {}});
    }
    // All levels of a person wear one set of colors.
    const bool next = i == 0 || population.characters[i].name != population.characters[i - 1].name;
    if (next) {
      look = skinning::appearance_as(population, i, options.seed);
      for (std::size_t tint = 0; tint < skinning::kTintCount; ++tint) {
        const auto& colors = population.characters[i].tints[tint];
        if (!colors.empty()) look.tint[tint] = colors[options.seed % colors.size()];
      }
    }
    look.character = i;
    rows.back().shots.push_back(
        motion_shot(population, look, {"walk", 1.35, 0.1}, 35 * kDegree, apart.labels[i], width));
  }
  return rows;
}

}  // namespace throng::annotate
