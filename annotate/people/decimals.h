// Numbers of JSON records, which have so many of them that a formatting library's generality costs
// more than all else.
#pragma once

#include <Eigen/Core>
#include <string>

namespace throng::annotate {

/// Decimals of places, m.
inline constexpr int kMeterDecimals = 3;
/// Decimals of what bodies are as a whole: boxes (m), velocities (m/s), headings (radians).
inline constexpr int kBodyDecimals = 2;
/// Decimals of pixels. Boxes of other formats are compared to 0.01 pixels.
inline constexpr int kPixelDecimals = 2;
/// Decimals of shares.
inline constexpr int kShareDecimals = 4;

/// The number that append_decimal() writes: for what must agree with a record to the last bit.
double rounded(double value, int decimals);

/// Appends the number rounded to `decimals` (0 to 9), last zeros left out. Numbers beyond 1e9 and
/// those that are none fail check(): JSON has no NaN.
void append_decimal(std::string& text, double value, int decimals);

/// The same of a vector, in brackets.
template <typename Vector>
void append_decimals(std::string& text, const Vector& values, int decimals) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    text.push_back(i == 0 ? '[' : ',');
    append_decimal(text, static_cast<double>(values[i]), decimals);
  }
  text.push_back(']');
}

}  // namespace throng::annotate
