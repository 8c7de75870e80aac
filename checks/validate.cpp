#include "checks/validate.h"
#include "formats/dataset/image_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "base/error.h"
#include "base/files/hash.h"
#include "checks/findings.h"
#include "checks/flight_checks.h"
#include "checks/ground_truth_checks.h"
#include "checks/run_checks.h"
#include "checks/shot.h"
#include "formats/dataset/dataset.h"

namespace throng::checks {

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

/// The instant of an image is that of its frame, and its file that of its run, camera and frame.
void check_time(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings) {
  constexpr double kSlackS = 1e-6;
  const std::string record = fmt::format("image {}", image.id);
  const double expected_s = info.from_s + static_cast<double>(image.frame) / info.rate_hz;
  if (std::abs(image.time_s - expected_s) > kSlackS) {
    findings.add("time", formats::kCocoFile, record,
                 fmt::format("time_s {}, but its frame is of {} s", image.time_s, expected_s));
  }
  const std::string file =
      fmt::format("images/{}/{}/{:06}.jpg", image.run, image.camera, image.frame);
  if (image.file != file)
    findings.add("time", formats::kCocoFile, record, "file_name is not " + file);
}

/// As many images and annotations as the manifest says.
void check_counts(const json& manifest, const Validation& validation, Findings& findings) {
  const auto counts = manifest.find("counts");
  if (counts == manifest.end()) return;
  if (counts->at("frames") != validation.images ||
      counts->at("annotations") != validation.annotations) {
    findings.add("counts", formats::kCocoFile, "",
                 fmt::format("{} images with {} annotations, but the manifest says {} and {}",
                             validation.images, validation.annotations, counts->at("frames").dump(),
                             counts->at("annotations").dump()));
  }
}

/// Ids say which image, run and person they are of, and come once.
class IdCheck {
 public:
  void add(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings) {
    const std::string record = fmt::format("image {}", image.id);
    if (!images_.insert(image.id).second) {
      findings.add("ids", formats::kCocoFile, record, "an image id that comes twice");
    }
    const auto run = std::find(info.runs.begin(), info.runs.end(), image.run);
    if (run == info.runs.end()) {
      findings.add("ids", formats::kCocoFile, record,
                   "a run that the manifest does not have: " + image.run);
      return;
    }
    const std::int64_t first_track = (run - info.runs.begin()) * annotate::kTrackIdsPerRun;
    std::set<std::int64_t> tracks;
    for (const formats::Person& person : list_objects(image)) {
      const std::int64_t agent = person.track_id - first_track - 1;
      if (agent < 0 || agent >= annotate::kMaxAgentsPerRun) {
        findings.add("ids", person,
                     fmt::format("track_id {} is none of {}", person.track_id, image.run));
      } else if (person.id != image.id * annotate::kMaxAgentsPerRun + agent + 1) {
        findings.add("ids", person, "an id that is not that of its image and track");
      }
      if (person.track->empty()) {
        findings.add("ids", person, fmt::format("track_id {} is none of tracks", person.track_id));
      }
      if (!tracks.insert(person.track_id).second) {
        findings.add("ids", person, "somebody who is in the image twice");
      }
    }
  }

 private:
  std::set<std::int64_t> images_;
};

/// The version of labels since which contrasts are those of the image after JPEG.
constexpr int kFinalContrastsSince = 3;

/// Checks of one image at a time and of pairs, fed in the order of the COCO file.
class ShotChecks {
 public:
  explicit ShotChecks(const formats::DatasetInfo& info)
      : has_final_contrasts_(label_version(info) >= kFinalContrastsSince) {}

  void add(const formats::DatasetInfo& info, const formats::Image& image, GroundTruthChecks& kinds,
           Findings& findings) {
    Shot shot;
    shot.pixels = read_pixels(info, image, findings);
    shot.image = image;
    shot.camera = formats::image_camera(image);
    shot.rays = rays_of(image.camera, shot.camera.intrinsics);
    shot.is_plain = is_plain(image);
    shot.at_once = is_shot_at_once(image);
    shot.has_final_contrasts = has_final_contrasts_;
    kinds.add_pixels(info, image, shot.pixels, findings);
    check_buildings(shot, findings);
    check_normals(shot, findings);
    check_surface_classes(shot, findings);
    places_.add(info, shot, findings);
    alignment_.add(shot);
    clothes_.add(shot);
    check_whole_bodies(shot, findings);
    check_joints(info, shot, findings);
    check_skeletons(shot, findings);
    check_difficulty(info, shot, findings);
    check_lookalikes(shot, findings);
    check_heads(info, shot, findings);
    check_facing_motion(shot, findings);
    if (image.frame == 0) check_first_flow(shot, findings);
    if (image.frame + 1 == info.frames_per_camera) check_last_flow(shot, findings);
    for (const auto& [camera, other] : last_) {
      if (other.image.run != image.run) continue;
      const bool is_before = camera == image.camera && other.image.frame + 1 == image.frame;
      const bool is_same = camera != image.camera && other.image.frame == image.frame;
      if (is_before || is_same) check_still_surfaces(other, shot, findings);
      if (is_same) check_same_instant(other, shot, findings);
      if (!is_before) continue;
      check_flow_between(other, shot, findings);
      scene_flow_.add(other, shot, findings);
      check_motion(other, shot, findings);
    }
    last_.insert_or_assign(image.camera, std::move(shot));
  }
  void finish(Findings& findings) const {
    alignment_.finish(findings);
    clothes_.finish(findings);
    places_.finish(findings);
    scene_flow_.finish(findings);
  }
  /// Nothing is compared with a camera's last image any more.
  void forget(const std::string& camera) { last_.erase(camera); }

