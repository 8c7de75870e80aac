#include "validation/experiments/archive.h"

#include <fmt/core.h>

#include <algorithm>
#include <regex>
#include <string>

namespace throng::validation {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;

namespace {

constexpr double kCmM = 0.01;
/// Free speeds of the participants of Hermes; those of the others were not published.
constexpr FreeSpeeds kHermesSpeeds{1.55, 0.18};

Experiment hermes_corridor(const std::filesystem::path& file, double width_m, double exit_m) {
  exit_m = std::min(exit_m, width_m);
  const double left = (width_m - exit_m) / 2;
  const double right = left + exit_m;
  Recording recording;
  recording.file = file;
  recording.format.frames_per_s = 16;
  recording.format.unit_m = kCmM;
  // People wait in a wider place before the corridor (y > 4), and leave into another one.
  recording.walkable = {{width_m + 1, -8},
                        {width_m + 1, -4.5},
                        {right, -4.5},
                        {right, -4.1},
                        {width_m, -4.1},
                        {width_m, 4},
                        {width_m + 1, 4},
                        {width_m + 1, 9},
                        {-1, 9},
                        {-1, 4},
                        {0, 4},
                        {0, -4.1},
                        {left, -4.1},
                        {left, -4.5},
                        {-1, -4.5},
                        {-1, -8}};
  if (exit_m >= width_m) {
    recording.walkable = {{width_m + 1, -8}, {width_m + 1, -4}, {width_m, -4},
                          {width_m, 4},      {width_m + 1, 4},  {width_m + 1, 9},
                          {-1, 9},           {-1, 4},           {0, 4},
                          {0, -4},           {-1, -4},          {-1, -8}};
  }
  recording.goals = {AlignedBox2d(Vector2d(-0.8, -7.5), Vector2d(width_m + 0.8, -6.2))};
  recording.area = AlignedBox2d(Vector2d(0, -2), Vector2d(width_m, 0));
  recording.line = {{left, -4.3}, {right, -4.3}};
  return {"", kHermesSpeeds, std::move(recording), {}, {}};
}

Experiment bottleneck(const std::filesystem::path& file, double corridor_m) {
  constexpr double kHalfOpeningM = 0.25;
  constexpr double kDepthM = 1.1;
  const double side = corridor_m / 2;
  Recording recording;
  recording.file = file;
  // The corners of the barriers at the opening are cut off by 0.15 m.
  recording.walkable = {{side + 0.7, -5},
                        {side + 0.7, -0.3},
                        {0.7, -0.3},
                        {0.7, -kDepthM},
                        {kHalfOpeningM, -kDepthM},
                        {kHalfOpeningM, -0.15},
                        {0.4, 0},
                        {side, 0},
                        {side, 12},
                        {-side, 12},
                        {-side, 0},
                        {-0.4, 0},
                        {-kHalfOpeningM, -0.15},
                        {-kHalfOpeningM, -kDepthM},
                        {-0.7, -kDepthM},
                        {-0.7, -0.3},
                        {-side - 0.7, -0.3},
                        {-side - 0.7, -5}};
  recording.goals = {AlignedBox2d(Vector2d(-side, -4.7), Vector2d(side, -2.2))};
  recording.area = AlignedBox2d(Vector2d(-0.4, 0.5), Vector2d(0.4, 1.3));
  recording.line = {{-kHalfOpeningM, 0}, {kHalfOpeningM, 0}};
  return {"", kHermesSpeeds, std::move(recording), {}, {}};
}

Experiment long_corridor(const std::filesystem::path& file, double width_m) {
  constexpr double kFarM = 9;
  Recording recording;
  recording.file = file;
  recording.walkable = {{-kFarM, 0}, {kFarM, 0}, {kFarM, width_m}, {-kFarM, width_m}};
  recording.goals = {AlignedBox2d(Vector2d(6.5, 0.3), Vector2d(8.5, width_m - 0.3)),
                     AlignedBox2d(Vector2d(-8.5, 0.3), Vector2d(-6.5, width_m - 0.3))};
  recording.area = AlignedBox2d(Vector2d(-2, 0), Vector2d(1, width_m));
  recording.line = {{-0.5, 0}, {-0.5, width_m}};
  return {"", kHermesSpeeds, std::move(recording), {}, {}};
}

Experiment closed_corridor(const std::filesystem::path& file, std::size_t people) {
  SingleFile single;
  single.file = file;
  single.format.frames_per_s = 25;
  single.people = people;
  return {"", kHermesSpeeds, {}, {}, std::move(single)};
}

/// The name of a file without its suffixes: "a.b.txt.gz" has the stem "a.b".
std::string stem(std::filesystem::path file) {
  const std::string ending = file.extension().string();
  if (ending == ".gz" || ending == ".GZ") file = file.stem();
  return file.stem().string();
}

}  // namespace

std::optional<Experiment> archived_experiment(const std::filesystem::path& file) {
  const std::string name = stem(file);
  // Some are published in capitals, too.
  constexpr auto kAnyCase = std::regex::ECMAScript | std::regex::icase;
  std::smatch found;
  std::optional<Experiment> experiment;
  const auto number = [&](std::size_t group) { return std::stod(found[group]); };
  // Numbers are above 0, so that there is room for the people.
  if (std::regex_match(
          name, found,
          std::regex(R"(uo-(?!000)(\d{3})-(?!000)(\d{3})-(?!000)(\d{3}))", kAnyCase))) {
    experiment = hermes_corridor(file, kCmM * number(2), kCmM * number(3));
  } else if (std::regex_match(name, found,
                              std::regex(R"(\d{3}_[a-z]_(?!0[0-5])(\d{2})_h[-0+])", kAnyCase))) {
    experiment = bottleneck(file, number(1) / 10);
  } else if (std::regex_match(
                 name, found,
                 std::regex(R"((?:traj_)?(?:bi|uni)_corr_(?!0)(\d{3})_.*)", kAnyCase))) {
    experiment = long_corridor(file, kCmM * number(1));
  } else if (std::regex_match(
                 name, found,
                 std::regex(R"((?:single_file|\d+)_n([1-9]\d{0,3})(?:_.*)?)", kAnyCase))) {
    experiment = closed_corridor(file, static_cast<std::size_t>(number(1)));
  }
  if (experiment) experiment->name = name;
  return experiment;
}

Experiment hermes_diagram() {
  Loop loop;
  loop.recorded = {{0.4, 1.39}, {0.6, 1.39}, {1.1, 1.14}, {1.6, 0.99}, {1.9, 0.81},
                   {2.1, 0.62}, {2.4, 0.43}, {2.9, 0.32}, {3.4, 0.29}};
  return {"uo-diagram", kHermesSpeeds, {}, std::move(loop), {}};
}

}  // namespace throng::validation
