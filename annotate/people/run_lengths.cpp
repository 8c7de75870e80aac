#include "annotate/people/run_lengths.h"

namespace throng::annotate {

RunLengths run_lengths(const render::PixelMask& mask, int width, int height) {
  RunLengths lengths = {0};
  bool is_set = false;
  std::uint64_t at = 0;  // pixels that are in runs
  const auto run_to = [&](std::uint64_t position) {
    lengths.back() += static_cast<std::uint32_t>(position - at);
    at = position;
  };
  const auto rows = static_cast<std::uint64_t>(height);
  const auto switch_at = [&](int x, int y) {
    run_to(static_cast<std::uint64_t>(x) * rows + static_cast<std::uint64_t>(y));
    lengths.push_back(0);
    is_set = !is_set;
  };
  if (!mask.set.empty()) {
    for (int x = mask.pixels.min().x(); x < mask.pixels.max().x(); ++x) {
      for (int y = mask.pixels.min().y(); y < mask.pixels.max().y(); ++y) {
        if (mask.at(x, y) != is_set) switch_at(x, y);
      }
      // Below the mask nothing is set; a run that ends with its column may go on in the next.
      if (is_set && mask.pixels.max().y() < height) switch_at(x, mask.pixels.max().y());
      const bool goes_on = is_set && mask.at(x + 1, 0);
      if (is_set && !goes_on) switch_at(x + 1, 0);
    }
  }
  run_to(static_cast<std::uint64_t>(width) * rows);
  if (lengths.size() > 1 && lengths.back() == 0) lengths.pop_back();
  return lengths;
}

std::string coco_counts(const RunLengths& runs) {
  std::string text;
  text.reserve(2 * runs.size() + 8);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::int64_t value = runs[i];
    if (i > 2) value -= runs[i - 2];
    // Groups of five bits, lowest first, until the rest is all sign bits.
    for (bool more = true; more;) {
      std::int64_t group = value & 0x1f;
      value >>= 5;
      more = (group & 0x10) != 0 ? value != -1 : value != 0;
      if (more) group |= 0x20;
      text.push_back(static_cast<char>(group + 48));
    }
  }
  return text;
}

}  // namespace throng::annotate
