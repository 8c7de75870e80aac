#include "render/people/people_on_stands.h"

#include <algorithm>

#include "world/stand_seats.h"

namespace throng::render {

using skinning::PostureTime;
using skinning::StandPosture;

StandFloors::StandFloors(std::span<const world::Stand> stands,
                         std::span<const world::Sitter> sitters)
    : stands_(stands.begin(), stands.end()) {
  for (const world::Stand& stand : stands_) {
    Eigen::AlignedBox2d box;
    for (const double along_m : {0.0, world::length_m(stand)}) {
      for (const double back_m : {-world::kFrontStepsM, world::depth_m(stand)}) {
        box.extend(world::point_on(stand, along_m, back_m));
      }
    }
    boxes_.push_back(box);
  }
  for (const world::Sitter& sitter : sitters) {
    seats_.emplace_back(sitter.position.x(), sitter.position.y(), sitter.floor_m);
  }
  std::sort(seats_.begin(), seats_.end(),
            [](const auto& a, const auto& b) { return a.x() < b.x(); });
}

float StandFloors::height_m(const Eigen::Vector2f& point) const {
  const Eigen::Vector2d place = point.cast<double>();
  for (std::size_t i = 0; i < stands_.size(); ++i) {
    if (!boxes_[i].contains(place)) continue;
    const double height_m = world::elevation_m({&stands_[i], 1}, place);
    if (height_m > 0) return static_cast<float>(height_m);
  }
  constexpr double kOnSeatM = 0.01;  // sitters do not move, and nobody else comes so near
  for (auto seat = std::lower_bound(
           seats_.begin(), seats_.end(), place.x() - kOnSeatM,
           [](const Eigen::Vector3d&at, double from_m) { return at.x() < from_m; });
       seat != seats_.end() && seat->x() <= place.x() + kOnSeatM; ++seat) {
    if ((seat->head<2>() - place).norm() <= kOnSeatM) return static_cast<float>(seat->z());
  }
  return 0;
}

skinning::Spot find_spot(const world::TraceHeader& header, std::size_t agent) {
  return header.role[agent] == world::AgentRole::spectator ? skinning::Spot::stand
                                                           : skinning::Spot::ground;
}

std::vector<std::optional<StandPosture>> stand_postures(const world::TraceHeader& header) {
  std::vector<std::optional<StandPosture>> postures;
  postures.resize(header.state_names.size());
  const std::optional<std::size_t> first = header.first_stand_state();
  if (!first) return postures;
  for (const StandPosture posture :
       {StandPosture::sitting, StandPosture::standing, StandPosture::cheering}) {
    postures[*first + static_cast<std::size_t>(posture)] = posture;
  }
  return postures;
}

PeopleOnStands::PeopleOnStands(const world::Trace& trace, std::span<const world::Stand> stands,
                               std::span<const world::Sitter> sitters)
    : trace_(&trace), floors_(stands, sitters), changes_(trace.agents()) {
  if ((stands.empty() && sitters.empty()) || trace.state.empty()) return;
  const std::vector<std::optional<StandPosture>> postures = stand_postures(trace.header);
  std::vector<std::optional<StandPosture>> before(trace.agents());
  for (std::uint32_t step = 0; step < trace.steps(); ++step) {
    for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
      const std::uint8_t state = trace.state[trace.at(step, agent)];
      const bool is_there = trace.present(step, agent) && state < postures.size();
      const std::optional<StandPosture> now = is_there ? postures[state] : std::nullopt;
      if (now == before[agent]) continue;
      before[agent] = now;
      changes_[agent].push_back({step, now});
    }
  }
}

bool PeopleOnStands::has_posture(std::size_t agent, std::size_t step) const {
  return !changes_[agent].empty() && posture_at(agent, step, trace_->time_s[step]).has_value();
}

std::optional<PostureTime> PeopleOnStands::posture_at(std::size_t agent, std::size_t step,
                                                      double time_s) const {
  const std::vector<Change>& changes = changes_[agent];
  const auto next = std::upper_bound(changes.begin(), changes.end(), step,
                                     [](std::size_t at, const Change& c) { return at < c.step; });
  if (next == changes.begin() || !(next - 1)->posture) return std::nullopt;
  const Change& now = *(next - 1);
  PostureTime posture;
  posture.now = posture.before = *now.posture;
  if (next - 1 != changes.begin() && (next - 2)->posture) posture.before = *(next - 2)->posture;
  posture.since_s = time_s - trace_->time_s[now.step];
  if (next != changes.end()) posture.until_s = trace_->time_s[next->step] - time_s;
  return posture;
}

}  // namespace throng::render
