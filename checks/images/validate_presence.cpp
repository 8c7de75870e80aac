// Presence in an image, by the images before and after.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "checks/run_checks.h"
#include "formats/dataset/image_camera.h"

namespace throng::checks {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

const formats::Person* find_person(const formats::Image& image, std::int64_t track_id) {
  const auto found =
      std::find_if(image.people.begin(), image.people.end(),
                   [&](const formats::Person& person) { return person.track_id == track_id; });
  return found == image.people.end() ? nullptr : &*found;
}

void check_between(const formats::Image& before, const formats::Image& image,
                   const formats::Image& after, Findings& findings) {
  const camera::Camera camera = formats::image_camera(image);
  for (const formats::Person& then : before.people) {
    const formats::Person* later = find_person(after, then.track_id);
    if (later == nullptr || find_person(image, then.track_id) != nullptr) continue;
    const Vector3d middle = 0.5 * (then.box_middle + later->box_middle);
    const auto seen = camera.project(middle);
    if (!seen.visible || !(seen.depth_m > 1)) continue;
    const Vector2d at = seen.pixel.array() + 0.5;
    // They may have made a detour, or turned back in between: as far as they get at their speeds.
    const double half_m = 0.5 * (then.box_middle - later->box_middle).norm();
    const double walked_m = 0.5 * (after.time_s - before.time_s) *
                            std::max(then.velocity.norm(), later->velocity.norm());
    const double turned_m = std::sqrt(std::max(0.0, walked_m * walked_m - half_m * half_m));
    const bool turns = then.velocity.dot(later->velocity) < 0;
    const double away_m = std::max(0.3 + 0.5 * half_m, turns ? turned_m : 0.0);
    const double margin_px = 4 + away_m * image.camera_matrix(0, 0) / seen.depth_m;
    const auto hidden = std::find_if(
        image.hidden.begin(), image.hidden.end(),
        [&](const formats::HiddenPerson& person) { return person.track_id == then.track_id; });
    const std::string record = fmt::format("image {}", image.id);
    if (hidden == image.hidden.end()) {
      if (at.x() > margin_px && at.y() > margin_px && at.x() < image.width - margin_px &&
          at.y() < image.height - margin_px) {
        findings.add("nobody-left-out", formats::kCocoFile, record,
                     fmt::format("track {} is in the frames before and after and must be near "
                                 "({:.0f}, {:.0f}), but neither has an annotation nor is among the "
                                 "hidden",
                                 then.track_id, at.x(), at.y()));
      }
      continue;
    }
    const formats::Box& box = hidden->amodal;
    const Vector2d in_box = formats::in_amodal_limit(image, at);
    if (in_box.x() < box.x - margin_px || in_box.y() < box.y - margin_px ||
        in_box.x() > box.x + box.width + margin_px || in_box.y() > box.y + box.height + margin_px) {
      findings.add("hidden-box", formats::kCocoFile, record,
                   fmt::format("bbox_amodal of hidden track {} is away from ({:.0f}, {:.0f}), "
                               "where the frames before and after put them",
                               then.track_id, at.x(), at.y()));
    }
  }
}

}  // namespace

void PresenceCheck::add(const formats::Image& image, Findings& findings) {
  std::vector<Moment>& last = last_[image.camera];
  if (!last.empty() &&
      (last.back().image.run != image.run || last.back().image.frame + 1 != image.frame)) {
    last.clear();
  }
  constexpr double kMaxDurationS = 1.1;
  if (last.size() == 2 && image.time_s - last.back().image.time_s <= kMaxDurationS) {
    check_between(last[0].image, last[1].image, image, findings);
  }
  for (const formats::HiddenPerson& hidden : image.hidden) {
    const formats::Box& box = hidden.amodal;
    const bool is_inside = box.x < image.width && box.y < image.height && box.x + box.width > 0 &&
                           box.y + box.height > 0;
    if (find_person(image, hidden.track_id) != nullptr || !is_inside) {
      findings.add("hidden-box", formats::kCocoFile, fmt::format("image {}", image.id),
                   fmt::format("hidden track {} has an annotation or is outside of the image",
                               hidden.track_id));
    }
  }
  if (last.size() == 2) last.erase(last.begin());
  formats::Image light = image;
  for (formats::Person& person : light.people) {
    person.record = nullptr;
    person.mask.clear();
  }
  last.push_back({std::move(light)});
}

}  // namespace throng::checks
