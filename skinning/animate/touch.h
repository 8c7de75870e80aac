// Places on and around the body that hands go to: pockets, the ear, the knees.
#pragma once

#include <cstdint>

#include "skinning/animate/figure.h"

namespace throng::skinning {

/// The position of a hand.
enum class HandSpot : std::uint8_t {
  pocket,
  waist,  ///< the side of it
  back,   ///< behind the waist
  elbow,  ///< of the other arm, before the chest
  chest,  ///< before it, as people hold a map
  ear,
  mouth,
  eyes,  ///< before them, as people hold a camera
  overhead,
  crown,  ///< of the head
  knee,
};

/// Moves the palm of a hand to a spot. Trunk, head and, for
/// the knee, the feet of `figure` must be posed. Clothes and belly are taken into account.
void put_hand(const Walker& walker, Side side, HandSpot spot, Figure& figure);

/// As above, between two spots: `share` 0 is at `from`, 1 at `to`.
void put_hand(const Walker& walker, Side side, HandSpot from, HandSpot to, double share,
              Figure& figure);

/// Whether a hand holds an item where it is, or leans on a stick.
bool is_hand_busy(const Walker& walker, Side side);

}  // namespace throng::skinning
