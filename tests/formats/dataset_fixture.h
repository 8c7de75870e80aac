// A small finished dataset without a renderer: synthetic frames, written as jobs write them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "annotate/people/coco.h"
#include "annotate/people/keypoints.h"
#include "annotate/people/labels.h"
#include "annotate/rasters/density.h"
#include "annotate/rasters/png.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/graphics/images/jpeg_writer.h"
#include "base/version.h"
#include "formats/export/exporter.h"
#include "tests/annotate/synthetic_frame.h"
#include "world/semantic_class.h"

namespace throng::formats {

/// Two runs of two cameras with three frames each, written once for all tests of a program.
class SmallDataset : public ::testing::Test {
 protected:
  static constexpr int kRuns = 2;
  static constexpr int kCameras = 2;
  static constexpr int kFrames = 3;

  void SetUp() override {
    folder_ =
        std::filesystem::path(::testing::TempDir()) /
        ("formats_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    root_ = folder_ / "dataset";
    write_dataset();
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write_dataset() {
    {
      annotate::CocoShardWriter writer(folder_ / "shard");
      for (int run = 0; run < kRuns; ++run) {
        for (int frame = 0; frame < kFrames; ++frame) {
          for (int camera = 0; camera < kCameras; ++camera) add(writer, run, camera, frame);
        }
      }
      writer.finish();
    }
    std::filesystem::create_directories(root_ / "annotations");
    annotate::merge_coco({folder_ / "shard"}, root_ / kCocoFile, "small", {true, false});
    write_manifest();
  }

  void add(annotate::CocoShardWriter& writer, int run, int camera, int frame) {
    annotate::SyntheticScene scene;
    scene.seed = static_cast<std::uint64_t>(100 * run + 10 * camera + frame);
    scene.people = frame == 1 && camera == 1 ? 0 : 14;
    render::Frame rendered = annotate::synthetic_frame(scene);
    *std::find(rendered.id.begin(), rendered.id.end(), render::kIdGround) =
        render::id_of_umbrella(3);
    rendered.index = frame;
    rendered.time_s = 0.5 * frame;
    rendered.depth_m = make_depth(rendered);
    // Every image is another scene: nobody is in two.
    const auto first = static_cast<std::uint32_t>(100 * (kFrames * camera + frame));
    for (std::uint32_t& id : rendered.id) id += render::is_agent(id) ? first : 0;
    for (render::PersonInView& person : rendered.people) {
      person.agent += first;
      person.velocity *= 0.05;  // they stand
      person.keypoints.fill(person.hips.cast<float>());
      set_box(rendered.camera, person);
    }
    annotate::FrameLabels labels = annotate::label_people(rendered);
    annotate::add_keypoints(rendered, labels);
    annotate::CocoImage image;
    image.id = 1 + (run * kCameras + camera) * kFrames + frame;
    image.run = "run00" + std::to_string(run);
    image.run_index = run;
    image.camera_id = camera == 0 ? "d1" : "d2";
    const std::string place = image.run + "/" + image.camera_id + "/00000" + std::to_string(frame);
    image.file_name = "images/" + place + ".jpg";
    image.frame_index = frame;
    image.time_s = rendered.time_s;
    image.camera = rendered.camera;
    std::vector<Eigen::Vector2d> heads;
    for (const annotate::PersonLabel& label : labels.people) {
      const auto head = render::head_in(label.person, rendered.camera);
      if (!head || head->x() < 0 || head->y() < 0 || head->x() >= rendered.width() ||
          head->y() >= rendered.height()) {
        continue;
      }
      heads.push_back(*head);
    }
    image.density_file = "density/" + place + ".npz";
    image.density_count = static_cast<std::int64_t>(heads.size());
    writer.add(image, labels);
    const auto write = [&](const std::string& path, const std::string& bytes) {
      write_file_atomically(root_ / path, bytes);
    };
    write(image.file_name,
          images::jpeg_bytes(rendered.rgb, rendered.width(), rendered.height(), 80));
    write(image.density_file, annotate::npz_bytes(annotate::density_map(heads, rendered.width(),
                                                                        rendered.height(), 4)));
    rendered.flow.assign(2 * rendered.id.size(), 1.5F);
    write("flow/" + place + ".png", annotate::flow_png(rendered));
    write("instances/" + place + ".png", annotate::instance_png(rendered));
    rendered.surface = classify(rendered.id);
    write("semantic/" + place + ".png", annotate::semantic_png(rendered));
    write("depth/" + place + ".png", annotate::depth_png(rendered));
  }

  /// Semantic classes of what a synthetic frame shows.
  static std::vector<std::uint8_t> classify(const std::vector<std::uint32_t>& ids) {
    using world::SemanticClass;
    std::vector<std::uint8_t> classes;
    for (const std::uint32_t id : ids) {
      const SemanticClass shown = id == render::kIdNothing  ? SemanticClass::sky
                                  : render::is_agent(id)    ? SemanticClass::person
                                  : render::is_umbrella(id) ? SemanticClass::umbrella
                                  : classes.size() % 7 == 0 ? SemanticClass::grass
                                                            : SemanticClass::pavement;
      classes.push_back(static_cast<std::uint8_t>(shown));
    }
    return classes;
  }

  /// A cube that holds what the image shows, 9 m away.
  static void set_box(const camera::Camera& camera, render::PersonInView& person) {
    const Eigen::AlignedBox2d& box = person.amodal_box;
    const double depth_m = (camera.pose.R * person.hips + camera.pose.t).z();
    person.box_middle =
        camera.unproject(Eigen::Vector2d(box.center().array() - 0.5), depth_m).cast<float>();
    const double size_m = 0.5 + 1.3 * box.sizes().maxCoeff() * depth_m / camera.intrinsics.fy_px;
    person.box_size.setConstant(static_cast<float>(size_m));
    person.position = person.box_middle.cast<double>();
  }

  /// People are 9 m away; the ground is where it is, the sky nowhere.
  static std::vector<float> make_depth(const render::Frame& rendered) {
    std::vector<float> depth_m(rendered.id.size(), 9.0F);
    const camera::Camera& camera = rendered.camera;
    const Eigen::Vector3d center = camera.pose.center();
    for (std::size_t i = 0; i < depth_m.size(); ++i) {
      if (rendered.id[i] == render::kIdNothing) depth_m[i] = std::numeric_limits<float>::infinity();
      if (rendered.id[i] != render::kIdGround) continue;
      const auto column = static_cast<double>(static_cast<int>(i) % rendered.width());
      const auto row = static_cast<double>(static_cast<int>(i) / rendered.width());
      const Eigen::Vector3d ray = camera.unproject({column, row}, 1) - center;
      depth_m[i] = static_cast<float>(-center.z() / ray.z());
    }
    return depth_m;
  }

  void write_manifest() {
    nlohmann::json files = nlohmann::json::array();
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root_)) {
      if (!entry.is_regular_file() || entry.path().filename() == "manifest.json") continue;
      files.push_back({{"path", std::filesystem::relative(entry.path(), root_).string()},
                       {"bytes", entry.file_size()},
                       {"sha256", sha256_hex_of_file(entry.path())}});
    }
    const nlohmann::json manifest = {
        {"schema_version", 1},
        {"generator", kGenerator},
        {"job",
         {{"name", "small"},
          {"capture", {{"rate_hz", 2}, {"from_s", 0}, {"to_s", 1}}},
          {"outputs", {{"annotations", annotations_}, {"formats", formats_}}}}},
        {"runs", {{{"run", "run000"}}, {{"run", "run001"}}}},
        {"files", files}};
    write_file_atomically(root_ / "manifest.json", manifest.dump(1));
  }

  DatasetInfo info(const ExportOptions& options = {}) const {
    return describe_dataset(root_, read_manifest(root_), options);
  }

  /// Exports one format and gives its folder.
  std::filesystem::path exported(const std::string& name, const ExportOptions& options = {}) const {
    const DatasetInfo described = info(options);
    export_dataset(described, choose_formats({name}, described.annotations, ""), folder_ / "out");
    return folder_ / "out" / name;
  }

  nlohmann::json coco() const { return nlohmann::json::parse(read_file(root_ / kCocoFile)); }

  /// Kinds of ground truth in the manifest; write_manifest() writes them.
  std::vector<std::string> annotations_ = {"coco", "keypoints", "density", "depth", "instances"};
  std::vector<std::string> formats_;  ///< that it has below formats/
  std::filesystem::path folder_;
  std::filesystem::path root_;
};

}  // namespace throng::formats
