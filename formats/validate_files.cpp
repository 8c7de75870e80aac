#include <fmt/format.h>
#include <turbojpeg.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files.h"
#include "formats/findings.h"
#include "formats/instances.h"
#include "formats/mask.h"
#include "formats/npy.h"
#include "formats/raster.h"

namespace throng::formats {

namespace fs = std::filesystem;

namespace {

/// Whether a pixel of the picture of instances shows what has an annotation.
bool is_labelled(std::uint32_t id) { return is_person(id) || (id >= kFirstDrone && id < kGround); }

std::string relative(const DatasetInfo& info, const fs::path& path) {
  return path.lexically_relative(info.root).string();
}

/// Decodes all of it: what is cut off or damaged has no size.
std::optional<std::pair<int, int>> jpeg_size(const std::string& bytes) {
  const tjhandle decoder = tjInitDecompress();
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colours = 0;
  int failed =
      tjDecompressHeader3(decoder, data, bytes.size(), &width, &height, &subsampling, &colours);
  if (failed == 0) {
    std::vector<unsigned char> grey(static_cast<std::size_t>(width) *
                                    static_cast<std::size_t>(height));
    failed = tjDecompress2(decoder, data, bytes.size(), grey.data(), width, 0, height, TJPF_GRAY,
                           TJFLAG_STOPONWARNING | TJFLAG_FASTDCT);
  }
  tjDestroy(decoder);
  if (failed != 0) return std::nullopt;
  return std::pair(width, height);
}

void check_picture(const DatasetInfo& info, const Image& image, Findings& findings) {
  const fs::path path = info.root / image.file;
  const bool is_there = fs::is_regular_file(path);
  const auto size = is_there ? jpeg_size(read_file(path)) : std::nullopt;
  if (size != std::pair(image.width, image.height)) {
    findings.add("picture", image.file, fmt::format("image {}", image.id),
                 size ? fmt::format("{} x {} pixels, but the record says {} x {}", size->first,
                                    size->second, image.width, image.height)
                 : is_there ? "no whole JPEG"
                            : "no such file");
  }
}

void check_density(const DatasetInfo& info, const Image& image, Findings& findings) {
  const auto file = image.record.find("density_file");
  if (file == image.record.end()) return;
  const std::string path = *file;
  const FloatMap map = read_npy(info.root / path);
  const double sum = std::accumulate(map.value.begin(), map.value.end(), 0.0);
  const double count = image.record.at("density_count").get<double>();
  if (map.width != image.width || map.height != image.height) {
    findings.add("density-size", path, "", "another size than the image's");
    return;
  }
  if (!(std::abs(sum - count) <= 1e-3 * std::max(count, 1.0))) {
    findings.add("density-sum", path, "",
                 fmt::format("the map sums to {}, but density_count is {}", sum, count));
  }
  const bool has_negative =
      std::any_of(map.value.begin(), map.value.end(), [](float value) { return !(value >= 0); });
  if (has_negative) findings.add("density-sum", path, "", "a value below 0 or not a number");
  check_density_is_heads(image, path, map, info.density_sigma_px, findings);
}

/// Masks against the picture of instances, bit for bit.
void check_instances(const DatasetInfo& info, const Image& image,
                     const std::vector<std::uint32_t>& ids, Findings& findings) {
  const std::string path = relative(info, raster_path(info.root, "instances", image.file));
  std::map<std::uint32_t, std::uint64_t> areas;
  for (const std::uint32_t id : ids) {
    if (is_labelled(id)) ++areas[id];
  }
  const auto pixels =
      static_cast<std::uint64_t>(image.width) * static_cast<std::uint64_t>(image.height);
  for (const Person& person : things_of(image)) {
    const std::uint32_t id = instance_of(person);
    const Bitmap mask = bitmap_of(runs_of(person.mask, pixels), image.height);
    std::size_t wrong = 0;
    for (int y = mask.y; y < mask.y + mask.height; ++y) {
      for (int x = mask.x; x < mask.x + mask.width; ++x) {
        const bool shows = ids[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(x)] == id;
        wrong += shows == mask.at(x, y) ? 0 : 1;
      }
    }
    if (wrong > 0 || areas[id] != mask.area()) {
      findings.add("instances-are-masks", path, fmt::format("annotation {}", person.id),
                   fmt::format("instance {} has {} pixels, the mask {}; {} differ in its bounds",
                               id, areas[id], mask.area(), wrong));
    }
    areas.erase(id);
  }
  for (const auto& [id, area] : areas) {
    findings.add("instances-are-masks", path, fmt::format("instance {}", id),
                 fmt::format("{} pixels, but nobody has an annotation", area));
  }
}

/// Depth inside the masks against where the people are.
void check_depth(const DatasetInfo& info, const Image& image, const std::vector<std::uint32_t>& ids,
                 Findings& findings) {
  const fs::path file = raster_path(info.root, "depth", image.file);
  const Raster depth = read_raster(file);
  if (depth.width != image.width || depth.height != image.height) {
    findings.add("depth", relative(info, file), "", "another size than the image's");
    return;
  }
  if (is_plain(image)) {
    check_ground_depth(image, relative(info, file), ids, depth.samples, findings);
  }
  std::map<std::uint32_t, std::pair<double, double>> range;  // nearest and farthest, m
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!is_labelled(ids[i])) continue;
    const double z = depth.samples[i] / 100.0;
    auto& [low, high] =
        range.try_emplace(ids[i], std::numeric_limits<double>::infinity(), 0.0).first->second;
    low = std::min(low, z);
    high = std::max(high, z);
  }
  // Rounding of depth and boxes; a rolling shutter sees a person at several times.
  const double slack_m = is_shot_at_once(image) ? 0.03 : 1;
  for (const Person& person : things_of(image)) {
    const auto found = range.find(instance_of(person));
    if (found == range.end()) continue;  // a finding of another rule
    const Eigen::RowVectorXd z = corners_in_camera(image, person).row(2);
    const auto& [low, high] = found->second;
    if (low < z.minCoeff() - slack_m || high > z.maxCoeff() + slack_m) {
      findings.add("depth", relative(info, file), fmt::format("annotation {}", person.id),
                   fmt::format("{:.2f} to {:.2f} m inside the mask, but the person is {:.2f} to "
                               "{:.2f} m away",
                               low, high, z.minCoeff(), z.maxCoeff()));
    }
  }
}

