// Motions on the spot: stand, look around, look at a phone or up to the sky, turn, start and stop
// walking, fall and lie.
#pragma once

#include "skinning/animate/gait.h"
#include "skinning/animate/posture.h"

namespace throng::skinning {

/// The stance at the start and the end of every clip of standing, which joins them.
Figure ready(const Walker& walker);

/// Standing upright on flat feet at rest, the hips `aside_m` to the left, the knees of the
/// straighter leg bent by `knee_rad`.
Figure upright(const Walker& walker, const Trunk& trunk, const std::array<Arm, 2>& arms,
               double aside_m, double knee_rad);

/// Standing at ease: `weight` from -1 (on the right leg) to 1 (on the left one), looking to the
/// side from -1 (right) to 1 (left); ready() if both are 0.
Figure stand(const Walker& walker, double weight, double aside);

/// Looking up, `yaw_rad` to the left; `raised` from 0 (ready()) to 1; `phase` of small movements.
Figure look_up(const Walker& walker, double yaw_rad, double raised, double phase);

/// Looking at a phone in the free hand; parameters as in look_up().
Figure look_at_phone(const Walker& walker, double raised, double phase);

/// Turning by `angle_rad` to the left with a step of each foot; share 0 and 1 are ready() in the
/// rotating frame of the body.
Figure turn_on_the_spot(const Walker& walker, double angle_rad, double share);

/// The first step of a walk, from standing (share 0, with the foot of `side` below the body) to the
/// strike of the other foot (share 1), a quarter of a stride further.
Figure start(const Walker& walker, const Stride& stride, Side side, double share);

/// The end of a walk, from shortly after the strike of `side` (share 0) to standing (share 1) with
/// the other foot beside it. Covers kStopStrides.
Figure stop(const Walker& walker, const Stride& stride, Side side, double share);
/// Distance covered by stop(), in strides.
inline constexpr double kStopStrides = 0.15;

/// Falling, from standing (share 0) to lying (share 1), on the face (`forwards`) or on the back.
Pose fall(const Walker& walker, bool forwards, double share);

}  // namespace throng::skinning
