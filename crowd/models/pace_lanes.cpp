#include "crowd/models/disc_lanes.h"
#include "crowd/models/oncoming.h"
#include "crowd/models/pace.h"

namespace throng::crowd {

struct PaceKernel {
  template <int kWidth>
  using Float = typename Vectors<kWidth>::Float;

  template <int kWidth>
  static void run(const Grid& grid, std::span<const Eigen::Vector2f> directions,
                  const LaneBatch& agents, PaceBatch& batch) {
    for (std::size_t first = 0; first < agents.size(); first += kWidth) {
      lanes<kWidth>(grid, directions, agents, first, batch);
    }
  }

  template <int kWidth>
  static void lanes(const Grid& grid, std::span<const Eigen::Vector2f> directions,
                    const LaneBatch& agents, std::size_t first, PaceBatch& batch) {
    constexpr float kMinSq = 1e-12F;  // m^2
    const Float<kWidth> none{};
    Float<kWidth> way_x;
    Float<kWidth> way_y;
    Float<kWidth> reach_sq;
    for (std::size_t i = 0; i < kWidth; ++i) {
      const Pace::View& view = batch.views_[first + i];
      way_x[i] = view.direction.x();
      way_y[i] = view.direction.y();
      reach_sq[i] = view.reach_sq;
    }
    const auto self = discs_in<kWidth>(grid, &agents.slots()[first]);
    const Float<kWidth> count = load<kWidth>(&agents.neighbors()[first]);
    Float<kWidth> along{};
    Float<kWidth> against{};
    for (std::size_t i = 0; i < agents.rows(); ++i) {
      const auto others = agents.row<kWidth>(i, first);
      const auto other = discs_in<kWidth>(grid, others.data());
      const Float<kWidth> apart_x = other.x - self.x;
      const Float<kWidth> apart_y = other.y - self.y;
      const Float<kWidth> distance_sq = apart_x * apart_x + apart_y * apart_y;
      const auto counts = (count > static_cast<float>(i)) & (distance_sq < reach_sq);
      if (!any(counts)) break;  // others are farther still
      // Agents behind get weight 0.
      const Float<kWidth> ahead = greater(way_x * apart_x + way_y * apart_y, none);
      const Float<kWidth> distance = root(greater(distance_sq, none + kMinSq));
      const Float<kWidth> near = ahead / distance * (reach_sq - distance_sq);
      const Float<kWidth> weight = counts ? near : none;
      Float<kWidth> cosine;
      for (std::size_t lane = 0; lane < kWidth; ++lane) {
        const Eigen::Vector2f& way = directions[others[lane]];
        cosine[lane] = way.x() * way_x[lane] + way.y() * way_y[lane];
      }
      const Float<kWidth> opposed = cosine < kOncoming ? weight : none;
      against += opposed;
      along += weight - opposed;
    }
    // The weights in a crowd of density 1.
    const Float<kWidth> inverse = reach_sq > 0 ? 2 / (reach_sq * reach_sq) : none;
    store(along * inverse, &batch.along_[first]);
    store(against * inverse, &batch.against_[first]);
  }
};

PaceBatch::Kernel* PaceBatch::kernel(InstructionSet set) {
  return Versions<PaceKernel, Kernel>::pick(set);
}

}  // namespace throng::crowd
