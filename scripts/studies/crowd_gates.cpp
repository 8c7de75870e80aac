// Measures a pedestrian model in the scenes of validation/walking.h and
// validation/flow.h, for fits and comparisons.
//
//   crowd_gates MODEL [seeds=N] [only=NAME,...] [CONSTANT=VALUE ...] [PARAMETER=VALUE ...]
//
// One line per scene, one column per seed:
//
// - fd_DENSITY: specific flow in a ring 3 m wide, 1/(m s)
// - ring_WIDTH_DENSITY: the same in a ring of another width
// - door_WIDTH: specific flow through a door, 1/(m s)
// - wide_3: specific flow of 348 people through an opening of 3 m into the open, 1/(m s)
// - geometry_WIDTH_DEPTH_ROOM_CUT: people per second through such a door
// - straight_WIDTH, corner_WIDTH, corner_thin_WIDTH: specific flow out of a corridor that is
// straight
//   or has a turn around a block or thin walls, 1/(m s); with _queued before WIDTH: of people who
//   stand close together up to the turn
// - imo_4: people per second over the entire time; deepest overlap, m
// - square_DENSITY: share of people who are stuck; speed, m/s; rms acceleration, m/s^2
// - room_OTHERS: time of 100 people through a corridor against so many, s; people left after 600 s
// - two_way_EACH: specific flows of both directions, 1/(m s); share of people who are stuck
// - meet_ASIDE: time before meeting at which one goes aside, s; greatest acceleration, m/s^2
// - queue: turns and stops per person and minute
#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "crowd/state/model.h"
#include "validation/flow.h"
#include "validation/walking.h"

