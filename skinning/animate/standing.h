// Motions in place: stand, look around, look at a phone or up into the sky, turn, start and stop
// walking, fall and lie.
#pragma once

#include "skinning/animate/gait.h"

namespace throng::skinning {

/// The stance between any two of these: at the ends of every clip of standing.
Figure ready(const Walker& walker);

/// Standing at ease; phase 0 and 1 are ready().
Figure stand(const Walker& walker, double phase);

/// The head turns to both sides; share 0 and 1 are ready().
Figure look_around(const Walker& walker, double share);

/// Looking up, `yaw_rad` to the left; `raised` from 0 (ready) to 1, `phase` of small movements.
Figure look_up(const Walker& walker, double yaw_rad, double raised, double phase);

/// Looking at a phone in the free hand.
Figure look_at_phone(const Walker& walker, double raised, double phase);

/// Turning by `angle_rad` to the left with a step of either foot; share 0 and 1 are ready(), in
/// the axes of the turning body.
Figure turn_on_the_spot(const Walker& walker, double angle_rad, double share);

/// The first step of a walk, from standing (share 0, `side` under the body) to the other foot's
/// strike (share 1), a quarter of a stride further.
Figure start(const Walker& walker, const Stride& stride, Side side, double share);

/// The end of a walk, from a little after the strike of `side` (share 0) to standing (share 1),
/// while the other foot comes beside it. Covers kStopStrides.
Figure stop(const Walker& walker, const Stride& stride, Side side, double share);
inline constexpr double kStopStrides = 0.15;

/// Breaking down, from standing (share 0) to lying (share 1), on the face or on the back.
Pose fall(const Walker& walker, bool forwards, double share);

}  // namespace throng::skinning
