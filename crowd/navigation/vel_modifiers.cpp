#include "crowd/models/fundamental_diagram.h"
#include "crowd/navigation/navigation.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

class Scale : public VelModifier {
 public:
  explicit Scale(float factor) : factor_(factor) {}
  void modify(const Crowd&, std::size_t, PreferredVelocity& preferred) const override {
    preferred.speed *= factor_;
  }

 private:
  float factor_;
};

std::unique_ptr<VelModifier> make_scale(const Element&, const Attributes& attributes,
                                        BehaviorContext&) {
  return std::make_unique<Scale>(attributes.real("scale"));
}

std::vector<VelModifierRegistry::Entry> plain_modifiers() {
  return {
      {"scale", "changes the speed", {number("scale", "factor of the speed", 0, 100)}, make_scale},
  };
}

}  // namespace

const VelModifierRegistry& vel_modifier_registry() {
  static const VelModifierRegistry kRegistry(
      {plain_modifiers(), density_modifiers(), formation_modifiers(), slope_modifiers()});
  return kRegistry;
}

}  // namespace throng::crowd
