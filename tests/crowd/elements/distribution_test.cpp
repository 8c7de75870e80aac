// Distributions: their shapes against closed forms (Kolmogorov and Smirnov), their limits, and how
// the files write them.
#include "crowd/elements/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using Kind = Distribution::Kind;
using Share = std::function<double(double)>;  // of values below x

constexpr double kNone = std::numeric_limits<double>::infinity();

struct Shape {
  std::string name;
  Distribution distribution;
  Share below;
};

std::ostream& operator<<(std::ostream& out, const Shape& shape) { return out << shape.name; }

double normal_below(double x, double mean, double stddev) {
  return 0.5 * std::erfc((mean - x) / (stddev * std::sqrt(2.0)));
}

/// The same between limits.
Share cut(const Share& below, double low, double high) {
  return [=](double x) {
    return (below(std::clamp(x, low, high)) - below(low)) / (below(high) - below(low));
  };
}

std::vector<Shape> shapes() {
  const Share lognormal = [](double x) { return x > 0 ? normal_below(std::log(x), 3.5, 0.6) : 0; };
  const Share weibull = [](double x) { return x > 0 ? 1 - std::exp(-std::pow(x / 50, 1.8)) : 0; };
  const Share gamma = [](double x) {  // of a whole shape: Erlang's
    const double y = x / 12;
    return x > 0 ? 1 - std::exp(-y) * (1 + y + y * y / 2) : 0;
  };
  const Share exponential = [](double x) { return x > 0 ? 1 - std::exp(-x / 20) : 0; };
  const Share normal = [](double x) { return normal_below(x, 40, 15); };
  return {
      {"lognormal", {Kind::lognormal, 3.5, 0.6, {}}, lognormal},
      {"lognormal_cut", {Kind::lognormal, 3.5, 0.6, {}, 20, 90}, cut(lognormal, 20, 90)},
      {"weibull", {Kind::weibull, 1.8, 50, {}}, weibull},
      {"weibull_cut", {Kind::weibull, 1.8, 50, {}, 30, kNone}, cut(weibull, 30, 1e9)},
      {"gamma", {Kind::gamma, 3, 12, {}}, gamma},
      {"gamma_cut", {Kind::gamma, 3, 12, {}, 0, 25}, cut(gamma, 0, 25)},
      {"exponential", {Kind::exponential, 20, 0, {}}, exponential},
      {"exponential_cut", {Kind::exponential, 20, 0, {}, 5, 15}, cut(exponential, 5, 15)},
      {"normal_cut", {Kind::normal, 40, 15, {}, 30, kNone}, cut(normal, 30, 85)},
  };
}

/// The largest distance between the shares of these values below x and those that should be.
double worst_share(std::vector<double> values, const Share& below) {
  std::sort(values.begin(), values.end());
  const auto count = static_cast<double>(values.size());
  double worst = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double share = below(values[i]);
    worst = std::max({worst, std::abs(share - static_cast<double>(i) / count),
                      std::abs(share - static_cast<double>(i + 1) / count)});
  }
  return worst;
}

class Shapes : public testing::TestWithParam<Shape> {};

TEST_P(Shapes, AreThoseOfTheClosedForms) {
  constexpr int kCount = 20000;
  const double significant = 1.63 / std::sqrt(kCount);  // reached once in a hundred by chance
  const Distribution& drawn = GetParam().distribution;
  std::vector<double> values;
  std::vector<double> as_menge;
  MengeRandom sequence(7);
  for (int i = 0; i < kCount; ++i) {
    values.push_back(drawn.sample(Random(7, Stream::crowd_behavior, i)));
    as_menge.push_back(drawn.sample(sequence));
  }
  EXPECT_LT(worst_share(values, GetParam().below), significant);
  EXPECT_LT(worst_share(as_menge, GetParam().below), significant);
  EXPECT_GE(*std::min_element(values.begin(), values.end()), std::max(drawn.at_least, 0.0));
  EXPECT_LE(*std::max_element(values.begin(), values.end()), drawn.at_most);
}

INSTANTIATE_TEST_SUITE_P(Distributions, Shapes, testing::ValuesIn(shapes()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Distribution, KnowsItsShareBetweenLimits) {
  EXPECT_NEAR((Distribution{Kind::exponential, 10, 0, {}, 10, 20}.share_between_limits()),
              std::exp(-1) - std::exp(-2), 1e-12);
  EXPECT_NEAR((Distribution{Kind::normal, 0, 1, {}, 0, kNone}.share_between_limits()), 0.5, 0.002);
  EXPECT_EQ((Distribution{Kind::normal, 0, 1, {}, 4, kNone}.share_between_limits()), 0);
}

/// When the agents of a scene leave their first state by a timer with this distribution.
std::vector<double> leave_times(const std::string& distribution, int count,
                                const LoadOptions& options = {}) {
  std::string agents;
  for (int i = 0; i < count; ++i) agents += test::agent_at(3 * i, 0);
  Simulation crowd = test::load(
      test::scene_with(agents, "", "Start", "", 1),
      test::condition_behavior("<Condition type=\"timer\" per_agent=\"1\" " + distribution + "/>"),
      options);
  std::vector<double> times(count, -1);
  while (!crowd.all_final() && crowd.time_s() < 2000) {
    const double now_s = crowd.time_s();
    crowd.step();
    for (std::size_t i = 0; i < times.size(); ++i) {
      if (times[i] < 0 && test::state_name(crowd, i) == "End") times[i] = now_s;
    }
  }
  return times;
}

TEST(Distribution, PremovementTimesCanHaveAnyOfThem) {
  const std::string text = R"(dist="lognormal" log_mean="3.5" log_stddev="0.6" at_most="120")";
  for (const Compat compat : {Compat::none, Compat::menge}) {
    const std::vector<double> times = leave_times(text, 400, {.seed = 3, .compat = compat});
    std::vector<double> sorted = times;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_NEAR(sorted[200], std::exp(3.5), 4) << "the median";
    EXPECT_LE(sorted.back(), 121);
    EXPECT_GE(sorted.front(), 3);
    EXPECT_EQ(times, leave_times(text, 400, {.seed = 3, .compat = compat}));
    EXPECT_NE(times, leave_times(text, 400, {.seed = 4, .compat = compat}));
  }
}

Problem caught_problem(const std::string& distribution) {
  try {
    leave_times(distribution, 1);
  } catch (const InputError& error) {
    return error.problems().front();
  }
  return {};
}

TEST(Distribution, ReportsMistakes) {
  EXPECT_NE(caught_problem(R"(dist="lognromal")").found.find("did you mean lognormal"),
            std::string::npos)
      << caught_problem(R"(dist="lognromal")").found;
  EXPECT_NE(caught_problem(R"(dist="weibull" shape="0" scale="2")").where.find("shape"),
            std::string::npos);
  EXPECT_EQ(caught_problem(R"(dist="gamma" shape="2")").found, "nothing");
  EXPECT_NE(caught_problem(R"(dist="n" mean="10" stddev="1" at_least="20")")
                .found.find("one in a million"),
            std::string::npos);
  EXPECT_FALSE(
      caught_problem(R"(dist="exponential" mean="10" at_least="5" at_most="4")").found.empty());
  EXPECT_TRUE(
      caught_problem(R"(dist="exponential" mean="10" at_least="5" at_most="6")").found.empty());
}

}  // namespace
}  // namespace throng::crowd
