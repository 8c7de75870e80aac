#include "annotate/exits/exit_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "annotate/exits/ground_polygon.h"
#include "base/error.h"
#include "metrics/basis/control_zone.h"
#include "world/trace.h"

namespace throng::annotate {

namespace {

/// The passage's depth: what people stand in while they go out.
constexpr double kDoorDepthM = 0.5;
/// Sides that stand for the zone's half circle.
constexpr int kArcSides = 24;

std::vector<Eigen::Vector2d> zone_outline(const world::Exit& exit) {
  const metrics::ControlZone zone(exit, {});
  const Eigen::Vector2d along(exit.outward.y(), -exit.outward.x());
  std::vector<Eigen::Vector2d> corners;
  for (int i = 0; i <= kArcSides; ++i) {
    const double angle = std::numbers::pi * i / kArcSides;
    corners.emplace_back(zone.middle() + zone.radius_m() * (std::cos(angle) * along -
                                                            std::sin(angle) * exit.outward));
  }
  return with_short_sides(corners);
}

std::vector<Eigen::Vector2d> door_outline(const world::Exit& exit) {
  const Eigen::Vector2d depth = kDoorDepthM * exit.outward;
  return with_short_sides({exit.from, exit.to, exit.to + depth, exit.from + depth});
}

}  // namespace

ExitView::ExitView(const world::Scenario& scenario, std::vector<metrics::ExitSeries> exits,
                   std::vector<double> step_times_s)
    : exits_(std::move(exits)), step_times_s_(std::move(step_times_s)) {
  check(exits_.size() == scenario.exits.size(), "each exit has a series");
  for (const world::Exit& exit : scenario.exits) {
    outlines_.push_back({nlohmann::json(exit.id).dump(), door_outline(exit), zone_outline(exit)});
  }
}

std::string ExitView::json(const camera::Camera& camera, double time_s) const {
  const std::size_t step = step_at(step_times_s_, time_s);
  std::string text = "[";
  for (std::size_t i = 0; i < exits_.size(); ++i) {
    check(step < exits_[i].samples.size(), "an exit has a sample per step");
    const metrics::ExitSample& sample = exits_[i].samples[step];
    fmt::format_to(std::back_inserter(text),
                   R"({}{{"id":{},"state":"{}","in_zone":{},"queue":{},"queue_length_m":{:.2f},)"
                   R"("clogging_index":{:.4f},"flow_per_s":{:.2f},"door":)",
                   i > 0 ? "," : "", outlines_[i].id, metrics::to_string(sample.state),
                   sample.in_zone, sample.queue, sample.queue_length_m, sample.clogging_index,
                   sample.flow_per_s);
    append_ground_polygon(text, outlines_[i].door, camera);
    text += R"(,"zone":)";
    append_ground_polygon(text, outlines_[i].zone, camera);
    text.push_back('}');
  }
  text.push_back(']');
  return text;
}

std::size_t step_at(std::span<const double> step_times_s, double time_s) {
  const auto after =
      std::upper_bound(step_times_s.begin(), step_times_s.end(), time_s + world::kTimeSlackS);
  return after == step_times_s.begin() ? 0
                                       : static_cast<std::size_t>(after - step_times_s.begin()) - 1;
}

}  // namespace throng::annotate
