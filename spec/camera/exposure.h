// How long a frame is exposed and read out (render/lens/exposure.h renders it).
#pragma once

namespace throng::camera {

struct Exposure {
  double exposure_s = 0;  ///< how long each row gathers light; 0: an instant
  /// From the first row's reading to the last's; 0: all rows at once. The middle of the middle
  /// row's exposure is the frame's time, other rows' are earlier (above) or later.
  double readout_s = 0;
};

}  // namespace throng::camera
