#include <algorithm>
#include <cmath>
#include <utility>

#include "base/compute/random.h"
#include "base/geometry/angle.h"
#include "base/version.h"
#include "sim/people/crowd_source.h"

namespace throng::sim {

using Eigen::Vector2f;

namespace {

constexpr double kMinStepsPerS = 5;
constexpr double kMaxStepsPerS = 60;

// Heads sway by some centimeters with every step, about twice a second: over this time before and
// after, the walked path determines the heading, and over less than kTurnsM it does not.
constexpr double kFacingWindowS = 0.5;
constexpr float kTurnsM = 0.15F;

float any_facing_rad(std::uint64_t seed, std::size_t agent) {
  constexpr std::uint64_t kFacingPart = 0x666163696e67;  // apart from other draws of the stream
  Random random(derive_seed(seed, Stream::crowd_generator, kFacingPart), Stream::crowd_generator,
                agent);
  return static_cast<float>(random.uniform(-EIGEN_PI, EIGEN_PI));
}

void face(const world::Trace& recording, std::size_t agent, float yaw, std::vector<float>& yaws) {
  for (std::size_t step = 0; step < recording.steps(); ++step) {
    yaws[recording.at(step, agent)] = yaw;
  }
}

/// Heading of each person in every frame: along the local path, else as before.
std::vector<float> facings(const world::Trace& recording, std::uint64_t seed) {
  std::vector<float> yaws(recording.position.size(), 0);
  const auto reach =
      static_cast<std::size_t>(std::max(1L, std::lround(kFacingWindowS / recording.header.dt_s)));
  for (std::size_t agent = 0; agent < recording.agents(); ++agent) {
    std::size_t faced_from = recording.steps();  // first frame whose facing is known
    float yaw = 0;
    std::size_t first = 0;
    for (std::size_t step = 0; step < recording.steps(); ++step) {
      if (!recording.present(step, agent)) {
        first = step + 1;
        continue;
      }
      const std::size_t from = std::max(first, step < reach ? 0 : step - reach);
      std::size_t to = step;
      while (to + 1 < recording.steps() && to < step + reach && recording.present(to + 1, agent)) {
        ++to;
      }
      const Vector2f offset = recording.position[recording.at(to, agent)] -
                              recording.position[recording.at(from, agent)];
      if (offset.norm() >= kTurnsM) {
        yaw = std::atan2(offset.y(), offset.x());
        faced_from = std::min(faced_from, step);
      }
      yaws[recording.at(step, agent)] = yaw;
    }
    if (faced_from == recording.steps()) {
      face(recording, agent, any_facing_rad(seed, agent), yaws);
      continue;
    }
    // A person who stands at first faces the later direction of motion.
    for (std::size_t step = 0; step < faced_from; ++step) {
      yaws[recording.at(step, agent)] = yaws[recording.at(faced_from, agent)];
    }
  }
  return yaws;
}

float blend_yaw(float from, float to, float share) {
  return geometry::wrapped_rad(geometry::interpolated_rad(from, to, share));
}

class ReplayedCrowd : public CrowdSource {
 public:
  ReplayedCrowd(std::shared_ptr<const world::Trace> recording, std::uint64_t seed)
      : recording_(std::move(recording)),
        recorded_yaws_(facings(*recording_, seed)),
        dt_s_(replay_step_s(recording_->header.dt_s)),
        allowed_(recording_->agents(), true),
        positions_(recording_->agents(), Vector2f::Zero()),
        velocities_(recording_->agents(), Vector2f::Zero()),
        yaws_(recording_->agents(), 0),
        present_(recording_->agents(), 0),
        goals_(recording_->agents()) {
    take_frame();
  }

  double dt_s() const override { return dt_s_; }

  world::TraceHeader header(std::uint64_t seed) const override {
    world::TraceHeader header = recording_->header;
    header.generator = kGenerator;
    header.seed = seed;
    header.dt_s = dt_s_;
    header.crowd = {};
    header.crowd.model = world::kRecordedCrowd;
    header.state_names = {"Recorded"};
    return header;
  }

