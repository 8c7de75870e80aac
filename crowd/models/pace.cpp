#include "crowd/models/pace.h"

#include <algorithm>
#include <cmath>

#include "crowd/models/local_model.h"
#include "crowd/models/oncoming.h"
#include "crowd/models/single_file.h"

namespace throng::crowd {

Pace::View Pace::view(const Crowd& crowd, const Grid& grid, const AgentView& around) const {
  const std::size_t id = around.agent;
  View view;
  view.direction = crowd.agents.preferred_direction[id];
  view.free_speed = crowd.agents[Property::pref_speed][id];
  view.reach_sq = known_reach_sq(crowd, around, spec_.reach_m);
  const PassingRoom room{kOneRadii * grid.radius(around.slot),
                         kPassingRadii * grid.radius(around.slot)};
  const float file =
      around.walls.empty() ? 0 : room.singleness(passage_width_m(crowd, grid, around, room.two_m));
  if (file > 0 && view.free_speed > 0) {
    const float share =
        std::clamp(gap_ahead_m(crowd, grid, around) / (spec_.headway_s * view.free_speed),
                   spec_.min_speed_share, 1.0F);
    view.file_share = 1 - file * (1 - share);
  }
  return view;
}

SpeedRegulation Pace::regulation(const View& view, const Ahead& ahead) const {
  const Eigen::Vector2f& direction = view.direction;
  SpeedRegulation regulation{1, 1, direction};
  if (ahead.along > 0) {
    const float share = 1 - std::exp(-spec_.decline * (1 / ahead.along - 1 / spec_.jam_density));
    regulation.share = std::clamp(share, spec_.min_speed_share, 1.0F);
  }
  // Slow agents need not look as far; and at a door no one waits for those beside them.
  regulation.horizon_share = regulation.share;
  regulation.share = std::min(regulation.share, view.file_share);
  if (ahead.against > 0) {
    const float farther = 2 * ahead.against / std::max(ahead.along, ahead.against);
    regulation.horizon_share = std::max(regulation.horizon_share, std::min(1.0F, farther));
    regulation.direction = turned_right(direction, spec_.keep_right, ahead.against);
  }
  return regulation;
}

}  // namespace throng::crowd
