#include "crowd/elements/distribution.h"

#include <algorithm>
#include <array>
#include <boost/math/distributions/exponential.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <cmath>

#include "base/error.h"

namespace throng::crowd {

namespace {

constexpr double kDeviations = 3;  // a normal value is no farther from the mean

double cut_off(double value, double mean, double stddev) {
  return std::clamp(value, mean - kDeviations * stddev, mean + kDeviations * stddev);
}

using Exactness = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

/// Calls `use` with what Boost.Math knows of a distribution.
template <typename Use>
double with(const Distribution& of, const Use& use) {
  using Kind = Distribution::Kind;
  switch (of.kind) {
    case Kind::normal:
      return use(boost::math::normal_distribution<double, Exactness>(of.first, of.second));
    case Kind::lognormal:
      return use(boost::math::lognormal_distribution<double, Exactness>(of.first, of.second));
    case Kind::weibull:
      return use(boost::math::weibull_distribution<double, Exactness>(of.first, of.second));
    case Kind::gamma:
      return use(boost::math::gamma_distribution<double, Exactness>(of.first, of.second));
    case Kind::exponential:
      return use(boost::math::exponential_distribution<double, Exactness>(1 / of.first));
    default:
      break;
  }
  check(false, "constant and uniform values are sampled without Boost.Math");
  return 0;
}

/// The share of values below x, which may be infinite.
double share_below(const Distribution& of, double x) {
  const bool is_normal = of.kind == Distribution::Kind::normal;
  if (!is_normal && x <= 0) return 0;
  if (std::isinf(x)) return x > 0 ? 1 : 0;
  return with(of, [&](const auto& known) { return boost::math::cdf(known, x); });
}

/// The limits, and of normal values those that all have.
std::pair<double, double> value_limits(const Distribution& of) {
  if (of.kind != Distribution::Kind::normal) return {of.at_least, of.at_most};
  const double farthest = kDeviations * of.second;
  return {std::max(of.at_least, of.first - farthest), std::min(of.at_most, of.first + farthest)};
}

}  // namespace

double Distribution::share_between_limits() const {
  const auto [low, high] = value_limits(*this);
  return low < high ? share_below(*this, high) - share_below(*this, low) : 0;
}

bool Distribution::is_by_quantile() const {
  const bool has_limits = std::isfinite(at_least) || std::isfinite(at_most);
  return kind > Kind::normal || (kind == Kind::normal && has_limits);
}

double Distribution::quantile_between_limits(double unit) const {
  const auto [low, high] = value_limits(*this);
  const double below = share_below(*this, low);
  const double max_share = std::nextafter(1.0, 0.0);  // the quantile of 1 is infinite
  const double share = std::min(below + unit * (share_below(*this, high) - below), max_share);
  if (share <= 0)
    return std::max(low, 0.0);  // never of a normal distribution: its lower limit is finite
  const double value =
      with(*this, [&](const auto& known) { return boost::math::quantile(known, share); });
  return std::clamp(value, low, high);
}

double Distribution::sample(Random random) const {
  if (kind == Kind::constant) return first;
  if (kind == Kind::uniform) return random.uniform(first, second);
  if (is_by_quantile()) return quantile_between_limits(random.uniform());
  return cut_off(random.normal(first, second), first, second);
}

double Distribution::sample(MengeRandom& random) const {
  if (kind == Kind::constant) return first;
  if (kind == Kind::uniform) return first + (second - first) * random.uniform();
  if (is_by_quantile()) return quantile_between_limits(random.uniform());
  return cut_off(first + second * random.normal(), first, second);
}

std::span<const DistributionForm> distribution_forms() {
  using Kind = Distribution::Kind;
  using Parameter = DistributionForm::Parameter;
  constexpr double kMinParameter = 1e-6;
  constexpr double kMaxParameter = 1e5;
  static constexpr std::array<Parameter, 1> kConstant = {{{"value", true, 0, 0, "the value"}}};
  static constexpr std::array<Parameter, 2> kUniform = {
      {{"min", true, 0, 0, "the lowest value"}, {"max", true, 0, 0, "the highest value"}}};
  static constexpr std::array<Parameter, 2> kNormal = {
      {{"mean", true, 0, 0, "of the values"},
       {"stddev", false, 0, kMaxParameter, "standard deviation"}}};
  static constexpr std::array<Parameter, 2> kLognormal = {
      {{"log_mean", false, -20, 20, "mean of the values' natural logarithm"},
       {"log_stddev", false, kMinParameter, 10,
        "standard deviation of the values' natural logarithm"}}};
  static constexpr std::array<Parameter, 2> kWeibull = {
      {{"shape", false, 0.01, 100, "below 1: rarer and rarer; above: more and more likely"},
       {"scale", false, kMinParameter, kMaxParameter, "63 % of the values are below it"}}};
  static constexpr std::array<Parameter, 2> kGamma = {
      {{"shape", false, 0.01, 1e4, "square of the mean over the standard deviation"},
       {"scale", false, kMinParameter, kMaxParameter, "the mean over the shape"}}};
  static constexpr std::array<Parameter, 1> kExponential = {
      {{"mean", false, kMinParameter, kMaxParameter, "of the values"}}};
  static constexpr std::array<DistributionForm, 7> kForms = {{
      {"c", Kind::constant, "always the same", kConstant, false},
      {"u", Kind::uniform, "all alike between two values", kUniform, false},
      {"n", Kind::normal,
       "normal; values farther than three standard deviations from the mean are moved there, or "
       "not sampled at all where there are limits",
       kNormal, true},
      {"lognormal", Kind::lognormal, "the logarithm is normal", kLognormal, true},
      {"weibull", Kind::weibull, "Weibull's", kWeibull, true},
      {"gamma", Kind::gamma, "gamma", kGamma, true},
      {"exponential", Kind::exponential, "as likely at any moment as at any other", kExponential,
       true},
  }};
  return kForms;
}

int Distribution::sample_integer(Random random) const {
  if (kind != Kind::uniform) return static_cast<int>(std::lround(sample(random)));
  const auto count = static_cast<std::uint32_t>(std::lround(second - first)) + 1;
  return static_cast<int>(std::lround(first)) + static_cast<int>(random.below(count));
}

int Distribution::sample_integer(MengeRandom& random) const {
  if (kind != Kind::uniform) return static_cast<int>(std::lround(sample(random)));
  const double count = second - first + 1;
  return static_cast<int>(std::lround(first)) + static_cast<int>(count * random.uniform());
}

Eigen::Vector2f Distribution2::sample(Random random) const {
  const auto x = static_cast<float>(random.uniform(low.x(), high.x()));
  const auto y = static_cast<float>(random.uniform(low.y(), high.y()));
  return {x, y};
}

Eigen::Vector2f Distribution2::sample(MengeRandom& x, MengeRandom& y) const {
  const double width = high.x() - low.x();
  const double height = high.y() - low.y();
  return {low.x() + static_cast<float>(width * x.uniform()),
          low.y() + static_cast<float>(height * y.uniform())};
}

Random Draws::at(std::size_t agent, std::uint32_t entry) const {
  return Random(seed_, Stream::crowd_behavior, (static_cast<std::uint64_t>(agent) << 32) | entry);
}

}  // namespace throng::crowd
