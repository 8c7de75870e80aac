#include "annotate/people/hazard_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "annotate/exits/exit_view.h"
#include "annotate/exits/ground_polygon.h"
#include "spec/annotate/outlines.h"

namespace throng::annotate {

namespace {

std::vector<Eigen::Vector2d> circle(const Eigen::Vector2d& center, double radius_m) {
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i < kHazardSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kHazardSides;
    corners.emplace_back(center + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return with_short_sides(corners);
}

}  // namespace

HazardView::HazardView(const world::Scenario& scenario, const world::Trace& trace)
    : hazards_(scenario.disasters), trace_(&trace), inside_s_(trace.agents(), 0) {}

Eigen::Vector2d HazardView::hazard_center(const world::Disaster& hazard, double time_s) const {
  const auto agent = static_cast<std::size_t>(hazard.agent);
  const bool moves = hazard.kind == world::DisasterKind::attacker && agent < trace_->agents();
  if (!moves || trace_->steps() == 0) return hazard.position;
  const std::size_t step = step_at(trace_->time_s, time_s);
  const Eigen::Vector2d here = trace_->position[trace_->at(step, agent)].cast<double>();
  if (step + 1 >= trace_->steps()) return here;
  const double begin_s = trace_->time_s[step];
  const double share =
      std::clamp((time_s - begin_s) / (trace_->time_s[step + 1] - begin_s), 0.0, 1.0);
  const Eigen::Vector2d there = trace_->position[trace_->at(step + 1, agent)].cast<double>();
  return here + share * (there - here);
}

std::vector<HazardView::Reach> HazardView::reaches_at(double time_s) const {
  std::vector<Reach> reaches;
  for (std::size_t i = 0; i < hazards_.size(); ++i) {
    const double radius_m = hazards_[i].reach_m(time_s);
    if (radius_m > 0) reaches.push_back({i, hazard_center(hazards_[i], time_s), radius_m});
  }
  return reaches;
}

void HazardView::advance(double time_s) {
  for (; next_step_ < trace_->steps() && trace_->time_s[next_step_] <= time_s + world::kTimeSlackS;
       ++next_step_) {
    const std::vector<Reach> reaches = reaches_at(trace_->time_s[next_step_]);
    if (reaches.empty()) continue;
    for (std::size_t agent = 0; agent < trace_->agents(); ++agent) {
      if (!trace_->present(next_step_, agent)) continue;
      const Eigen::Vector2d at = trace_->position[trace_->at(next_step_, agent)].cast<double>();
      const bool is_inside = std::any_of(reaches.begin(), reaches.end(), [&](const Reach& reach) {
        return (at - reach.center).norm() <= reach.radius_m;
      });
      if (is_inside) inside_s_[agent] += trace_->header.dt_s;
    }
  }
  now_ = reaches_at(time_s);
}

std::string HazardView::json(const camera::Camera& camera) const {
  std::string text = "[";
  for (const Reach& reach : now_) {
    const world::Disaster& hazard = hazards_[reach.hazard];
    fmt::format_to(std::back_inserter(text),
                   R"({}{{"id":{},"kind":"{}","position":[{:.3f},{:.3f}],"radius_m":{:.3f},)"
                   R"("start_s":{:.3f},"area":)",
                   text.size() > 1 ? "," : "", reach.hazard,
                   world::kDisasterKinds.at(static_cast<std::size_t>(hazard.kind)),
                   reach.center.x(), reach.center.y(), reach.radius_m, hazard.start_s);
    append_ground_polygon(text, circle(reach.center, reach.radius_m), camera);
    text.push_back('}');
  }
  text.push_back(']');
  return text;
}

std::optional<Danger> HazardView::danger(std::uint32_t agent,
                                         const Eigen::Vector2d& position) const {
  std::optional<Danger> nearest;
  for (const Reach& reach : now_) {
    const double distance_m = std::max(0.0, (position - reach.center).norm() - reach.radius_m);
    if (nearest && nearest->distance_m <= distance_m) continue;
    nearest = Danger{reach.hazard, distance_m, 0};
  }
  if (nearest && agent < inside_s_.size()) nearest->inside_s = inside_s_[agent];
  return nearest;
}

}  // namespace throng::annotate
