#include "live/flight/people_in_motion.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"

namespace throng::live {

namespace {

constexpr double kFallS = 0.8;

std::vector<skinning::Appearance> sample_looks(const world::TraceHeader& header, std::uint64_t seed,
                                               const skinning::Population& population,
                                               const skinning::Styling& styling) {
  std::vector<skinning::Appearance> looks;
  for (std::size_t agent = 0; agent < header.agent_count(); ++agent) {
    looks.push_back(skinning::sample_appearance(population, seed, static_cast<std::uint32_t>(agent),
                                                styling, render::find_spot(header, agent)));
  }
  return looks;
}

}  // namespace

std::vector<double> statures_m(const world::TraceHeader& header,
                               const skinning::Population& population,
                               const skinning::Styling& styling) {
  std::vector<double> statures;
  for (const skinning::Appearance& look : sample_looks(header, header.seed, population, styling)) {
    statures.push_back(population.characters[look.character].stature_m);
  }
  return statures;
}

PosedPeople::PosedPeople(const world::TraceHeader& header, std::uint64_t seed,
                         const skinning::Population& population, const skinning::Styling& styling,
                         std::span<const world::Stand> stands,
                         std::span<const world::Sitter> sitters)
    : population_(population),
      clips_(population),
      roles_(header.role),
      looks_(sample_looks(header, seed, population, styling)),
      fell_at_s_(header.agent_count(), -1),
      postures_(render::stand_postures(header)),
      on_stands_(header.agent_count()),
      poses_on_stands_(population),
      floors_(stands, sitters) {}

skinning::PoseBlend PosedPeople::pose_on_stand(std::size_t agent, skinning::StandPosture posture,
                                               double time_s) {
  skinning::PostureTime& known = on_stands_[agent];
  if (posture != known.now) {
    known.before = known.now;
    known.now = posture;
    known.since_s = time_s;
  }
  skinning::PostureTime now = known;
  now.since_s = time_s - known.since_s;
  return poses_on_stands_.at(now, looks_[agent].phase_offset, time_s);
}

skinning::PoseBlend PosedPeople::pose_of(std::size_t agent, double meters, double speed_mps,
                                         std::uint8_t flags, double time_s) {
  const skinning::Appearance& look = looks_[agent];
  const skinning::Character& character = population_.characters[look.character];
  if ((flags & world::kFallen) == 0) {
    fell_at_s_[agent] = -1;
  } else if (const skinning::Clip* fall = clips_.find("fall_forwards"); fall != nullptr) {
    if (fell_at_s_[agent] < 0) fell_at_s_[agent] = time_s;
    const double share = std::min(1.0, (time_s - fell_at_s_[agent]) / kFallS);
    return skinning::blend_frame(*fall, share * (fall->frames - 1));
  }
  if (speed_mps < skinning::kStandingSpeed) {
    return skinning::standing_pose(clips_, look.phase_offset, time_s);
  }
  const double stature_m = character.gait_stature_m();
  const double stride_m = skinning::stride_length_m(speed_mps, stature_m, character.age_years) *
                          look.amplitude / look.cadence;
  const bool runs = speed_mps > skinning::running_speed_mps(stature_m);
  const bool panics = runs && (flags & world::kPanicked) != 0;
  const skinning::Clip& clip =
      clips_.nearest(panics ? "panic" : (runs ? "run" : "walk"), stride_m / stature_m);
  const double clip_stride_m = clip.stride > 0 ? clip.stride * stature_m : stride_m;
  return skinning::blend_frame(clip, (look.phase_offset + meters / clip_stride_m) * clip.frames);
}

render::Scene PosedPeople::scene_at(const Moment& moment, double time_s) {
  render::Scene scene;
  scene.time_s = time_s;
  const world::CrowdStep& a = *moment.before;
  const world::CrowdStep& b = *moment.now;
  const auto share =
      static_cast<float>(std::clamp(1 - (moment.time_s - time_s) / moment.dt_s, 0.0, 1.0));
  for (std::size_t i = 0; i < roles_.size(); ++i) {
    if ((a.flags[i] & world::kPresent) == 0) continue;
    if (!world::is_visible_person(roles_[i])) {
      scene.dangers.push_back(a.position[i]);
      continue;
    }
    const float part = (b.flags[i] & world::kPresent) == 0 ? 0 : share;
    render::PersonInstance person;
    person.agent = static_cast<std::uint32_t>(i);
    person.appearance = looks_[i];
    person.position.head<2>() = a.position[i] + part * (b.position[i] - a.position[i]);
    person.velocity = a.velocity[i] + part * (b.velocity[i] - a.velocity[i]);
    person.yaw_rad = geometry::interpolated_rad(a.yaw_rad[i], b.yaw_rad[i], part);
    const double meters =
        moment.strides_before[i] +
        static_cast<double>(part) * (moment.strides_now[i] - moment.strides_before[i]);
    person.position.z() = floors_.height_m(person.position.head<2>());
    const auto posture = a.state[i] < postures_.size() ? postures_[a.state[i]] : std::nullopt;
    person.pose = posture ? pose_on_stand(i, *posture, time_s)
                          : pose_of(i, meters, person.velocity.norm(), a.flags[i], time_s);
    scene.people.push_back(person);
  }
  return scene;
}

}  // namespace throng::live
