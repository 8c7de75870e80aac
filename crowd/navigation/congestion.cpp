#include "crowd/navigation/congestion.h"

#include <algorithm>
#include <cmath>

namespace throng::crowd {

namespace {

constexpr float kSlow = 0.6F;      // of the preferred speed: faster people do not queue
constexpr float kSlowest = 0.05F;  // of the preferred speed

}  // namespace

Congestion::Congestion(const Box& area) : area_(area) {
  constexpr float kMaxCells = 1e6F;
  const Eigen::Vector2f size = area.max - area.min;
  cell_m_ = std::max(1.0F, std::sqrt(size.x() * size.y() / kMaxCells));
  columns_ = 1 + static_cast<int>(size.x() / cell_m_);
  rows_ = 1 + static_cast<int>(size.y() / cell_m_);
  cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

std::size_t Congestion::cell_at(const Eigen::Vector2f& place) const {
  const Eigen::Vector2f at = (place - area_.min) / cell_m_;
  const int column = std::clamp(static_cast<int>(at.x()), 0, columns_ - 1);
  const int row = std::clamp(static_cast<int>(at.y()), 0, rows_ - 1);
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

void Congestion::observe(const Agents& agents) {
  constexpr float kFollow = 0.1F;  // of a change, each time: within about 5 s
  progress_.resize(agents.count(), 1.0F);
  for (std::size_t i = 0; i < agents.count(); ++i) {
    const float wanted = agents.preferred_speed[i];
    const bool walks = agents.present[i] != 0 && wanted > 0;
    const float ahead =
        walks ? agents.velocity[i].dot(agents.preferred_direction[i]) / wanted : 1.0F;
    progress_[i] += kFollow * (std::clamp(ahead, 0.0F, 1.0F) - progress_[i]);
  }
  count(agents);
}

bool Congestion::is_slow(const Agents& agents, std::size_t agent) const {
  return agents.present[agent] != 0 && progress_[agent] < kSlow &&
         area_.contains(agents.position[agent]);
}

void Congestion::count(const Agents& agents) {
  slow_cells_ = 0;
  bool any = false;
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if (!is_slow(agents, i)) continue;
    if (!any) slow_ = {agents.position[i], agents.position[i]};
    any = true;
    slow_.extend(agents.position[i]);
  }
  if (!any) return;
  std::fill(cells_.begin(), cells_.end(), Cell{});
  for (std::size_t i = 0; i < agents.count(); ++i) {
    if (agents.present[i] == 0 || !slow_.contains(agents.position[i])) continue;
    Cell& cell = cells_[cell_at(agents.position[i])];
    cell.people += 1;
    if (is_slow(agents, i)) cell.slowness += 1 / std::max(progress_[i], kSlowest) - 1;
  }
  for (Cell& cell : cells_) {
    if (cell.slowness <= 0) continue;
    // A slow person alone is in nobody's way.
    cell.slowness *= std::min(1.0F, (cell.people - 1) / 2) / cell.people;
    if (cell.slowness > 0) ++slow_cells_;
  }
}

float Congestion::delay_m(const Eigen::Vector2f& a, const Eigen::Vector2f& b) const {
  if (is_nil()) return 0;
  const Eigen::Vector2f low = a.cwiseMin(b);
  const Eigen::Vector2f high = a.cwiseMax(b);
  if ((low.array() > slow_.max.array()).any() || (high.array() < slow_.min.array()).any()) return 0;
  // The part of the way in the box.
  float enter = 0;
  float leave = 1;
  const Eigen::Vector2f way = b - a;
  for (int axis = 0; axis < 2; ++axis) {
    if (way[axis] == 0) continue;
    const float first = (slow_.min[axis] - a[axis]) / way[axis];
    const float last = (slow_.max[axis] - a[axis]) / way[axis];
    enter = std::max(enter, std::min(first, last));
    leave = std::min(leave, std::max(first, last));
  }
  const float length = way.norm() * (leave - enter);
  if (length <= 0) return 0;
  const int steps = 1 + static_cast<int>(2 * length / cell_m_);
  float sum = 0;
  for (int i = 0; i < steps; ++i) {
    const float share = (static_cast<float>(i) + 0.5F) / static_cast<float>(steps);
    sum += cells_[cell_at(a + (enter + share * (leave - enter)) * way)].slowness;
  }
  return sum * length / static_cast<float>(steps);
}

}  // namespace throng::crowd