namespace throng::validation {
namespace {

using Numbers = std::vector<double>;

struct Gate {
  std::string name;
  std::function<Numbers(const Tested&, std::uint64_t)> measure;
};

void add_flows(std::vector<Gate>& all) {
  for (const double density :
       {0.02, 0.1, 0.4, 0.6, 1.1, 1.6, 1.9, 2.1, 2.4, 2.9, 3.4, 4.0, 5.0, 6.0}) {
    all.push_back({fmt::format("fd_{}", density), [density](const Tested& t, std::uint64_t seed) {
                     return Numbers{walk_in_ring(t, density, seed).speed_mps * density};
                   }});
  }
  for (const double width : {1.2, 1.8, 3.0, 6.0}) {
    for (const double density : {1.1, 1.6, 2.1, 2.9}) {
      all.push_back({fmt::format("ring_{}_{}", width, density),
                     [width, density](const Tested& t, std::uint64_t seed) {
                       return Numbers{density *
                                      walk_in_ring(t, density, seed, {.width_m = width}).speed_mps};
                     }});
    }
  }
  for (const double width : {0.8, 1.0, 1.2, 1.6, 2.0}) {
    all.push_back({fmt::format("door_{}", width), [width](const Tested& t, std::uint64_t seed) {
                     return Numbers{specific_flow(t, {width, 0.2}, seed)};
                   }});
  }
  for (const double width : {2.0, 4.0}) {
    for (const bool queued : {false, true}) {
      for (const auto& [name, turn] : {std::pair("straight", Turn::none),
                                       {"corner", Turn::block},
                                       {"corner_thin", Turn::thin}}) {
        all.push_back(
            {fmt::format("{}{}_{}", name, queued ? "_queued" : "", width),
             [passage = Passage{width, turn, queued}](const Tested& t, std::uint64_t seed) {
               return Numbers{corridor_flow(t, passage, seed)};
             }});
      }
    }
  }
  all.push_back({"imo_4", [](const Tested& t, std::uint64_t seed) {
                   const ExitRun run = leave_room(t, seed);
                   return Numbers{run.flow_per_s, run.overlap_m};
                 }});
}

void add_geometries(std::vector<Gate>& all) {
  static constexpr Bottleneck kWide{.width_m = 3, .wall_m = 0.1, .people = 348, .room_m = 8};
  all.push_back({"wide_3", [](const Tested& t, std::uint64_t seed) {
                   return Numbers{specific_flow(t, kWide, seed)};
                 }});
  for (const double width : {0.5, 0.7, 0.8, 1.0, 1.2}) {
    for (const Bottleneck& door : drawn_doors(width, true)) {
      all.push_back(
          {fmt::format("geometry_{}_{}_{}_{}", width, door.wall_m, door.room_m, door.corner_cut_m),
           [door](const Tested& t, std::uint64_t seed) {
             return Numbers{door.width_m * specific_flow(t, door, seed)};
           }});
    }
  }
}

void add_encounters(std::vector<Gate>& all) {
  for (const double density : {0.5, 1.0}) {
    all.push_back(
        {fmt::format("square_{}", density), [density](const Tested& t, std::uint64_t seed) {
           const SquareRun run = cross_square(t, density, seed);
           return Numbers{run.stuck, run.speed_mps, run.acceleration_mps2};
         }});
  }
  for (const std::size_t others : {0UL, 50UL, 100UL}) {
    all.push_back({fmt::format("room_{}", others), [others](const Tested& t, std::uint64_t seed) {
                     const CounterRun run = pass_corridor(t, others, seed);
                     return Numbers{run.time_s, static_cast<double>(run.left)};
                   }});
  }
  for (const double each : {0.75, 1.5}) {
    all.push_back({fmt::format("two_way_{}", each), [each](const Tested& t, std::uint64_t seed) {
                     const TwoWayRun run = walk_both_ways(t, each, seed);
                     return Numbers{run.there, run.back, run.stuck};
                   }});
  }
  for (const double aside : {0.0, 0.1, 0.3}) {
    all.push_back({fmt::format("meet_{}", aside), [aside](const Tested& t, std::uint64_t seed) {
                     const MeetingRun run = meet(t, aside, seed);
                     return Numbers{run.begins_s, run.acceleration_mps2};
                   }});
  }
  all.push_back({"queue", [](const Tested& t, std::uint64_t seed) {
                   const QueueRun run = stand_in_queue(t, seed);
                   return Numbers{run.turns, run.stops};
                 }});
}

struct Command {
  Tested tested{"ttc"};
  std::size_t seeds = 3;
  std::vector<std::string> only;
};

Command read(std::span<char* const> words) {
  Command command;
  if (words.size() > 1) command.tested.model = words[1];
  const crowd::ModelEntry& entry = crowd::find_model(command.tested.model);
  crowd::Node constants{std::string(entry.tag)};
  crowd::Node parameters{std::string(entry.tag)};
  for (const std::string word : words.subspan(std::min<std::size_t>(2, words.size()))) {
    const auto equals = word.find('=');
    const std::string name = word.substr(0, equals);
    std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (name == "seeds") {
      command.seeds = std::stoul(value);
    } else if (name == "only") {
      for (value += ','; !value.empty(); value.erase(0, value.find(',') + 1)) {
        command.only.push_back(value.substr(0, value.find(',')));
      }
    } else {
      const bool is_parameter = std::any_of(entry.parameters.begin(), entry.parameters.end(),
                                            [&](const auto& p) { return p.name == name; });
      (is_parameter ? parameters : constants).set({name, value});
    }
  }
  if (!constants.attributes.empty()) command.tested.constants = {constants};
  if (!parameters.attributes.empty()) command.tested.profile = {parameters};
  return command;
}

void run(const Command& command) {
  std::vector<Gate> gates;
  add_flows(gates);
  add_geometries(gates);
  add_encounters(gates);
  std::erase_if(gates, [&](const Gate& gate) {
    return !command.only.empty() &&
           std::none_of(command.only.begin(), command.only.end(),
                        [&](const std::string& start) { return gate.name.starts_with(start); });
  });
  std::vector<Numbers> results(gates.size() * command.seeds);
  tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t i) {
    tbb::task_arena alone(1);
    alone.execute([&] {
      results[i] = gates[i / command.seeds].measure(command.tested, 1 + i % command.seeds);
    });
  });
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (i % command.seeds == 0)
      fmt::print("{}{:24}", i > 0 ? "\n" : "", gates[i / command.seeds].name);
    fmt::print(" |");
    for (const double number : results[i]) fmt::print(" {:.3g}", number);
  }
  fmt::print("\n");
}

}  // namespace
}  // namespace throng::validation

int main(int argc, char** argv) {
  try {
    throng::validation::run(throng::validation::read({argv, static_cast<std::size_t>(argc)}));
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
