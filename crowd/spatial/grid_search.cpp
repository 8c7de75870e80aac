// The search for the nearest neighbors. Everybody within reach is collected, several at a time and
// without branches that a processor could not foresee; their order is then found by counting for
// each how many are nearer, which for so few is faster than sorting.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/compute/simd.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

Grid::Candidates::Candidates(std::size_t max_neighbors) { make_room(max_neighbors); }

void Grid::Candidates::make_room(std::size_t max_neighbors) {
  constexpr std::size_t kMore = 128;  // than are wanted may be within reach
  const std::size_t capacity = max_neighbors + max_neighbors / 2 + kMore;
  if (slot_.size() >= capacity) return;
  distance_sq_.resize(capacity);
  slot_.resize(capacity);
  sorted_.resize(capacity);
}

struct NearestKernel {
  using Candidates = Grid::Candidates;
  using Neighbor = Grid::Neighbor;

  /// A place to search.
  struct Query {
    float x = 0;
    float y = 0;
    float limit_sq = 0;  // m^2; those further away are not wanted
    std::size_t self = 0;
    std::size_t max_neighbors = 0;
  };

  template <int kWidth>
  static std::span<const Neighbor> run(const Grid& grid, std::size_t slot, float range,
                                       std::size_t max_neighbors, float& reach,
                                       Candidates& candidates) {
    if (max_neighbors == 0 || !(range > 0)) return {};
    candidates.make_room(max_neighbors);
    constexpr float kMinReach = 0.5F;  // m
    float radius = std::clamp(reach, std::min(kMinReach, range), range);
    collect<kWidth>(grid, slot, radius, max_neighbors, candidates);
    while (candidates.count_ < max_neighbors && radius < range) {
      radius = std::min(2 * radius, range);
      collect<kWidth>(grid, slot, radius, max_neighbors, candidates);
    }
    sort<kWidth>(grid, candidates);
    std::size_t count = std::min(max_neighbors, candidates.count_);
    const std::vector<Neighbor>& sorted = candidates.sorted_;
    while (count > 0 && !(sorted[count - 1].distance_sq < range * range)) --count;
    constexpr float kMargin = 1.1F;  // people move a little between steps
    reach = count == max_neighbors ? kMargin * std::sqrt(sorted[count - 1].distance_sq) : range;
    return {sorted.data(), count};
  }

 private:
  /// Finds everybody within the radius; if they are too many for the candidates' memory, at least
  /// the `max_neighbors` nearest of them.
  template <int kWidth>
  static void collect(const Grid& grid, std::size_t slot, float radius, std::size_t max_neighbors,
                      Candidates& candidates) {
    Query place{grid.x_[slot], grid.y_[slot], radius * radius, slot, max_neighbors};
    candidates.count_ = 0;
    grid.for_each_run(grid.position(slot), radius,
                      [&](std::size_t begin, std::size_t end, std::optional<int> row) {
                        if (row) {
                          scan<kWidth, true>(grid, begin, end, *row, place, candidates);
                        } else {
                          scan<kWidth, false>(grid, begin, end, 0, place, candidates);
                        }
                      });
  }

  /// Adds those in the slots from `begin` to `end` that are near enough; with kRow, only those of
  /// the row, since buckets may be shared with others, which would be found twice.
  template <int kWidth, bool kRow>
  static void scan(const Grid& grid, std::size_t begin, std::size_t end, int row, Query& place,
                   Candidates& candidates) {
    while (begin < end) {
      std::size_t room = candidates.slot_.size() - candidates.count_;
      if (room < 2 * kWidth) {
        keep_nearest<kWidth>(grid, place, candidates);
        room = candidates.slot_.size() - candidates.count_;
      }
      // Whole vectors, so that the next ones start where these end.
      const std::size_t stop = std::min(end, begin + (room / kWidth - 1) * kWidth);
      scan_some<kWidth, kRow>(grid, begin, stop, row, place, candidates);
      begin = stop;
    }
  }

