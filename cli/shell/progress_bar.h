// Progress of long work on stderr: a bar on a terminal, a line now and then elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace throng::cli {

/// A line of a bar of at most `columns` - 1 characters.
std::string progress_line(std::string_view title, double fraction, std::string_view note,
                          std::size_t columns);

/// Note of a transfer: "12 of 340 MB".
std::string format_megabytes(std::int64_t done_bytes, std::int64_t total_bytes);

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
