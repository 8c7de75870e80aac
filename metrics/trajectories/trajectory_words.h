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

/// A column's name in lower case, without separators between its words and without its unit: "Pos_X
/// [m]" becomes "posx".
std::string bare_name(std::string_view name);

/// The text without a leading UTF-8 byte order mark.
std::string_view without_byte_order_mark(std::string_view text);

}  // namespace throng::metrics
