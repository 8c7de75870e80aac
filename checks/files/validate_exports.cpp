#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/version.h"
#include "checks/findings.h"
#include "formats/card.h"
#include "formats/dataset/comparison.h"
#include "formats/export/exporter.h"

namespace throng::checks {

namespace fs = std::filesystem;
using nlohmann::json;

void check_exports(const formats::DatasetInfo& info, const json& manifest, Findings& findings) {
  if (info.generator != kGenerator) return;
  const formats::ScratchFolder scratch;
  std::vector<std::unique_ptr<formats::Comparison>> comparisons;
  std::vector<std::unique_ptr<formats::Exporter>> exporters;
  const auto compare_with = [&](const fs::path& folder) {
    comparisons.push_back(std::make_unique<formats::Comparison>(
        info.root / folder, [&findings, folder](const std::string& path, const std::string& what) {
          findings.add("formats", (folder / path).string(), "", what);
        }));
    return formats::Output(scratch.path() / folder, comparisons.back().get());
  };
  for (const std::string& name : info.formats) {
    if (const formats::Format* format = formats::find_format(name); format != nullptr) {
      exporters.push_back(format->make(info, compare_with(fs::path("formats") / name)));
    }
  }
  const std::size_t formats = comparisons.size();
  if (fs::exists(info.root / "dataset.json")) {
    exporters.push_back(std::make_unique<formats::DatasetCard>(info, manifest, compare_with("")));
  }
  try {
    formats::DatasetReader reader(info);
    formats::Image image;
    while (reader.next(image)) {
      for (const auto& exporter : exporters) exporter->add(image);
    }
    for (const auto& exporter : exporters) exporter->finish();
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    findings.add("formats", fs::path(problem.source).lexically_relative(info.root).string(),
                 problem.where, "cannot be exported again: " + problem.found);
    return;
  } catch (const json::exception& error) {
    findings.add("formats", formats::kCocoFile, "",
                 std::string("cannot be exported again: ") + error.what());
    return;
  }
  for (std::size_t i = 0; i < formats; ++i) comparisons[i]->finish();
}

}  // namespace throng::checks
