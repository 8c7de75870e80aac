#include <array>

#include "checks/flight_checks.h"
#include "checks/ground_truth_checks.h"
#include "checks/run_checks.h"

namespace throng::checks {

using annotate::GroundTruth;

namespace {

/// A check of one image at a time.
template <void (*check)(const formats::DatasetInfo&, const formats::Image&, const Pixels&,
                        Findings&)>
class PixelCheck : public GroundTruthCheck {
 public:
  void add_pixels(const formats::DatasetInfo& info, const formats::Image& image,
                  const Pixels& pixels, Findings& findings) override {
    check(info, image, pixels, findings);
  }
};

template <typename Check>
std::unique_ptr<GroundTruthCheck> make() {
  return std::make_unique<Check>();
}

constexpr std::array kCheckers = {
    GroundTruthChecker{GroundTruth::actions, make<ActionsCheck>},
    GroundTruthChecker{GroundTruth::density, make<PixelCheck<check_density>>},
    GroundTruthChecker{GroundTruth::exits, make<ExitsCheck>},
    GroundTruthChecker{GroundTruth::fields, make<FieldsCheck>},
    GroundTruthChecker{GroundTruth::counts, make<CountsCheck>},
    GroundTruthChecker{GroundTruth::trajectories, make<TrajectoriesCheck>},
    GroundTruthChecker{GroundTruth::trajectories, make<UnseenCheck>},
    GroundTruthChecker{GroundTruth::events, make<EventsCheck>},
    GroundTruthChecker{GroundTruth::depth, make<PixelCheck<check_depth>>},
    GroundTruthChecker{GroundTruth::instances, make<PixelCheck<check_instances>>},
    GroundTruthChecker{GroundTruth::parts, make<PixelCheck<check_parts>>},
    GroundTruthChecker{GroundTruth::normals, make<PixelCheck<check_normal_lengths>>},
    GroundTruthChecker{GroundTruth::flow, make<PixelCheck<check_flow_values>>},
    GroundTruthChecker{GroundTruth::flow_backward, make<PixelCheck<check_flow_values>>},
    GroundTruthChecker{GroundTruth::flow_occlusion, make<PixelCheck<check_flow_occlusion_values>>},
    GroundTruthChecker{GroundTruth::scene_flow, make<PixelCheck<check_scene_flow_values>>},
    GroundTruthChecker{GroundTruth::hazard_opacity, make<HazardOpacityCheck>},
    GroundTruthChecker{GroundTruth::hazard_opacity, make<HazardSightCheck>},
    GroundTruthChecker{GroundTruth::semantic, make<PixelCheck<check_semantic>>},
    GroundTruthChecker{GroundTruth::sensors, make<SensorTableCheck>},
};

}  // namespace

std::span<const GroundTruthChecker> ground_truth_checkers() { return kCheckers; }

}  // namespace throng::checks
