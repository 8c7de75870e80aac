#include "checks/ground_truth_checks.h"

#include <fmt/format.h>

namespace throng::checks {

namespace fs = std::filesystem;

GroundTruthChecks::GroundTruthChecks(const formats::DatasetInfo& info) {
  for (const GroundTruthChecker& checker : ground_truth_checkers()) {
    if (info.has(checker.kind)) checks_.push_back(checker.make());
  }
}

void GroundTruthChecks::add(const formats::DatasetInfo& info, const formats::Image& image,
                            Findings& findings) {
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    if (!info.has(kind.kind)) continue;
    std::string file = ground_truth_file(kind.kind, image.run, image.camera, image.frame);
    if (files_.contains(file)) continue;
    if (!fs::is_regular_file(info.root / file)) {
      findings.add("ground-truth", file, fmt::format("image {}", image.id),
                   fmt::format("no such file, but the job asks for {}", kind.name));
    }
    // Files of single images come once; only those of runs are kept in mind.
    if (kind.file.find("CAMERA/FRAME") == std::string_view::npos) files_.insert(std::move(file));
  }
  for (const auto& check : checks_) check->add(info, image, findings);
}

void GroundTruthChecks::add_pixels(const formats::DatasetInfo& info, const formats::Image& image,
                                   const Pixels& pixels, Findings& findings) {
  for (const auto& check : checks_) check->add_pixels(info, image, pixels, findings);
}

void GroundTruthChecks::finish(const formats::DatasetInfo& info, Findings& findings) {
  for (const auto& check : checks_) check->finish(info, findings);
}

}  // namespace throng::checks