 private:
  /// The camera's last image has the same unless its lens changes.
  std::shared_ptr<const PixelRays> rays_of(const std::string& camera,
                                           const camera::Intrinsics& intrinsics) const {
    if (!intrinsics.distortion) return nullptr;
    const auto last = last_.find(camera);
    const bool is_same = last != last_.end() && last->second.rays != nullptr &&
                         last->second.rays->are_of(intrinsics);
    return is_same ? last->second.rays : std::make_shared<const PixelRays>(intrinsics);
  }

  bool has_final_contrasts_;
  AlignmentCheck alignment_;
  ClothesCheck clothes_;
  PlaceCheck places_;
  SceneFlowCheck scene_flow_;
  std::map<std::string, Shot> last_;  ///< each camera's
};

/// Checks of the records without masks and images.
class RecordChecks {
 public:
  explicit RecordChecks(const json& manifest) : constancy_(manifest) {}

  void add(const formats::DatasetInfo& info, const formats::Image& image, Findings& findings) {
    const auto [touch, is_new] = may_touch_.try_emplace({image.run, image.camera}, false);
    if (is_new) touch->second = may_have_touched(info, image.run, image.camera);
    check_flight(info, image, findings, touch->second);
    const auto before = last_.find(image.camera);
    if (before != last_.end() && before->second.run == image.run &&
        before->second.frame + 1 == image.frame) {
      check_flight_between(before->second, image, findings, touch->second);
    }
    formats::Image light = image;
    light.people.clear();
    last_.insert_or_assign(image.camera, std::move(light));
    constancy_.add(info, image, findings);
    presence_.add(image, findings);
    vehicles_.add(image, findings);
    hazards_.add(info, image, findings);
    check_preview(info, image, findings);
  }
  void finish(const formats::DatasetInfo& info, Findings& findings) {
    constancy_.finish(info, findings);
  }

 private:
  std::map<std::string, formats::Image> last_;  ///< each camera's, without people
  std::map<std::pair<std::string, std::string>, bool> may_touch_;  ///< by run and drone
  ConstancyCheck constancy_;
  PresenceCheck presence_;
  VehicleCheck vehicles_;
  HazardCheck hazards_;
};

/// A dataset of a job without drones: figures, and tables of each run.
void check_dataset_without_images(const formats::DatasetInfo& info, const json& manifest,
                                  Findings& findings) {
  for (const annotate::GroundTruthKind& kind : annotate::ground_truth_kinds()) {
    if (!info.has(kind.kind)) continue;
    for (const std::string& run : info.runs) {
      const std::string file = annotate::ground_truth_file(kind.kind, run);
      if (!fs::is_regular_file(info.root / file)) {
        findings.add("schema", file, "", "no such file, but the job asks for it");
      }
    }
  }
  check_metrics(info, manifest, findings);
}

/// Runs what reads the manifest. Throws InputError naming that where a value is none that throng
/// writes.
template <typename Read>
auto reading_manifest(const fs::path& root, const Read& read) {
  try {
    return read();
  } catch (const json::exception& error) {
    throw formats::bad_manifest(root, error);
  }
}

}  // namespace

Validation validate_dataset(const fs::path& root) {
  const json manifest = formats::read_manifest(root);
  Validation validation;
  Findings findings(validation);
  const formats::DatasetInfo info = reading_manifest(root, [&] {
    check_manifest(root, manifest, findings);
    return formats::describe_dataset(root, manifest, formats::export_options(root, manifest));
  });
  formats::check_images_have_labels(info);
  IdCheck ids;
  FormatCheck other_formats;
  RecordChecks records(manifest);
  GroundTruthChecks kinds(info);
  try {
    if (!info.has(annotate::GroundTruth::coco)) {
      check_dataset_without_images(info, manifest, findings);
      return validation;
    }
    formats::DatasetReader reader(info);
    ShotChecks shots(info);
    formats::Image image;
    while (reader.next(image)) {
      ++validation.images;
      validation.annotations += image.people.size() + image.objects.size();
      ids.add(info, image, findings);
      check_time(info, image, findings);
      check_camera(image, findings);
      check_camera_files(info, image, findings);
      other_formats.add(info, image, findings);
      check_bodies(image, findings);
      records.add(info, image, findings);
      check_job(manifest, image, findings);
      kinds.add(info, image, findings);
      const std::size_t before = validation.found;
      check_people(image, findings);
      // Findings about broken masks would only be repeated.
      if (validation.found > before) {
        shots.forget(image.camera);
        continue;
      }
      shots.add(info, image, kinds, findings);
    }
    shots.finish(findings);
    other_formats.finish(findings);
    check_counts(manifest, validation, findings);
    check_categories(info, findings);
    records.finish(info, findings);
    kinds.finish(info, findings);
    check_metrics(info, manifest, findings);
    check_exports(info, manifest, findings);
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    findings.add("schema", fs::path(problem.source).lexically_relative(root).string(),
                 problem.where, problem.found);
  } catch (const json::exception& error) {
    findings.add("schema", formats::kCocoFile, fmt::format("image {} or later", validation.images),
                 error.what());
  }
  return validation;
}

}  // namespace throng::checks
