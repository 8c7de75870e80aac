// Acts: what people do on the spot beside standing at ease, each a clip of its own. A clip raises
// the body from ready() to the act in its first kActRaisedFrame frames. Then come kActFrames
// frames: of a calm act from a look to the right to one to the left, and of the others one
// repetition, whose last frame is its first. Angles are estimates from anatomy and photographs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "skinning/animate/action.h"
#include "skinning/animate/figure.h"

namespace throng::skinning {

/// Among whom somebody stands; decides which acts are likely.
enum class Setting : std::uint8_t { alone, company, audience, fear };

/// One act.
struct Act {
  std::string_view clip;
  Actions actions;
  int hands;                     ///< free hands that it needs
  double youngest;               ///< age (years) from which people do it
  double oldest;                 ///< age up to which they do
  double cycle_s;                ///< duration of a repetition; 0: calm
  std::array<double, 4> likely;  ///< relative frequency by Setting
};

inline constexpr std::uint32_t kActRaisedFrame = 4;
inline constexpr std::uint32_t kActFrames = 9;

/// All acts, in the order of their clips.
std::span<const Act> acts();

/// The act of a clip; null for other clips.
const Act* find_act(std::string_view clip);

/// The figure of an act. `raised` from 0 (ready()) to 1; `at` is the phase of a repetition, or of a
/// calm act the look to the side from -1 (right) to 1 (left).
Figure act_figure(const Walker& walker, const Act& act, double raised, double at);

/// Whether both feet may be off the ground.
bool is_airborne(const Act& act);

}  // namespace throng::skinning
