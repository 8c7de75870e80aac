// Comments and column names of trajectory files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace throng::metrics {

/// "# framerate: 16.00 fps", "#frame rate=25", "# 25fps" and the like, in frames per second.
std::optional<double> frame_rate_in(std::string_view comment);

/// The unit of lengths, m, that a comment or a column's name states: "x/cm", "in m", "x [mm]".
std::optional<double> unit_in(std::string_view text);

/// A column's name in small letters, without signs between its words and without its unit:
/// "posx" of "Pos_X [m]".
std::string bare_name(std::string_view name);

/// A text without the mark that some programs begin UTF-8 with.
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace throng::metrics
