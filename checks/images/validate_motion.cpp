// How people move: between consecutive frames of one camera, and at one instant in several.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/geometry/angle.h"
#include "checks/median.h"
#include "checks/shot.h"

namespace throng::checks {

namespace {

using Eigen::Vector2d;

double angle_off(const formats::Person& person) {
  return std::abs(
      geometry::turn_rad(person.heading_rad, std::atan2(person.velocity.y(), person.velocity.x())));
}

/// Velocities of people who go on as they do are their displacements.
void check_velocities(const Shot& before, const Shot& after, Findings& findings) {
  const double dt_s = after.image.time_s - before.image.time_s;
  constexpr double kMaxDurationS = 1.1;  // in longer times people turn and stop
  if (!(dt_s > 0) || dt_s > kMaxDurationS) return;
  // Ratios of steady walkers' motion to their velocity, and what of each is above or below 1 by
  // more than its own error: a speed that changes is somewhere between both, and numbers are
  // rounded.
  std::vector<double> ratios;
  std::vector<double> excesses;
  for (const formats::Person& now : after.image.people) {
    const formats::Person* then = before.find(now.track_id);
    if (then == nullptr) continue;
    const Vector2d moved = (now.position - then->position).head<2>() / dt_s;
    const Vector2d mean = 0.5 * (now.velocity + then->velocity);
    const double change = (now.velocity - then->velocity).norm();
    // A change of speed within the frame may be as large as the difference.
    constexpr double kMaxOffMps = 1.5;
    const double off = (moved - mean).norm();
    if (off > kMaxOffMps + 0.5 * change) {
      findings.add("velocity-is-motion", now,
                   fmt::format("moved ({:.2f}, {:.2f}) m/s since the last frame, but velocity is "
                               "({:.2f}, {:.2f}) m/s now and ({:.2f}, {:.2f}) then",
                               moved.x(), moved.y(), now.velocity.x(), now.velocity.y(),
                               then->velocity.x(), then->velocity.y()));
    }
    constexpr double kSteadyMps = 0.1;
    constexpr double kWalkingMps = 0.5;
    constexpr double kSteadyS = 0.55;  // in longer times a crowd may halt and go on
    // With a rolling shutter, each place is of a time of its own.
    const bool is_timed = dt_s < kSteadyS && before.at_once && after.at_once;
    if (is_timed && change < kSteadyMps && mean.norm() > kWalkingMps) {
      constexpr double kRoundingM = 0.001;
      constexpr double kRoundingMps = 0.005;
      const double error = (0.5 * change + kRoundingM / dt_s + kRoundingMps) / mean.norm();
      ratios.push_back(moved.dot(mean) / mean.squaredNorm());
      const double above = ratios.back() - 1;
      excesses.push_back(std::copysign(std::max(0.0, std::abs(above) - error), above));
    }
  }
  if (ratios.empty()) return;
  const double ratio = median(ratios);
  constexpr double kMaxExcess = 0.015;  // steps aside and turns within the frame
  if (std::abs(median(excesses)) > kMaxExcess + median_error(ratios)) {
    findings.add("velocity-is-motion", formats::kCocoFile, after.record(),
                 fmt::format("steady walkers move {:.3f} times as fast as their velocity says "
                             "(median of {})",
                             ratio, ratios.size()));
  }
}

/// Walkers face where they go.
void check_headings(const Shot& shot, Findings& findings) {
  std::vector<double> angles;
  constexpr double kWalkingMps = 0.6;
  for (const formats::Person& person : shot.image.people) {
    if (person.velocity.norm() < kWalkingMps) continue;
    angles.push_back(angle_off(person));
    constexpr double kBackwardsRad = 2.85;
    if (person.velocity.norm() > 2 * kWalkingMps && angles.back() > kBackwardsRad) {
      findings.add("heading-is-motion", person,
                   fmt::format("walks backwards: heading {:.2f}, velocity ({:.2f}, {:.2f})",
                               person.heading_rad, person.velocity.x(), person.velocity.y()));
    }
  }
  if (angles.empty()) return;
  const double angle = median(angles);
  constexpr double kMaxOffRad = 0.25;
  if (angle > kMaxOffRad + median_error(angles)) {
    findings.add("heading-is-motion", formats::kCocoFile, shot.record(),
                 fmt::format("walkers face {:.2f} rad away from where they go (median of {})",
                             angle, angles.size()));
  }
}

bool is_known(const Shot& shot, std::int64_t track_id) {
  return shot.find(track_id) != nullptr ||
         std::any_of(
             shot.image.hidden.begin(), shot.image.hidden.end(),
             [&](const formats::HiddenPerson& person) { return person.track_id == track_id; });
}

/// People whom one camera shows and the other one must see are in that one's records.
void check_who_is_there(const Shot& shot, const Shot& other, Findings& findings) {
  for (const formats::Person& person : shot.image.people) {
    if (!person.track->contains("attributes")) continue;  // no character
    const auto seen = other.camera.project(person.box_middle);
    const Vector2d at = seen.pixel.array() + 0.5;
    if (!seen.visible || !(seen.depth_m > 1)) continue;
    const double margin_px = 4;
    const bool is_inside = at.x() > margin_px && at.y() > margin_px &&
                           at.x() < other.image.width - margin_px &&
                           at.y() < other.image.height - margin_px;
    if (is_inside && !is_known(other, person.track_id)) {
      findings.add("nobody-left-out", formats::kCocoFile, other.record(),
                   fmt::format("track {} is at ({:.1f}, {:.1f}) there by image {}, but neither has "
                               "an annotation nor is among the hidden",
                               person.track_id, at.x(), at.y(), shot.image.id));
    }
    const Vector2d in_box = formats::in_amodal_limit(other.image, at);
    for (const formats::HiddenPerson& hidden : other.image.hidden) {
      if (hidden.track_id != person.track_id) continue;
      const formats::Box& box = hidden.amodal;
      constexpr double kSlackPx = 1.5;
      if (in_box.x() >= box.x - kSlackPx && in_box.y() >= box.y - kSlackPx &&
          in_box.x() <= box.x + box.width + kSlackPx &&
          in_box.y() <= box.y + box.height + kSlackPx) {
        continue;
      }
      findings.add("hidden-box", formats::kCocoFile, other.record(),
                   fmt::format("bbox_amodal of hidden track {} is not where image {} has them, "
                               "at ({:.1f}, {:.1f})",
                               person.track_id, shot.image.id, at.x(), at.y()));
    }
  }
}

}  // namespace

void check_motion(const Shot& before, const Shot& after, Findings& findings) {
  check_velocities(before, after, findings);
}

void check_facing_motion(const Shot& shot, Findings& findings) { check_headings(shot, findings); }

void check_same_instant(const Shot& a, const Shot& b, Findings& findings) {
  if (!a.at_once || !b.at_once) return;
  for (const formats::Person& person : a.image.people) {
    const formats::Person* same = b.find(person.track_id);
    if (same == nullptr) continue;
    for (const char* key : {"position", "velocity", "heading", "box_3d", "keypoints_3d", "state",
                            "behaviour", "exit"}) {
      const auto one = person.record.find(key);
      const auto two = same->record.find(key);
      const bool has_one = one != person.record.end();
      const bool has_two = two != same->record.end();
      if (has_one == has_two && (!has_one || *one == *two)) continue;
      findings.add("one-instant", *same,
                   fmt::format("{} is not that of annotation {}, the same person at the same time",
                               key, person.id));
      break;
    }
  }
  check_who_is_there(a, b, findings);
  check_who_is_there(b, a, findings);
}

}  // namespace throng::checks
