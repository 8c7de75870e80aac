#include "places/scenarios/blueprint/closing_doors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace throng::scenarios {

using Eigen::Vector2d;
using world::Exit;

namespace {

constexpr std::uint32_t kReservedClasses = 1 | kFirstClass;

/// The highest bit that no disc and no other door has; 0 if there is none.
std::uint32_t free_class(std::uint32_t taken) {
  std::uint32_t bit = 1U << 30U;
  while ((taken & bit) != 0) bit >>= 1U;
  return bit;
}

}  // namespace

bool is_destination(const Exit& exit, const std::vector<Exit>& exits) {
  const auto is_open = [](const Exit& one) { return one.is_open(0); };
  return is_open(exit) || std::none_of(exits.begin(), exits.end(), is_open);
}

double closing_time_s(const Exit& exit, const std::vector<BlockedDisc>& discs) {
  if (!exit.open) return 0;
  const BlockedDisc* const disc = first_to_reach(exit, discs);
  return disc == nullptr ? exit.closes_at_s : std::min(exit.closes_at_s, disc->from_s);
}

std::vector<ClosingDoor> closing_doors(const std::vector<Exit>& exits,
                                       const std::vector<BlockedDisc>& discs,
                                       std::vector<Problem>& problems) {
  std::uint32_t taken = kReservedClasses;
  for (const BlockedDisc& disc : discs) taken |= disc.obstacle_class;
  std::vector<ClosingDoor> doors;
  const auto add = [&](std::size_t i) {
    ClosingDoor door{exits[i], closing_time_s(exits[i], discs), 1};
    if (door.from_s > 0) door.obstacle_class = free_class(taken);
    taken |= door.obstacle_class;
    if (door.obstacle_class != 0) doors.push_back(door);
    return door.obstacle_class != 0;
  };
  const auto closes_itself = [](const Exit& exit) {
    return !exit.open || std::isfinite(exit.closes_at_s);
  };
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (!closes_itself(exits[i]) || add(i)) continue;
    problems.push_back({"", fmt::format("/exits/{}/closes_at_s", i), "one more exit that closes",
                        fmt::format("at most {} with these disasters", doors.size())});
  }
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (!closes_itself(exits[i]) && std::isfinite(closing_time_s(exits[i], discs))) add(i);
  }
  return doors;
}

std::vector<Vector2d> shutter(const Exit& exit) {
  constexpr double kDeepM = 1.4;
  const Vector2d along = exit.to - exit.from;
  const bool leads_left = Vector2d(-along.y(), along.x()).dot(exit.outward) > 0;
  const Vector2d right = leads_left ? exit.from : exit.to;
  const Vector2d left = leads_left ? exit.to : exit.from;
  return {right, left, left + kDeepM * exit.outward, right + kDeepM * exit.outward};
}

crowd::Node closing_element(const ClosingDoor& door) {
  constexpr int kDecimals = 3;
  using crowd::decimals_text;
  return crowd::Node("ClosingDoor", {{"class", static_cast<int>(door.obstacle_class)},
                                     {"time", decimals_text(door.from_s, kDecimals)},
                                     {"from_x", decimals_text(door.exit.from.x(), kDecimals)},
                                     {"from_y", decimals_text(door.exit.from.y(), kDecimals)},
                                     {"to_x", decimals_text(door.exit.to.x(), kDecimals)},
                                     {"to_y", decimals_text(door.exit.to.y(), kDecimals)}});
}

}  // namespace throng::scenarios