/// Flow is known or all 0, and people's stays within the format's range.
void check_flow(const DatasetInfo& info, const Image& image, Findings& findings) {
  const fs::path file = raster_path(info.root, "flow", image.file);
  const Raster flow = read_raster(file);
  if (flow.channels != 3 || flow.bits != 16 || flow.width != image.width ||
      flow.height != image.height) {
    findings.add("flow", relative(info, file), "", "not 16-bit RGB of the image's size");
    return;
  }
  for (std::size_t i = 0; i < flow.samples.size(); i += 3) {
    const std::uint16_t* pixel = flow.samples.data() + i;
    if (pixel[2] == 1 || (pixel[0] == 0 && pixel[1] == 0 && pixel[2] == 0)) continue;
    findings.add("flow", relative(info, file), fmt::format("pixel {}", i / 3),
                 "neither known nor all 0");
    return;
  }
}

/// A damaged file is a finding, and no reason to stop.
template <typename Check>
void guarded(const Check& check_it, const char* rule, const DatasetInfo& info, Findings& findings) {
  try {
    check_it();
  } catch (const InputError& error) {
    const Problem& problem = error.problems().front();
    findings.add(rule, relative(info, problem.source), problem.where, problem.found);
  }
}

}  // namespace

std::uint32_t instance_of(const Person& thing) {
  const auto number = thing.number_in_run();
  const bool is_drone = number > annotate::kFirstDroneNumber;
  return static_cast<std::uint32_t>(
      is_drone ? kFirstDrone + number - annotate::kFirstDroneNumber - 1 : number);
}

void check_files(const DatasetInfo& info, const Image& image, Findings& findings) {
  guarded([&] { check_picture(info, image, findings); }, "picture", info, findings);
  guarded([&] { check_density(info, image, findings); }, "density-sum", info, findings);
  if (info.has("flow")) {
    guarded([&] { check_flow(info, image, findings); }, "flow", info, findings);
  }
  if (!info.has("instances")) return;
  guarded(
      [&] {
        const fs::path file = raster_path(info.root, "instances", image.file);
        const std::vector<std::uint32_t> ids = read_instances(file);
        if (ids.size() !=
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
          findings.add("instances-are-masks", relative(info, file), "",
                       "another size than the image's");
          return;
        }
        check_instances(info, image, ids, findings);
        if (info.has("depth")) check_depth(info, image, ids, findings);
        check_parts_and_normals(info, image, ids, findings);
      },
      "instances-are-masks", info, findings);
}

}  // namespace throng::formats
