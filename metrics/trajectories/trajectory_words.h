// Frame rates in comments, and names of columns, of trajectory files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace throng::metrics {

/// The frame rate (1/s) that a comment states, such as "# framerate: 16.00 fps", "#frame rate=25"
/// or "# 25fps".
std::optional<double> frame_rate_in(std::string_view comment);

/// A column's name in lower case, without separators between its words and without its unit or
/// Vadere's number of a processor: "Pos_X [m]" becomes "posx", "startX-PID1" "startx".
std::string bare_name(std::string_view name);

}  // namespace throng::metrics