  /// The same where there is room for all. Whole vectors are looked at: what follows the last slot
  /// is of other rows, or too far away.
  template <int kWidth, bool kRow>
  static void scan_some(const Grid& grid, std::size_t begin, std::size_t end, int row,
                        const Query& place, Candidates& candidates) {
    using V = Vectors<kWidth>;
    const auto x = broadcast<kWidth>(place.x);
    const auto y = broadcast<kWidth>(place.y);
    const auto limit_sq = broadcast<kWidth>(place.limit_sq);
    const float* const xs = grid.x_.data();
    const float* const ys = grid.y_.data();
    const std::int32_t* const rows = grid.row_.data();
    float* const distances = candidates.distance_sq_.data();
    std::int32_t* const slots = candidates.slot_.data();
    std::size_t count = candidates.count_;
    for (std::size_t at = begin; at < end; at += kWidth) {
      const typename V::Float dx = load<kWidth>(xs + at) - x;
      const typename V::Float dy = load<kWidth>(ys + at) - y;
      const typename V::Float distance_sq = dx * dx + dy * dy;
      const typename V::Int slot = V::kIndex + static_cast<std::int32_t>(at);
      typename V::Int wanted = distance_sq <= limit_sq;
      wanted &= slot != static_cast<std::int32_t>(place.self);
      if constexpr (kRow) {
        wanted &= load<kWidth>(rows + at) == row;
      } else {
        wanted &= slot < static_cast<std::int32_t>(end);
      }
      count += compress_store<kWidth>(distance_sq, slot, wanted, distances + count, slots + count);
    }
    candidates.count_ = count;
  }

  /// Makes room.
  template <int kWidth>
  static void keep_nearest(const Grid& grid, Query& place, Candidates& candidates) {
    sort<kWidth>(grid, candidates);
    const std::size_t kept = std::min(place.max_neighbors, candidates.count_);
    for (std::size_t i = 0; i < kept; ++i) {
      candidates.distance_sq_[i] = candidates.sorted_[i].distance_sq;
      candidates.slot_[i] = static_cast<std::int32_t>(candidates.sorted_[i].slot);
    }
    candidates.count_ = kept;
    if (kept == place.max_neighbors) place.limit_sq = candidates.distance_sq_[kept - 1];
  }

  /// Fills sorted_.
  template <int kWidth>
  static void sort(const Grid& grid, Candidates& candidates) {
    constexpr std::size_t kFew = 128;
    if (candidates.count_ <= kFew && sort_few<kWidth>(candidates)) return;
    const auto end = candidates.sorted_.begin() + static_cast<std::ptrdiff_t>(candidates.count_);
    for (std::size_t i = 0; i < candidates.count_; ++i) {
      candidates.sorted_[i] = {candidates.distance_sq_[i],
                               static_cast<std::uint32_t>(candidates.slot_[i])};
    }
    std::sort(candidates.sorted_.begin(), end, [&grid](const Neighbor& a, const Neighbor& b) {
      return a.distance_sq != b.distance_sq ? a.distance_sq < b.distance_sq
                                            : grid.id_[a.slot] < grid.id_[b.slot];
    });
  }

  /// False when two are equally far.
  template <int kWidth>
  static bool sort_few(Candidates& candidates) {
    using V = Vectors<kWidth>;
    const std::size_t count = candidates.count_;
    std::size_t ranks = 0;
    for (std::size_t at = 0; at < count; at += kWidth) {
      const typename V::Float mine = load<kWidth>(&candidates.distance_sq_[at]);
      typename V::Int nearer{};
      for (std::size_t i = 0; i < count; ++i) nearer -= candidates.distance_sq_[i] < mine;
      std::array<std::int32_t, kWidth> rank;
      store(nearer, rank.data());
      const std::size_t end = std::min<std::size_t>(count - at, kWidth);
      for (std::size_t i = 0; i < end; ++i) {
        const auto place = static_cast<std::size_t>(rank[i]);
        candidates.sorted_[place] = {candidates.distance_sq_[at + i],
                                     static_cast<std::uint32_t>(candidates.slot_[at + i])};
        ranks += place;
      }
    }
    return 2 * ranks == count * (count - 1);
  }
};

Grid::Nearest* Grid::pick_nearest(InstructionSet set) {
  return Versions<NearestKernel, Nearest>::pick(set);
}

}  // namespace throng::crowd
