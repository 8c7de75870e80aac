#include "cli/progress_bar.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace throng::cli {

namespace {
constexpr int kBarCells = 32;
constexpr auto kRedrawEvery = std::chrono::milliseconds(80);
}  // namespace

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)), terminal_(::isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() {
  if (terminal_ && drawn_) fmt::print(stderr, "\n");
}

void ProgressBar::show(double fraction, std::string_view note) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (!terminal_) {
    const int tenth = static_cast<int>(fraction * 10);
    if (tenth == last_tenth_) return;
    last_tenth_ = tenth;
    fmt::print(stderr, "{}: {:3.0f} % {}\n", title_, 100 * fraction, note);
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (drawn_ && fraction < 1 && now - last_draw_ < kRedrawEvery) return;
  last_draw_ = now;
  drawn_ = true;
  const int filled = static_cast<int>(fraction * kBarCells);
  fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {:3.0f} % {:<40.40}", title_, "", filled, "",
             kBarCells - filled, 100 * fraction, note);
  std::fflush(stderr);
}

}  // namespace throng::cli
