#include "crowd/grid.h"

#include <algorithm>
#include <bit>

namespace throng::crowd {

Grid::Grid(InstructionSet set) : nearest_(pick_nearest(set)) {}

void Grid::build(const Agents& agents) {
  const std::size_t count = agents.count();
  const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(64, 2 * count));
  bucket_mask_ = static_cast<std::uint32_t>(buckets - 1);
  bucket_begin_.assign(buckets + 1, 0);
  bucket_of_.resize(count);

  size_ = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (agents.present[i] == 0) continue;
    const Eigen::Vector2f& p = agents.position[i];
    bucket_of_[i] = bucket(column_of(p.x()), row_of(p.y()));
    ++bucket_begin_[bucket_of_[i]];
    ++size_;
  }
  std::uint32_t end = 0;
  for (std::uint32_t& begin : bucket_begin_) begin = end += begin;

  id_.resize(size_ + kPadding);
  row_.resize(size_ + kPadding);
  x_.resize(size_ + kPadding);
  y_.resize(size_ + kPadding);
  body_.resize(size_);
  radius_.resize(size_);
  // Backwards, so that each bucket's end counts down to its begin and ids ascend within it.
  for (std::size_t i = count; i-- > 0;) {
    if (agents.present[i] == 0) continue;
    const std::uint32_t slot = --bucket_begin_[bucket_of_[i]];
    const Eigen::Vector2f& p = agents.position[i];
    id_[slot] = static_cast<std::uint32_t>(i);
    row_[slot] = row_of(p.y());
    x_[slot] = p.x();
    y_[slot] = p.y();
    body_[slot] = {p, agents.velocity[i]};
    radius_[slot] = agents[Property::radius][i];
  }
}

}  // namespace throng::crowd