  world::CrowdStep now() const override {
    world::CrowdStep step;
    step.position = positions_;
    step.velocity = velocities_;
    step.yaw_rad = yaws_;
    step.desired_speed_mps = recording_->header.pref_speed_mps;
    step.state.assign(positions_.size(), 0);
    step.exit_intent.assign(positions_.size(), -1);
    for (const std::uint8_t there : present_) {
      step.flags.push_back(there != 0 ? world::kPresent : std::uint8_t{0});
    }
    return step;
  }

  std::span<const Vector2f> positions() const override { return positions_; }
  std::span<const Vector2f> velocities() const override { return velocities_; }
  std::span<const std::uint8_t> present() const override { return present_; }
  std::span<const crowd::GoalId> goals() const override { return goals_; }
  std::span<const crowd::Fall> falls() const override { return {}; }
  std::vector<Problem> warnings() const override { return {}; }
  bool has_intents() const override { return false; }

  void step() override {
    ++steps_;
    take_frame();
  }

  void set_present(std::size_t agent, bool present) override {
    allowed_[agent] = present;
    take(agent, moment());
  }

  void move_goal(int /*set*/, int /*goal*/, const Vector2f& /*center*/) override {}
  void strike(std::size_t /*agent*/, const Vector2f& /*impulse_ns*/) override {}

 private:
  // Everybody at the time of the step, from the frames before and after it. People who have left
  // keep their last position: a trace has an entry for everybody.
  void take_frame() {
    const Moment at = moment();
    for (std::size_t i = 0; i < positions_.size(); ++i) take(i, at);
  }

  /// The frames around a time, and the share of the second one.
  struct Moment {
    std::size_t before;
    std::size_t after;
    float share;
  };

  Moment moment() const {
    constexpr double kSameFrame = 1e-6;
    const double at = static_cast<double>(steps_) * dt_s_ / recording_->header.dt_s;
    const auto before = static_cast<std::size_t>(std::floor(at + kSameFrame));
    const double share = at - static_cast<double>(before);
    if (share <= kSameFrame) return {before, before, 0};
    return {before, before + 1, static_cast<float>(share)};
  }

  void take(std::size_t agent, const Moment& at) {
    const world::Trace& from = *recording_;
    const bool there = allowed_[agent] && at.after < from.steps() &&
                       from.present(at.before, agent) && from.present(at.after, agent);
    present_[agent] = there ? 1 : 0;
    velocities_[agent] = Vector2f::Zero();
    if (!there) return;
    const std::size_t a = from.at(at.before, agent);
    const std::size_t b = from.at(at.after, agent);
    const float rest = 1 - at.share;
    positions_[agent] = rest * from.position[a] + at.share * from.position[b];
    velocities_[agent] = rest * from.velocity[a] + at.share * from.velocity[b];
    yaws_[agent] = blend_yaw(recorded_yaws_[a], recorded_yaws_[b], at.share);
  }

  std::shared_ptr<const world::Trace> recording_;
  std::vector<float> recorded_yaws_;
  double dt_s_;
  std::size_t steps_ = 0;
  std::vector<bool> allowed_;
  std::vector<Vector2f> positions_;
  std::vector<Vector2f> velocities_;
  std::vector<float> yaws_;
  std::vector<std::uint8_t> present_;
  std::vector<crowd::GoalId> goals_;
};

}  // namespace

double replay_step_s(double recorded_dt_s) {
  const double rate = 1 / recorded_dt_s;
  if (rate > kMaxStepsPerS) return recorded_dt_s * std::ceil(rate / kMaxStepsPerS);
  if (rate < kMinStepsPerS) return recorded_dt_s / std::ceil(kMinStepsPerS / rate);
  return recorded_dt_s;
}

std::unique_ptr<CrowdSource> replayed(std::shared_ptr<const world::Trace> recording,
                                      std::uint64_t seed) {
  return std::make_unique<ReplayedCrowd>(std::move(recording), seed);
}

}  // namespace throng::sim
