// Progress on stderr: a bar on a terminal, otherwise a line for each tenth.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace throng::cli {

/// The text of a bar, at most `columns` - 1 characters long.
std::string progress_line(std::string_view title, double fraction, std::string_view note,
                          std::size_t columns);

/// The note of a transfer: "12 of 340 MB".
std::string format_megabytes(std::int64_t done_bytes, std::int64_t total_bytes);

/// Shows the progress of one task until destruction.
class ProgressBar {
 public:
  explicit ProgressBar(std::string title);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `fraction` in [0, 1]; `note` describes the current step ("simulating run 2 of 5").
  void show(double fraction, std::string_view note);

 private:
  std::string title_;
  bool terminal_;
  bool drawn_ = false;
  int last_tenth_ = -1;
  std::chrono::steady_clock::time_point last_draw_;
};

}  // namespace throng::cli
