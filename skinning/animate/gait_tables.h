// Measured joint angles over one stride.
#pragma once

#include <array>

namespace throng::skinning {

/// Angles (degrees) at every 2 % of a stride, from a foot strike to the next one of the same foot;
/// flexion and dorsiflexion are positive. The hip's angle is relative to the pelvis, which is
/// tilted forward.
struct GaitTable {
  static constexpr std::size_t kSamples = 51;
  std::array<float, kSamples> hip;
  std::array<float, kSamples> knee;
  std::array<float, kSamples> ankle;
  float pelvis_tilt_deg;
};

/// Fukuchi, Fukuchi & Duarte 2018, PeerJ 6:e4640 (CC BY 4.0): walking at 1.26 m/s, 9 people.
inline constexpr GaitTable kWalkTable = {
    {31.9F, 31.5F, 31.0F, 30.7F, 30.8F, 30.3F, 28.9F, 26.8F, 24.5F, 22.3F, 20.2F, 18.2F, 16.1F,
     14.0F, 11.7F, 9.5F,  7.4F,  5.4F,  3.6F,  1.8F,  0.0F,  -1.6F, -3.2F, -4.7F, -6.0F, -7.0F,
     -7.7F, -7.9F, -7.4F, -6.2F, -4.2F, -1.4F, 1.9F,  5.5F,  9.4F,  13.2F, 16.9F, 20.3F, 23.4F,
     26.2F, 28.6F, 30.6F, 32.3F, 33.5F, 34.2F, 34.4F, 34.1F, 33.5F, 32.8F, 32.2F, 31.9F},
    {2.4F,  4.5F,  6.9F,  9.8F,  13.4F, 16.4F, 17.8F, 17.9F, 17.3F, 16.6F, 15.7F, 14.7F, 13.4F,
     11.9F, 10.4F, 9.0F,  7.6F,  6.4F,  5.4F,  4.5F,  3.9F,  3.7F,  3.8F,  4.4F,  5.6F,  7.5F,
     10.0F, 13.4F, 17.9F, 23.5F, 30.2F, 37.4F, 44.6F, 51.1F, 56.3F, 59.9F, 61.9F, 62.4F, 61.5F,
     59.3F, 56.0F, 51.5F, 46.1F, 39.6F, 32.3F, 24.5F, 16.5F, 9.5F,  4.3F,  2.0F,  2.4F},
    {2.9F, 1.6F, -1.7F, -3.8F, -3.0F, -0.8F, 1.3F,   3.0F,   4.5F,  5.7F,  6.7F,  7.5F,  8.2F,
     8.7F, 9.1F, 9.6F,  10.0F, 10.4F, 10.7F, 11.1F,  11.4F,  11.6F, 11.7F, 11.6F, 11.3F, 10.6F,
     9.3F, 7.2F, 4.1F,  0.1F,  -4.4F, -8.4F, -10.6F, -10.5F, -8.4F, -5.7F, -3.0F, -0.7F, 1.5F,
     3.3F, 4.7F, 5.8F,  6.3F,  6.4F,  6.0F,  5.0F,   3.8F,   2.7F,  2.4F,  2.6F,  2.9F},
    12};

/// Fukuchi, Fukuchi & Duarte 2017, PeerJ 5:e3298 (CC BY 4.0): running at 2.5 m/s, 31 people.
inline constexpr GaitTable kRunTable = {
    {32.9F, 32.2F, 31.8F, 31.6F, 31.7F, 31.7F, 31.3F, 30.2F, 28.5F, 26.2F, 23.5F, 20.5F, 17.2F,
     13.8F, 10.3F, 7.1F,  4.1F,  1.5F,  -0.5F, -2.0F, -2.9F, -3.3F, -3.1F, -2.4F, -1.2F, 0.1F,
     1.6F,  3.2F,  5.1F,  7.3F,  10.0F, 13.4F, 17.4F, 21.7F, 26.1F, 30.1F, 33.8F, 37.0F, 39.6F,
     41.6F, 42.9F, 43.5F, 43.4F, 42.7F, 41.4F, 39.7F, 37.9F, 36.3F, 34.9F, 33.8F, 33.0F},
    {10.7F, 13.5F, 18.0F, 23.7F, 29.9F, 35.5F, 39.6F, 42.0F, 42.9F, 42.6F, 41.3F, 39.1F, 36.2F,
     32.7F, 29.0F, 25.2F, 21.6F, 18.5F, 16.4F, 15.4F, 15.8F, 17.8F, 21.3F, 26.4F, 32.7F, 39.9F,
     47.4F, 55.0F, 62.4F, 69.5F, 76.0F, 81.7F, 86.5F, 90.0F, 92.1F, 92.6F, 91.4F, 88.8F, 84.7F,
     79.4F, 72.9F, 65.3F, 56.9F, 47.9F, 38.6F, 29.7F, 21.7F, 15.4F, 11.4F, 9.9F,  10.7F},
    {2.8F,   1.7F,   1.5F,   3.2F,   6.4F,   10.2F,  13.8F,  16.9F,  19.4F,  21.3F,  22.4F,
     22.6F,  21.6F,  19.4F,  15.9F,  11.3F,  6.0F,   0.2F,   -5.3F,  -10.2F, -14.0F, -16.6F,
     -18.2F, -18.8F, -18.6F, -17.9F, -16.9F, -16.0F, -14.9F, -13.7F, -12.1F, -10.2F, -8.0F,
     -5.9F,  -4.0F,  -2.4F,  -1.0F,  0.2F,   1.1F,   1.7F,   2.1F,   2.4F,   2.7F,   2.9F,
     3.3F,   3.5F,   3.6F,   3.7F,   3.6F,   3.5F,   2.8F},
    11};

}  // namespace throng::skinning
