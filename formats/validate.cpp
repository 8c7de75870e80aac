#include "formats/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>

#include "base/error.h"
#include "base/hash.h"
#include "formats/dataset.h"
#include "formats/findings.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// The files that the manifest lists are there, whole, and no others are.
void check_manifest(const fs::path& root, const json& manifest, Findings& findings) {
  std::set<std::string> listed;
  for (const json& entry : manifest.at("files")) {
    const std::string path = entry.at("path");
    if (!listed.insert(path).second) findings.add("manifest", path, "", "listed twice");
    const fs::path file = root / path;
    if (!fs::is_regular_file(file)) {
      findings.add("manifest", path, "", "no such file, but the manifest lists it");
    } else if (entry.at("bytes") != fs::file_size(file)) {
      findings.add("manifest", path, "", "not as long as the manifest says");
    } else if (entry.at("sha256") != sha256_hex_of_file(file)) {
      findings.add("manifest", path, "", "its SHA-256 is not the manifest's");
    }
  }
  std::set<std::string> others;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    const std::string path = entry.path().lexically_relative(root).string();
    if (entry.is_regular_file() && path != "manifest.json" && !listed.contains(path)) {
      others.insert(path);
    }
  }
  for (const std::string& path : others) {
    findings.add("manifest", path, "", "a file that the manifest does not list");
  }
}

/// Ids say which image, run and person they are of, and come once.
class IdCheck {
 public:
  void add(const DatasetInfo& info, const Image& image, Findings& findings) {
    const std::string record = fmt::format("image {}", image.id);
    if (!images_.insert(image.id).second) {
      findings.add("ids", kCocoFile, record, "an image id that comes twice");
    }
    const auto run = std::find(info.runs.begin(), info.runs.end(), image.run);
    if (run == info.runs.end()) {
      findings.add("ids", kCocoFile, record, "a run that the manifest does not have: " + image.run);
      return;
    }
    const std::int64_t first_track = (run - info.runs.begin()) * annotate::kTrackIdsPerRun;
    std::set<std::int64_t> tracks;
    for (const Person& person : image.people) {
      const std::int64_t agent = person.track_id - first_track - 1;
      if (agent < 0 || agent >= annotate::kMaxAgentsPerRun) {
        findings.add("ids", person,
                     fmt::format("track_id {} is none of {}", person.track_id, image.run));
      } else if (person.id != image.id * annotate::kMaxAgentsPerRun + agent + 1) {
        findings.add("ids", person, "an id that is not that of its image and track");
      }
      if (!tracks.insert(person.track_id).second) {
        findings.add("ids", person, "somebody who is in the image twice");
      }
    }
  }

 private:
  std::set<std::int64_t> images_;
};

}  // namespace

Validation validate_dataset(const fs::path& root) {
  const json manifest = read_manifest(root);
  const DatasetInfo info = describe_dataset(root, manifest, {});
  Validation validation;
  Findings findings(validation);
  check_manifest(root, manifest, findings);
  IdCheck ids;
  FlowCheck flow;
  try {
    DatasetReader reader(info);
    Image image;
    while (reader.next(image)) {
      ++validation.images;
      validation.annotations += image.people.size();
      ids.add(info, image, findings);
      const std::size_t before = validation.found;
      check_people(image, findings);
      // What is said of broken masks would only be repeated.
      if (validation.found > before) continue;
      check_files(info, image, findings);
      if (info.has("flow") && is_plain(image) && validation.found == before) {
        flow.add(info, image, findings);
      }
    }
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    findings.add("schema", fs::path(problem.source).lexically_relative(root).string(),
                 problem.where, problem.found);
  } catch (const json::exception& error) {
    findings.add("schema", kCocoFile, fmt::format("image {} or later", validation.images),
                 error.what());
  }
  return validation;
}

}  // namespace throng::formats
