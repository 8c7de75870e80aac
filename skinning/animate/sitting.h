// Motions of people on a stand: sitting, getting up, cheering. The origin lies below the pelvis: of
// a sitter's on the seat, and of a standing person's who stands kRiseAheadM ahead of it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "skinning/animate/figure.h"

namespace throng::skinning {

/// Height of the seat above the floor, and how far a person moves ahead by getting up (m).
inline constexpr double kSeatM = 0.44;
inline constexpr double kRiseAheadM = 0.3;

/// Postures of sitting: upright with hands on the thighs, leaning forward with forearms on them,
/// with one leg over the other, leaning back, and leaning forward over a phone.
enum class Seated : std::uint8_t { upright, forward, crossed, back, phone };
/// Their clips.
inline constexpr std::array<std::string_view, 5> kSeatedClips = {
    "sit", "sit_forward", "sit_crossed", "sit_back", "sit_phone"};

/// The posture of a clip; nothing for other clips.
std::optional<Seated> find_seat(std::string_view clip);

/// Sitting, looking to the side from -1 (right) to 1 (left).
Figure sit(const Walker& walker, Seated seated, double aside);

/// Getting up, from sit() ahead (share 0) to ready() (share 1).
Figure rise(const Walker& walker, double share);

/// Frame of the clip "cheer" from which on the arms are raised and wave once until the last one.
inline constexpr std::uint32_t kCheerRaisedFrame = 6;

/// Standing and cheering: the arms `raised` from 0 (ready()) to 1, waving; `phase` in cycles.
Figure cheer(const Walker& walker, double raised, double phase);

}  // namespace throng::skinning
