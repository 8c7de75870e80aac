// Files that follow from what the records say of cameras and of the ground, and pictures of parts
// and normals.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "camera/files.h"
#include "formats/findings.h"
#include "formats/instances.h"
#include "formats/raster.h"

namespace throng::formats {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// What fields/RUN/FRAME.npy has: four planes of float32 after the header.
std::vector<float> values_of(const fs::path& file) {
  const std::string bytes = read_file(file);
  constexpr std::size_t kPreamble = 10;
  const auto header = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const std::size_t start =
      bytes.size() < kPreamble ? bytes.size() : kPreamble + header(8) + 256U * header(9);
  if (start >= bytes.size() || (bytes.size() - start) % sizeof(float) != 0) {
    throw InputError({file.string(), "", "no whole array", "a .npy file of float32"});
  }
  std::vector<float> values((bytes.size() - start) / sizeof(float));
  std::memcpy(values.data(), bytes.data() + start, values.size() * sizeof(float));
  return values;
}

void check_field(const fs::path& root, const std::string& path, const json& grid, std::size_t frame,
                 Findings& findings) {
  const std::vector<float> values = values_of(root / path);
  const auto cells = grid.at("rows").get<std::size_t>() * grid.at("columns").get<std::size_t>();
  constexpr std::size_t kPlanes = 4;
  if (values.size() != kPlanes * cells) {
    findings.add("fields", path, "", "not four values for each cell of the grid");
    return;
  }
  double sum = 0;
  bool is_finite = true;
  for (std::size_t i = 0; i < values.size(); ++i) {
    is_finite = is_finite && std::isfinite(values[i]);
    if (i < cells) sum += static_cast<double>(values[i]);
  }
  const auto cell_m = grid.at("cell_m").get<double>();
  const auto people = grid.at("people").at(frame).get<double>();
  if (!is_finite || !(std::abs(sum * cell_m * cell_m - people) <= 1e-3 * std::max(people, 1.0))) {
    findings.add("fields", path, "",
                 fmt::format("the densities sum to {} people, but there are {}",
                             sum * cell_m * cell_m, people));
  }
}

}  // namespace

void check_camera_files(const DatasetInfo& info, const Image& image, Findings& findings) {
  const std::string place = fmt::format("cameras/{}/{}", image.run, image.camera);
  if (!fs::exists(info.root / (place + ".opencv.yaml"))) return;
  const camera::Intrinsics lens = camera_of(image).intrinsics;
  const auto compare = [&](const std::string& path, const std::string& expected) {
    if (fs::is_regular_file(info.root / path) && read_file(info.root / path) == expected) return;
    findings.add("camera", path, fmt::format("image {}", image.id),
                 "not the lens that the image's record has");
  };
  compare(place + ".opencv.yaml", camera::opencv_yaml(lens));
  compare(place + ".ros.yaml", camera::ros_yaml(lens, image.camera));
}

void check_parts_and_normals(const DatasetInfo& info, const Image& image,
                             const std::vector<std::uint32_t>& ids, Findings& findings) {
  const std::string record = fmt::format("image {}", image.id);
  const auto look = [&](const char* kind, int channels, const auto& is_good, const char* what) {
    if (!info.has(kind)) return;
    const fs::path file = raster_path(info.root, kind, image.file);
    const std::string path = file.lexically_relative(info.root).string();
    const Raster raster = read_raster(file);
    if (raster.channels != channels ||
        raster.samples.size() != ids.size() * static_cast<std::size_t>(channels)) {
      findings.add(kind, path, record, "another size or number of channels");
      return;
    }
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      wrong += is_good(ids[i], &raster.samples[i * static_cast<std::size_t>(channels)]) ? 0 : 1;
    }
    if (wrong > 0) findings.add(kind, path, record, fmt::format("{} pixels {}", wrong, what));
  };
  look(
      "parts", 1,
      [](std::uint32_t id, const std::uint16_t* part) {
        constexpr std::uint16_t kLastPart = 9;
        return (part[0] > 0) == is_person(id) && part[0] <= kLastPart;
      },
      "are of no person, or of one without a part");
  look(
      "normals", 3,
      [](std::uint32_t id, const std::uint16_t* n) {
        if (id == 0) return n[0] == 0 && n[1] == 0 && n[2] == 0;
        constexpr double kScale = 127;
        double sum = 0;
        for (int c = 0; c < 3; ++c) {
          const double value = (n[c] - 128.0) / kScale;
          sum += value * value;
        }
        return std::abs(std::sqrt(sum) - 1) < 0.05;
      },
      "have no normal of length 1, or one although they show the sky");
}

void check_fields(const DatasetInfo& info, Findings& findings) {
  if (!info.has("fields")) return;
  for (const std::string& run : info.runs) {
    const std::string description = "fields/" + run + ".json";
    try {
      const json grid =
          parse_json(read_file(info.root / description), (info.root / description).string());
      for (std::size_t frame = 0; frame < grid.at("people").size(); ++frame) {
        check_field(info.root, fmt::format("fields/{}/{:06}.npy", run, frame), grid, frame,
                    findings);
      }
    } catch (const InputError& error) {
      const Problem& problem = error.problems().front();
      findings.add("fields", fs::path(problem.source).lexically_relative(info.root).string(), "",
                   problem.found);
    } catch (const std::runtime_error& error) {
      findings.add("fields", description, "", error.what());
    }
  }
}

}  // namespace throng::formats
