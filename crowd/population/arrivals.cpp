#include "crowd/population/arrivals.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/compute/random.h"
#include "crowd/behavior/machine.h"
#include "crowd/population/generators.h"

namespace throng::crowd {

namespace {

constexpr double kMaxTime = 1e7;  // s

void check_count(const Element& element, double count) {
  if (count < 1 || count > static_cast<double>(kMaxAgents)) {
    element.fail(fmt::format("{:.6g} arrivals", count),
                 fmt::format("from 1 to {} arrivals", kMaxAgents));
  }
}

/// Evenly spaced, or as independent events: then the gaps are exponential.
std::unique_ptr<ArrivalTimes> make_rate(const Element& element, const Attributes& attributes,
                                        ArrivalContext& context) {
  element.require_no_children();
  const double per_s = attributes.number("per_second");
  const double start_s = attributes.number("start");
  const double end_s = attributes.number("end");
  if (end_s < start_s) {
    element.fail_attribute("end", fmt::format("{}", end_s),
                           fmt::format("at least start, {}", start_s));
  }
  check_count(element, std::ceil((end_s - start_s) * per_s));
  auto made = std::make_unique<ArrivalTimes>();
  const bool regular = attributes.text("process") == "regular";
  Random random(context.seed, Stream::crowd_arrivals, context.first_agent);
  const auto gap_s = [&] { return regular ? 1 / per_s : -std::log1p(-random.uniform()) / per_s; };
  double time_s = regular ? start_s : start_s + gap_s();
  for (; time_s < end_s && made->time_s.size() < kMaxAgents; time_s += gap_s()) {
    made->time_s.push_back(time_s);
  }
  return made;
}

std::unique_ptr<ArrivalTimes> make_table(const Element& element, const Attributes&,
                                         ArrivalContext&) {
  auto made = std::make_unique<ArrivalTimes>();
  for (const Element& child : element.children()) {
    if (child.name() != "At") child.fail_unknown("<At>");
    child.require_no_children();
    const Attributes row(child, {number("time", "when they come, in s", 0, kMaxTime),
                                 optional(integer("count", "how many", 1, kMaxAgents), "1")});
    const auto count = static_cast<std::size_t>(row.integer("count"));
    check_count(child, static_cast<double>(made->time_s.size() + count));
    made->time_s.insert(made->time_s.end(), count, row.number("time"));
  }
  if (made->time_s.empty()) element.fail("an empty table", "at least one <At>");
  std::stable_sort(made->time_s.begin(), made->time_s.end());
  return made;
}

class Arrivals : public Process {
 public:
  explicit Arrivals(ArrivalPlan plan) : plan_(std::move(plan)), order_(plan_.time_s.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return plan_.time_s[a] < plan_.time_s[b];
    });
  }

  void before_decisions(Crowd& crowd, Machine& machine) override {
    if (crowd.time_s() >= plan_.closed_from_s - kRounding) return close(crowd);
    const Agents& agents = crowd.agents;
    bool looked = false;
    while (next_ < order_.size() && due(crowd)) {
      const std::size_t agent = plan_.first + order_[next_];
      if (agents.awaited[agent] == 0) {  // taken out of this run
        ++next_;
        continue;
      }
      if (!looked) look(agents);
      looked = true;
      if (there_.size() >= plan_.max_alive || !find_place(crowd, agent)) return;
      machine.arrive(crowd, agent);
      there_.push_back({agents.position[agent], agents[Property::radius][agent]});
      ++next_;
    }
  }

 private:
  static constexpr double kRounding = 1e-6;  // s

  /// A body that is there.
  struct Body {
    Eigen::Vector2f position;
    float radius;
  };

  void look(const Agents& agents) {
    there_.clear();
    for (std::size_t i = 0; i < agents.count(); ++i) {
      if (agents.present[i] != 0) {
        there_.push_back({agents.position[i], agents[Property::radius][i]});
      }
    }
  }

