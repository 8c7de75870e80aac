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

/// A spectator on a seat; `number` counts those of all stands.
Spectator seat_person(const world::Stand& stand, const world::Seat& seat, std::uint64_t seed,
                      std::uint64_t number) {
  const double yaw_rad = world::facing_rad(stand);
  Spectator person;
  person.key = derive_seed(seed, Stream::spectators, kPeopleKeys + number);
  person.seat = seat.position.cast<float>();
  person.is_playing = !stand.band.empty();
  if (!person.is_playing) {
    person.ahead =
        (world::standing_ahead_m(stand) * Eigen::Vector2d(std::cos(yaw_rad), std::sin(yaw_rad)))
            .cast<float>();
  }
  Random random(person.key, Stream::spectators);
  const double turned_rad = random.uniform(-kFacingSpreadDeg, kFacingSpreadDeg) * kDegree;
  person.yaw_rad = static_cast<float>(geometry::wrapped_rad(yaw_rad + turned_rad));
  return person;
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

Spectators take_seats(const std::vector<world::Stand>& stands, std::uint64_t seed, bool all_stay) {
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
  return people;
}

SpectatorNow spectator_at(const Spectator& person, const CheeringWaves& waves, double time_s) {
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
