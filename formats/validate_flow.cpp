#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "formats/findings.h"
#include "formats/mask.h"
#include "formats/raster.h"

namespace throng::formats {

namespace {

constexpr double kFlowScale = 64;
constexpr double kFlowZero = 32768;
/// Rounding of flow and boxes, and pixels whose middle is just outside of the outline.
constexpr double kFlowSlackPx = 2;

}  // namespace

void FlowCheck::add(const DatasetInfo& info, const Image& image, Findings& findings) {
  Before& before = cameras_[image.camera];
  const bool follows = before.run == image.run && before.frame + 1 == image.frame;
  for (const Person& person : image.people) {
    const auto led = before.people.find(person.track_id);
    if (!follows || led == before.people.end()) continue;
    const Led& to = led->second;
    const Box& box = person.amodal;
    if (to.left < box.x - kFlowSlackPx || to.top < box.y - kFlowSlackPx ||
        to.right > box.x + box.width + kFlowSlackPx ||
        to.bottom > box.y + box.height + kFlowSlackPx) {
      findings.add("flow-leads-to-boxes", before.file, fmt::format("annotation {}", person.id),
                   fmt::format("flow leads to [{:.1f}, {:.1f}] x [{:.1f}, {:.1f}], out of its "
                               "bbox_amodal in the next frame",
                               to.left, to.right, to.top, to.bottom));
    }
  }
  const std::filesystem::path file = raster_path(info.root, "flow", image.file);
  before = {image.run, image.frame, file.lexically_relative(info.root).string(), {}};
  const Raster flow = read_raster(file);
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  if (flow.samples.size() != 3 * pixels) return;  // a finding of another rule
  for (const Person& person : image.people) {
    const Bitmap mask = bitmap_of(runs_of(person.mask, pixels), image.height);
    Led led;
    for (int y = mask.y; y < mask.y + mask.height; ++y) {
      for (int x = mask.x; x < mask.x + mask.width; ++x) {
        const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(x);
        const std::uint16_t* sample = flow.samples.data() + 3 * at;
        if (!mask.at(x, y) || sample[2] == 0) continue;
        const double u = x + 0.5 + (sample[0] - kFlowZero) / kFlowScale;
        const double v = y + 0.5 + (sample[1] - kFlowZero) / kFlowScale;
        led.left = std::min(led.left, u);
        led.right = std::max(led.right, u);
        led.top = std::min(led.top, v);
        led.bottom = std::max(led.bottom, v);
      }
    }
    if (led.left <= led.right) before.people[person.track_id] = led;
  }
}

}  // namespace throng::formats