  // Nobody waits for those who will not come.
  void close(Crowd& crowd) {
    for (; next_ < order_.size(); ++next_) {
      std::uint8_t& awaited = crowd.agents.awaited[plan_.first + order_[next_]];
      crowd.awaited -= awaited;
      awaited = 0;
    }
  }

  bool due(const Crowd& crowd) const {
    return plan_.time_s[order_[next_]] <= crowd.time_s() + kRounding;
  }

  /// Puts the agent where it touches nobody, if there is such a place; they take turns.
  bool find_place(Crowd& crowd, std::size_t agent) {
    for (std::size_t i = 0; i < plan_.places.size(); ++i) {
      const Eigen::Vector2f& place = plan_.places[(turn_ + i) % plan_.places.size()];
      if (!is_free(place, crowd.agents[Property::radius][agent])) continue;
      crowd.agents.position[agent] = place;
      turn_ = (turn_ + i + 1) % plan_.places.size();
      return true;
    }
    return false;
  }

  bool is_free(const Eigen::Vector2f& place, float radius) const {
    return std::none_of(there_.begin(), there_.end(), [&](const Body& body) {
      const float apart = body.radius + radius;
      return (body.position - place).squaredNorm() < apart * apart;
    });
  }

  ArrivalPlan plan_;
  std::vector<Body> there_;         // in this step
  std::vector<std::size_t> order_;  // by time, ties by id
  std::size_t next_ = 0;            // who comes next
  std::size_t turn_ = 0;            // the place to be tried first
};

}  // namespace

const ArrivalRegistry& arrival_registry() {
  static const AttributeTable kCommon = {
      renamed(optional(integer("max_present", "nobody comes while as many agents are present", 1,
                               kMaxAgents),
                       "4000000"),
              "most_alive"),
      optional(
          number("closed_from", "agents that have not arrived by then never do, in s", 0, kMaxTime),
          "1e7"),
      optional(word("in_groups", {"yes", "no"},
                    "whether members of a social group arrive together; no: nobody is in one"),
               "yes")};
  static const ArrivalRegistry kRegistry(
      {{
          {"rate",
           "so many a second",
           {number("per_second", "mean number of arrivals in a second", 1e-6, 1e4),
            optional(number("start", "in s", 0, kMaxTime), "0"), number("end", "in s", 0, kMaxTime),
            optional(word("process", {"poisson", "regular"},
                          "poisson: at random, independent of each other; regular: evenly"),
                     "poisson")},
           make_rate},
          {"table", "as <At time=\"\" count=\"\"/> say", {}, make_table},
      }},
      kCommon);
  return kRegistry;
}

ArrivalPlan load_arrivals(const Element& element, std::vector<Eigen::Vector2f> places,
                          std::size_t first_agent, std::uint64_t seed) {
  ArrivalContext context{seed, first_agent};
  const std::unique_ptr<ArrivalTimes> times = arrival_registry().make(element, context);
  const Attributes attributes(element, arrival_registry().find(element).attributes);
  check_count(element, static_cast<double>(first_agent + times->time_s.size()));
  return {first_agent,
          std::move(times->time_s),
          std::move(places),
          static_cast<std::size_t>(attributes.integer("max_present")),
          attributes.number("closed_from"),
          attributes.text("in_groups") == "yes"};
}

std::unique_ptr<Process> make_arrivals(ArrivalPlan plan, Crowd& crowd) {
  for (std::size_t i = 0; i < plan.time_s.size(); ++i) {
    crowd.agents.present[plan.first + i] = 0;
    crowd.agents.awaited[plan.first + i] = 1;
    if (plan.time_s[i] < plan.closed_from_s) crowd.planned_arrivals_s.push_back(plan.time_s[i]);
  }
  crowd.awaited += plan.time_s.size();
  return std::make_unique<Arrivals>(std::move(plan));
}

}  // namespace throng::crowd
