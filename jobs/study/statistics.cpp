#include "jobs/study/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/compute/random.h"

namespace throng::study {

namespace {

constexpr int kResamples = 10'000;
constexpr int kMaxExact = 60;

// Mean ranks of |difference|, doubled so that they are whole numbers.
std::vector<int> doubled_ranks(const std::vector<double>& differences) {
  std::vector<std::size_t> order(differences.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(differences[a]) < std::abs(differences[b]);
  });
  std::vector<int> ranks(differences.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() &&
           std::abs(differences[order[end]]) == std::abs(differences[order[i]])) {
      ++end;
    }
    for (std::size_t k = i; k < end; ++k) ranks[order[k]] = static_cast<int>(i + 1 + end);
    i = end;
  }
  return ranks;
}

// Share of all assignments of signs whose sum of positive ranks is at most `sum`.
double share_up_to(const std::vector<int>& ranks, int sum) {
  const int total = std::accumulate(ranks.begin(), ranks.end(), 0);
  std::vector<double> share(static_cast<std::size_t>(total) + 1);
  share[0] = 1;
  int reached = 0;
  for (const int rank : ranks) {
    reached += rank;
    for (int s = reached; s >= 0; --s) {
      const double with = s >= rank ? share[static_cast<std::size_t>(s - rank)] : 0;
      share[static_cast<std::size_t>(s)] = 0.5 * (share[static_cast<std::size_t>(s)] + with);
    }
  }
  return std::accumulate(share.begin(), share.begin() + sum + 1, 0.0);
}

double normal_p(const std::vector<int>& ranks, double w_plus) {
  double expected = 0;
  double variance = 0;
  for (const int rank : ranks) {
    expected += 0.25 * rank;
    variance += 0.0625 * rank * rank;
  }
  const double off = std::max(0.0, std::abs(w_plus - expected) - 0.5);
  return std::min(
      1.0, 2 * boost::math::cdf(complement(boost::math::normal(0, std::sqrt(variance)), off)));
}

}  // namespace

Interval bootstrap_mean(const std::vector<double>& values, double confidence, std::uint64_t seed) {
  if (values.empty()) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  std::vector<double> means;
  for (int i = 0; i < kResamples; ++i) {
    Random random(seed, Stream::bootstrap, static_cast<std::uint64_t>(i));
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      sum += values[random.below(static_cast<std::uint32_t>(values.size()))];
    }
    means.push_back(sum / static_cast<double>(values.size()));
  }
  const double tail = 0.5 * (1 - confidence);
  return {quantile(means, tail), quantile(means, 1 - tail)};
}

Interval quantile_interval(std::vector<double> values, double p, double confidence) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Interval interval{-kInfinity, kInfinity};
  if (values.empty()) return interval;
  std::sort(values.begin(), values.end());
  const double tail = 0.5 * (1 - confidence);
  const boost::math::binomial below(static_cast<double>(values.size()), p);
  // The k-th value is above the quantile if fewer than k values are below it.
  for (std::size_t k = 1; k <= values.size(); ++k) {
    if (boost::math::cdf(below, static_cast<double>(k - 1)) > tail) break;
    interval.low = values[k - 1];
  }
  for (std::size_t k = values.size(); k >= 1; --k) {
    if (boost::math::cdf(boost::math::complement(below, static_cast<double>(k - 1))) > tail) break;
    interval.high = values[k - 1];
  }
  return interval;
}

SignedRank wilcoxon_signed_rank(const std::vector<double>& differences) {
  std::vector<double> nonzero;
  std::copy_if(differences.begin(), differences.end(), std::back_inserter(nonzero),
               [](double d) { return d != 0; });
  const std::vector<int> ranks = doubled_ranks(nonzero);
  int plus = 0;
  for (std::size_t i = 0; i < nonzero.size(); ++i) {
    if (nonzero[i] > 0) plus += ranks[i];
  }
  SignedRank result{static_cast<int>(nonzero.size()), 0.5 * plus, 1};
  if (nonzero.empty()) return result;
  const int total = std::accumulate(ranks.begin(), ranks.end(), 0);
  result.p_value = result.n <= kMaxExact
                       ? std::min(1.0, 2 * share_up_to(ranks, std::min(plus, total - plus)))
                       : normal_p(ranks, result.w_plus);
  return result;
}

std::vector<double> holm_adjusted(const std::vector<double>& p_values) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    if (!std::isnan(p_values[i])) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) {
    return p_values[one] < p_values[other];
  });
  std::vector<double> adjusted = p_values;
  double greatest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double tests_left = static_cast<double>(order.size() - rank);
    greatest = std::max(greatest, std::min(1.0, tests_left * p_values[order[rank]]));
    adjusted[order[rank]] = greatest;
  }
  return adjusted;
}

}  // namespace throng::study
