// Interpretation of comments and column names of trajectory files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace throng::metrics {

/// The frame rate (1/s) that a comment states, such as "# framerate: 16.00 fps", "#frame rate=25"
/// or "# 25fps".
std::optional<double> frame_rate_in(std::string_view comment);

/// The unit of length, in m, that a comment or a column's name states, such as "x/cm", "in m" or
/// "x [mm]".
std::optional<double> unit_in(std::string_view text);

/// The length in m of a unit's word, with or without brackets: "cm", "[ft]", "Meters".
std::optional<double> unit_of_word(std::string_view word);

/// The unit of length (m) that a column's name ends with: "x_cm", "X [mm]", "pos_x (ft)", "x/m".
std::optional<double> unit_in_name(std::string_view name);

/// The last unit of length in brackets in a text: "x-coordinate (meter [m])".
std::optional<double> last_unit_in(std::string_view text);

/// The length in s of a unit of time, as a word or at the end of a name: "ms", "time [ms]", "t_us".
std::optional<double> time_unit_in(std::string_view name);

/// A column's name in lower case, without separators between its words and without its unit or
/// Vadere's number of a processor: "Pos_X [m]" becomes "posx", "startX-PID1" "startx".
std::string bare_name(std::string_view name);

}  // namespace throng::metrics
