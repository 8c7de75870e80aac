#include "formats/ground_truth_checks.h"

#include <fmt/format.h>

#include <array>

#include "formats/flight_checks.h"
#include "formats/run_checks.h"

namespace throng::formats {

namespace fs = std::filesystem;
using annotate::GroundTruth;

namespace {

/// A check of one picture at a time.
template <void (*check)(const DatasetInfo&, const Image&, const Pixels&, Findings&)>
class PixelCheck : public GroundTruthCheck {
 public:
  void add_pixels(const DatasetInfo& info, const Image& image, const Pixels& pixels,
                  Findings& findings) override {
    check(info, image, pixels, findings);
  }
};

template <typename Check>
std::unique_ptr<GroundTruthCheck> make() {
  return std::make_unique<Check>();
}

constexpr std::array kCheckers = {
    GroundTruthChecker{GroundTruth::density, make<PixelCheck<check_density>>},
    GroundTruthChecker{GroundTruth::exits, make<ExitsCheck>},
    GroundTruthChecker{GroundTruth::fields, make<FieldsCheck>},
    GroundTruthChecker{GroundTruth::depth, make<PixelCheck<check_depth>>},
    GroundTruthChecker{GroundTruth::instances, make<PixelCheck<check_instances>>},
    GroundTruthChecker{GroundTruth::parts, make<PixelCheck<check_parts>>},
    GroundTruthChecker{GroundTruth::normals, make<PixelCheck<check_normal_lengths>>},
    GroundTruthChecker{GroundTruth::flow, make<PixelCheck<check_flow_values>>},
    GroundTruthChecker{GroundTruth::semantic, make<PixelCheck<check_semantic>>},
    GroundTruthChecker{GroundTruth::sensors, make<SensorTableCheck>},
};

}  // namespace

std::span<const GroundTruthChecker> ground_truth_checkers() { return kCheckers; }

GroundTruthChecks::GroundTruthChecks(const DatasetInfo& info) {
  for (const GroundTruthChecker& checker : kCheckers) {
    if (info.has(checker.kind)) checks_.push_back(checker.make());
  }
}

void GroundTruthChecks::add(const DatasetInfo& info, const Image& image, Findings& findings) {
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    if (!info.has(kind.kind)) continue;
    std::string file = file_of(kind.kind, image.run, image.camera, image.frame);
    if (files_.contains(file)) continue;
    if (!fs::is_regular_file(info.root / file)) {
      findings.add("ground-truth", file, fmt::format("image {}", image.id),
                   fmt::format("no such file, but the job asks for {}", kind.name));
    }
    // Files of single pictures come once; only those of runs are kept in mind.
    if (kind.file.find("CAMERA/FRAME") == std::string_view::npos) files_.insert(std::move(file));
  }
  for (const auto& check : checks_) check->add(info, image, findings);
}

void GroundTruthChecks::add_pixels(const DatasetInfo& info, const Image& image,
                                   const Pixels& pixels, Findings& findings) {
  for (const auto& check : checks_) check->add_pixels(info, image, pixels, findings);
}

void GroundTruthChecks::finish(const DatasetInfo& info, Findings& findings) {
  for (const auto& check : checks_) check->finish(info, findings);
}

}  // namespace throng::formats
