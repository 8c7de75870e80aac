#include "annotate/people/head_labels.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "annotate/people/decimals.h"
#include "annotate/people/person_record.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

/// Pixels whose middles are in the box as the record has it, so that readers count the same ones.
Eigen::AlignedBox2i pixels_in(const Eigen::AlignedBox2d& box) {
  const Eigen::AlignedBox2d written = recorded_box(box);
  const auto first = [](double edge) { return static_cast<int>(std::ceil(edge - 0.5)); };
  return {written.min().unaryExpr(first), written.max().unaryExpr(first)};
}

/// The visible share of the person's pixels in these; nothing where there are none.
std::optional<double> visible_share(const render::Frame& frame, const PersonLabel& label,
                                    const Eigen::AlignedBox2i& pixels) {
  const render::PixelMask& whole = *label.person.whole_mask;
  if (whole.set.empty()) return std::nullopt;
  const Eigen::AlignedBox2i common = pixels.intersection(whole.pixels);
  const std::uint32_t own = render::id_of_agent(label.agent);
  std::uint64_t all = 0;
  std::uint64_t visible = 0;
  for (int y = common.min().y(); y < common.max().y(); ++y) {
    for (int x = common.min().x(); x < common.max().x(); ++x) {
      if (!whole.at(x, y)) continue;
      ++all;
      const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width()) +
                         static_cast<std::size_t>(x);
      if (frame.id[pixel] == own) ++visible;
    }
  }
  if (all == 0) return std::nullopt;
  return static_cast<double>(visible) / static_cast<double>(all);
}

}  // namespace

void add_heads(const render::Frame& frame, FrameLabels& labels) {
  for (PersonLabel& label : labels.people) {
    check(label.person.whole_mask != nullptr, "the frame has whole masks");
    HeadLabel& head = label.head.emplace();
    head.box = label.person.head_box;
    if (head.box.isEmpty()) continue;
    head.visibility = visible_share(frame, label, pixels_in(head.box));
  }
}

}  // namespace throng::annotate
