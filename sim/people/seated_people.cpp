#include "sim/people/seated_people.h"

#include <algorithm>
#include <cmath>

#include "base/compute/random.h"
#include "base/geometry/angle.h"

namespace throng::sim {

using Eigen::Vector2f;

namespace {

constexpr std::uint64_t kPeopleKeys = 1ULL << 32U;
constexpr double kFacingSpreadDeg = 8;

/// Somebody at a place; `number` counts all of them.
Spectator person_at(const Eigen::Vector2d& place, double yaw_rad, std::uint64_t seed,
                    std::uint64_t number) {
  Spectator person;
  person.key = derive_seed(seed, Stream::spectators, kPeopleKeys + number);
  person.seat = place.cast<float>();
  Random random(person.key, Stream::spectators);
  const double turned_rad = random.uniform(-kFacingSpreadDeg, kFacingSpreadDeg) * kDegree;
  person.yaw_rad = static_cast<float>(geometry::wrapped_rad(yaw_rad + turned_rad));
  return person;
}

/// A spectator on a seat.
Spectator seat_person(const world::Stand& stand, const world::Seat& seat, std::uint64_t seed,
                      std::uint64_t number) {
  const double yaw_rad = world::facing_rad(stand);
  Spectator person = person_at(seat.position, yaw_rad, seed, number);
  person.is_playing = !stand.band.empty();
  if (!person.is_playing) {
    person.ahead =
        (world::standing_ahead_m(stand) * Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad)))
            .cast<float>();
  }
  return person;
}

/// Adds the people on props, by prop; `number` is that of the first one.
void add_sitters(const std::vector<world::Sitter>& sitters, std::uint64_t seed,
                 std::uint64_t number, std::vector<Spectator>& people) {
  const auto share_prop = [&](std::size_t i, std::size_t k) {
    return k < sitters.size() && sitters[i].prop == sitters[k].prop;
  };
  std::int32_t groups = 0;
  for (std::size_t i = 0; i < sitters.size(); ++i) {
    Spectator& person =
        people.emplace_back(person_at(sitters[i].position, sitters[i].yaw_rad, seed, number + i));
    person.only_sits = true;
    const bool is_first = i == 0 || !share_prop(i, i - 1);
    if (is_first && share_prop(i, i + 1)) ++groups;
    if (!is_first || share_prop(i, i + 1)) person.group = groups - 1;
  }
}

/// Musicians play for a while, then raise their arms: by turns of some seconds.
Posture playing_posture(std::uint64_t key, double time_s) {
  constexpr double kTurnS = 5;
  constexpr double kRaisedShare = 0.35;
  Random first(key, Stream::spectators, 0);
  const auto turn = static_cast<std::uint64_t>(time_s / kTurnS + first.uniform());
  return Random(key, Stream::spectators, 1 + turn).uniform() < kRaisedShare ? Posture::cheering
                                                                            : Posture::standing;
}

}  // namespace

Spectators take_seats(const world::Scenario& scenario, std::uint64_t seed, bool all_stay) {
  const std::vector<world::Stand>& stands = scenario.stands;
  std::size_t blocks = 0;
  for (const world::Stand& stand : stands) blocks += world::inner_aisles(stand) + 1;
  Spectators people;
  std::size_t first_block = 0;
  std::uint64_t number = 0;
  for (const world::Stand& stand : stands) {
    const std::vector<world::Seat> seats = world::seats(stand);
    const std::vector<world::Aisle> aisles = world::aisles(stand);
    std::vector<Spectator> here;
    const std::vector<std::size_t> taken = world::taken_seats(stand, seats);
    for (const std::size_t i : taken) {
      here.push_back(seat_person(stand, seats[i], seed, number++));
      const std::size_t block = first_block + static_cast<std::size_t>(seats[i].block);
      here.back().place =
          static_cast<double>(block) / static_cast<double>(std::max<std::size_t>(1, blocks - 1));
    }
    first_block += world::inner_aisles(stand) + 1;
    if (all_stay || !std::isfinite(stand.spectators.leave_at_s)) {
      people.stay.insert(people.stay.end(), here.begin(), here.end());
      continue;
    }
    for (const world::Departure& departure : world::departures(stand)) {
      Spectator& person = people.leave.emplace_back(here[departure.spectator]);
      person.rises_s = departure.rises_s;
      person.way.emplace(stand, seats[taken[departure.spectator]], aisles[departure.aisle]);
    }
  }
  add_sitters(scenario.sitters, seed, number, people.stay);
  return people;
}

SpectatorNow spectator_at(const Spectator& person, const CheeringWaves& waves, double time_s) {
  if (person.only_sits) return {person.seat, person.yaw_rad, Posture::sitting};
  if (person.is_playing) {
    return {person.seat, person.yaw_rad, playing_posture(person.key, time_s)};
  }
  if (person.way && time_s >= person.rises_s) {
    const double walked_s = time_s - person.rises_s;
    if (walked_s < world::kGetUpS) {
      // Some stand already.
      const double before = waves.posture_at(person.rises_s, person.key, person.place).risen;
      const double risen = std::lerp(before, 1.0, walked_s / world::kGetUpS);
      return {person.seat + static_cast<float>(risen) * person.ahead, person.yaw_rad,
              Posture::standing};
    }
    const world::OnTheWay now = person.way->at(walked_s);
    const bool walks = now.velocity.norm() > 0;
    const double yaw_rad = std::atan2(now.velocity.y(), now.velocity.x());
    return {now.position.cast<float>(), walks ? static_cast<float>(yaw_rad) : person.yaw_rad,
            Posture::leaving};
  }
  const PostureNow now = waves.posture_at(time_s, person.key, person.place);
  const Vector2f risen_m = static_cast<float>(now.risen) * person.ahead;
  return {person.seat + risen_m, person.yaw_rad, now.posture};
}

}  // namespace throng::sim
