#include <cmath>

#include "base/compute/random.h"
#include "crowd/models/local_model.h"

namespace throng::crowd {

namespace {

enum Constant : std::size_t { stddev };

/// Nobody minds anybody; for trying out scenes.
class Dummy : public LocalModel {
 public:
  explicit Dummy(const Crowd& crowd)
      : LocalModel(crowd),
        jump_{Distribution::Kind::normal, 0, crowd.model_constants[stddev], {}} {}

 protected:
  Eigen::Vector2f velocity(const Crowd& crowd, const Grid& grid, const AgentView& around) override {
    const Walker self(crowd, grid, around.slot);
    if (jump_.second == 0) return self.preferred_velocity();
    Random random = noise(crowd, self.id);
    const Eigen::Vector2f direction = any_direction(random);
    const auto jump = static_cast<float>(jump_.sample(random));
    return self.preferred_velocity() + jump / static_cast<float>(crowd.dt_s) * direction;
  }

 private:
  Distribution jump_;  // in m
};

std::unique_ptr<Model> make_dummy(const Crowd& crowd) { return std::make_unique<Dummy>(crowd); }

}  // namespace

ModelEntry dummy_model() {
  return {"dummy",
          "Dummy",
          "everybody as if alone, with random steps aside",
          {},
          {{"stddev", 0, 0, 100, "standard deviation of the random steps, in m"}},
          make_dummy};
}

}  // namespace throng::crowd
