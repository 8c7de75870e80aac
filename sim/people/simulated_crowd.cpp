#include <utility>

#include "sim/people/crowd_source.h"
#include "sim/people/crowd_trace.h"

namespace throng::sim {

namespace {

class SimulatedCrowd : public CrowdSource {
 public:
  explicit SimulatedCrowd(crowd::Simulation crowd) : crowd_(std::move(crowd)) {}

  double dt_s() const override { return crowd_.dt_s(); }
  world::TraceHeader header(std::uint64_t seed) const override {
    return crowd_header(crowd_, seed);
  }
  world::CrowdStep now() const override { return crowd_step(crowd_); }
  std::span<const Eigen::Vector2f> positions() const override { return crowd_.positions(); }
  std::span<const Eigen::Vector2f> velocities() const override { return crowd_.velocities(); }
  std::span<const std::uint8_t> present() const override { return crowd_.present(); }
  std::span<const crowd::GoalId> goals() const override { return crowd_.goals(); }
  std::span<const crowd::Fall> falls() const override { return crowd_.falls(); }
  std::vector<Problem> warnings() const override { return crowd_.warnings(); }
  bool has_intents() const override { return true; }

  void step() override { crowd_.step(); }
  void set_present(std::size_t agent, bool present) override { crowd_.set_present(agent, present); }
  void move_goal(int set, int goal, const Eigen::Vector2f& center) override {
    crowd_.move_goal(set, goal, center);
  }
  void strike(std::size_t agent, const Eigen::Vector2f& impulse_ns) override {
    crowd_.strike(agent, impulse_ns);
  }

 private:
  crowd::Simulation crowd_;
};

}  // namespace

std::unique_ptr<CrowdSource> simulated(crowd::Simulation crowd) {
  return std::make_unique<SimulatedCrowd>(std::move(crowd));
}

}  // namespace throng::sim
