#include "cli/shell/progress_bar.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "base/text/utf8.h"

namespace throng::cli {

namespace {
constexpr int kMaxBarCells = 32;
constexpr int kMaxNoteColumns = 40;
constexpr auto kRedrawEvery = std::chrono::milliseconds(80);
/// Columns of the terminal, where it says so.
std::size_t terminal_columns() {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  const bool is_known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : kUsual;
}

/// The text in exactly so many columns, of a character each.
std::string in_columns(std::string_view text, std::size_t columns) {
  std::string shown = first_characters(text, columns);
  shown.append(columns - character_count(shown), ' ');
  return shown;
}

}  // namespace

std::string progress_line(std::string_view title, double fraction, std::string_view note,
                          std::size_t columns) {
  const std::string percent = fmt::format(" {:3.0f} % ", 100 * fraction);
  // A line as wide as the terminal would break.
  const std::size_t free = columns > percent.size() + 1 ? columns - percent.size() - 1 : 0;
  const std::size_t title_columns = std::min(character_count(title), free / 3);
  const std::size_t note_columns = std::min<std::size_t>(kMaxNoteColumns, free / 2);
  constexpr std::size_t kFrame = 3;  // a space and two brackets
  const std::size_t taken = title_columns + note_columns + kFrame;
  const std::size_t cells = std::min<std::size_t>(kMaxBarCells, free > taken ? free - taken : 0);
  const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(cells));
  const std::string bar =
      cells > 0 ? " [" + std::string(filled, '#') + std::string(cells - filled, '.') + "]" : "";
  return first_characters(
      in_columns(title, title_columns) + bar + percent + in_columns(note, note_columns),
      columns > 0 ? columns - 1 : 0);
}

std::string format_megabytes(std::int64_t done_bytes, std::int64_t total_bytes) {
  constexpr double kMegabyte = 1e6;
  return fmt::format("{:.1f} of {:.1f} MB", static_cast<double>(done_bytes) / kMegabyte,
                     static_cast<double>(total_bytes) / kMegabyte);
}

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
  fmt::print(stderr, "\r{}", progress_line(title_, fraction, note, terminal_columns()));
  std::fflush(stderr);
}

}  // namespace throng::cli
