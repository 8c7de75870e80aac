#include "render/light/probe_grid.h"

#include <algorithm>
#include <cmath>

#include "world/stand_seats.h"

namespace throng::render {

namespace {

constexpr float kOpenM = 40;

/// Above this (m) there is the open air's light.
constexpr float kTopM = 6;

LightField mixed(const LightField& a, const LightField& b, float share) {
  return {a.even * (1 - share) + b.even * share, a.toward * (1 - share) + b.toward * share};
}

}  // namespace

ProbeGrid::ProbeGrid(const Eigen::AlignedBox2d& ground, std::span<const world::Stand> stands,
                     bool with_probes) {
  if (!with_probes) return;
  constexpr double kSpacingM = 2;
  constexpr double kMaxColumns = 6000;
  const double area_m2 = ground.sizes().prod();
  const double spacing = std::max(kSpacingM, std::sqrt(area_m2 / kMaxColumns));
  spacing_m_ = static_cast<float>(spacing);
  count_ = (ground.sizes().array() / spacing).ceil().cast<int>().max(1) + 1;
  from_ = ground.min().cast<float>();
  const auto columns = static_cast<std::size_t>(count_.prod());
  fields_.resize(2 * columns + 1);
  if (stands.empty()) return;
  floor_m_.resize(columns);
  for (std::size_t i = 0; i < columns; ++i) {
    floor_m_[i] =
        static_cast<float>(world::elevation_m(stands, position(i).head<2>().cast<double>()));
  }
}

Eigen::Vector3f ProbeGrid::position(std::size_t probe) const {
  const auto layer = static_cast<std::size_t>(count_.prod());
  if (probe == 2 * layer) {
    const Eigen::Vector2f middle =
        from_ + 0.5F * spacing_m_ * (count_.cast<float>() - Eigen::Vector2f::Ones());
    return {middle.x(), middle.y(), kOpenM};
  }
  const auto column = static_cast<int>(probe % layer);
  const int row = column / count_.x();
  const float floor_m = floor_m_.empty() ? 0.0F : floor_m_[probe % layer];
  return {from_.x() + spacing_m_ * static_cast<float>(column % count_.x()),
          from_.y() + spacing_m_ * static_cast<float>(row), floor_m + kHeightsM.at(probe / layer)};
}

void ProbeGrid::set(const std::vector<std::optional<LightField>>& fields) {
  std::vector<std::optional<LightField>> known = fields;
  const int layer = count_.prod();
  // Light spreads a few probes into buildings.
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::optional<LightField>> next = known;
    for (int i = 0; i < 2 * layer; ++i) {
      if (known[static_cast<std::size_t>(i)]) continue;
      const int x = i % layer % count_.x();
      const int y = i % layer / count_.x();
      LightField sum;
      float count = 0;
      for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
        if (x + dx < 0 || x + dx >= count_.x() || y + dy < 0 || y + dy >= count_.y()) continue;
        const auto& near =
            known[static_cast<std::size_t>(i) + static_cast<std::size_t>(dx + dy * count_.x())];
        if (!near) continue;
        sum.even += near->even;
        sum.toward += near->toward;
        ++count;
      }
      if (count > 0)
        next[static_cast<std::size_t>(i)] = LightField{sum.even / count, sum.toward / count};
    }
    known = std::move(next);
  }
  for (std::size_t i = 0; i < fields_.size(); ++i) fields_[i] = known[i].value_or(LightField{});
}

LightField ProbeGrid::at(const Eigen::Vector3f& point) const {
  if (fields_.size() == 1) return fields_[0];
  const Eigen::Array2f place = (point.head<2>() - from_).array() / spacing_m_;
  const Eigen::Array2f last = (count_ - Eigen::Vector2i::Ones()).cast<float>().array();
  const Eigen::Array2f inside = place.max(0.0F).min(last);
  const Eigen::Array2i cell = inside.cast<int>().min(count_.array() - 2).max(0);
  const Eigen::Array2f share = inside - cell.cast<float>();
  const auto column = [&](int dx, int dy) {
    const int x = std::min(cell.x() + dx, count_.x() - 1);
    const int y = std::min(cell.y() + dy, count_.y() - 1);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(count_.x()) +
           static_cast<std::size_t>(x);
  };
  const auto in_layer = [&](std::size_t level) {
    const LightField* layer = &fields_[level * static_cast<std::size_t>(count_.prod())];
    return mixed(mixed(layer[column(0, 0)], layer[column(1, 0)], share.x()),
                 mixed(layer[column(0, 1)], layer[column(1, 1)], share.x()), share.y());
  };
  float height_m = point.z();
  if (!floor_m_.empty()) {
    height_m -=
        std::lerp(std::lerp(floor_m_[column(0, 0)], floor_m_[column(1, 0)], share.x()),
                  std::lerp(floor_m_[column(0, 1)], floor_m_[column(1, 1)], share.x()), share.y());
  }
  // Beyond the ground there is open land.
  const float outside_m = spacing_m_ * (place - inside).matrix().norm();
  const float above = std::clamp((height_m - kHeightsM[1]) / (kTopM - kHeightsM[1]), 0.0F, 1.0F);
  const float away = std::max(above, std::clamp(outside_m / 10, 0.0F, 1.0F));
  if (away >= 1) return fields_.back();
  const float up =
      std::clamp((height_m - kHeightsM[0]) / (kHeightsM[1] - kHeightsM[0]), 0.0F, 1.0F);
  return mixed(mixed(in_layer(0), in_layer(1), up), fields_.back(), away);
}

void ProbeGrid::expose(float exposure) {
  for (LightField& field : fields_) {
    field.even *= exposure;
    field.toward *= exposure;
  }
}

}  // namespace throng::render
