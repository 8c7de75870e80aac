// Exposure time and readout time of a frame (render/lens/exposure.h renders their effects).
#pragma once

namespace throng::camera {

/// Times of the exposure of a frame.
struct Exposure {
  double exposure_s = 0;  ///< exposure time of each row; 0: an instant
  /// Time from the first row's readout to the last row's; 0: all rows at once (global shutter). The
  /// frame's time is the middle of the center row's exposure; rows above are earlier, rows below
  /// later.
  double readout_s = 0;
  /// Interlaced video: the odd rows show the time this much before the frame's; 0: none does.
  double field_s = 0;
};

}  // namespace throng::camera
