// The queue before an exit.
#pragma once

#include <span>

#include "metrics/control_zone.h"
#include "metrics/near_people.h"

namespace throng::metrics {

struct Queue {
  int people = 0;
  double length_m = 0;  ///< from the exit's middle along the queue to whoever has farthest to go
};

/// Who intends the exit, is on its inner side, is slower than half of the desired speed, and is
/// linked to the control zone: two such people are linked within 1.2 m. Way along the queue: from
/// person to person over links, from the first one in the zone straight to the exit's middle.
Queue queue_before(const ControlZone& zone, const Eigen::Vector2d& outward,
                   std::span<const NearPerson> people);

}  // namespace throng::metrics
