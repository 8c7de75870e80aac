// Fast output of rounded numbers: the records hold so many of them that a general formatting
// library would dominate the time of writing.
#pragma once

#include <Eigen/Core>
#include <string>

namespace throng::annotate {

/// Decimals of positions (m).
inline constexpr int kMeterDecimals = 3;
/// Decimals of 3-D boxes (m), velocities (m/s) and headings (rad).
inline constexpr int kBodyDecimals = 2;
/// Decimals of pixel coordinates. Boxes of other formats are compared to 0.01 pixels.
inline constexpr int kPixelDecimals = 2;
/// Decimals of times (s), as sums of steps have rounding errors.
inline constexpr int kTimeDecimals = 6;
/// Decimals of shares (0 to 1).
inline constexpr int kShareDecimals = 4;

/// The value that append_decimal() writes, for values that must agree with a record to the last
/// bit.
double rounded(double value, int decimals);

/// Appends the number rounded to `decimals` (0 to 9), without trailing zeros. Fails a check() for
/// NaN, infinities and values beyond 1e9.
void append_decimal(std::string& text, double value, int decimals);

/// Appends a vector as a JSON array of such numbers.
template <typename Vector>
void append_decimals(std::string& text, const Vector& values, int decimals) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    text.push_back(i == 0 ? '[' : ',');
    append_decimal(text, static_cast<double>(values[i]), decimals);
  }
  text.push_back(']');
}

}  // namespace throng::annotate
