// A COCO file of a million annotations: written in shards, merged, and read again for an export.
// Prints seconds and the process's peak memory after each. A person's record has what that of a job
// with keypoints has, or, if "plain" is given, what a job's has by default.
#include <fmt/core.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <string_view>
#include <vector>

#include "annotate/people/coco.h"
#include "annotate/people/keypoints.h"
#include "annotate/people/labels.h"
#include "base/files/files.h"
#include "formats/export/exporter.h"
#include "tests/annotate/synthetic_frame.h"

namespace throng {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 1600;
constexpr int kPeople = 700;
constexpr int kFramesPerShard = 30;

double peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr double kKibPerMib = 1024;
  return static_cast<double>(usage.ru_maxrss) / kKibPerMib;
}

class Stage {
 public:
  explicit Stage(const char* name) : name_(name), start_(std::chrono::steady_clock::now()) {}
  ~Stage() {
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start_;
    fmt::print("{:<24}{:8.1f} s, peak {:6.0f} MiB\n", name_, seconds.count(), peak_mib());
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

 private:
  const char* name_;
  std::chrono::steady_clock::time_point start_;
};

render::Frame frame_of_crowd() {
  annotate::SyntheticScene scene;
  scene.width = 1920;
  scene.height = 1080;
  scene.people = kPeople;
  scene.min_size_px = 15;
  scene.max_size_px = 40;
  render::Frame frame = annotate::synthetic_frame(scene);
  frame.depth_m.assign(frame.id.size(), 9);
  for (render::PersonInView& person : frame.people) {
    for (std::size_t i = 0; i < person.keypoints.size(); ++i) {
      const auto shift = 0.1F * static_cast<float>(i);
      person.keypoints[i] = person.hips.cast<float>() + Eigen::Vector3f(shift, -shift, shift / 3);
    }
    person.position = {person.hips.x(), person.hips.y(), 0};
    person.yaw_rad = person.velocity.x();
    person.box_middle = person.hips.cast<float>();
    person.box_size = {0.597F, 0.529F, 1.791F};
  }
  return frame;
}

/// People who know where they want to go, as jobs record them.
world::Trace make_trace(std::size_t agents) {
  world::Trace trace;
  trace.header.state_names = {"Walk"};
  trace.header.exit_ids = {"exit1", "exit2", "exit3", "exit4", "exit5"};
  trace.header.role.resize(agents);
  trace.time_s = {0};
  trace.state.assign(agents, 0);
  trace.flags.assign(agents, world::kPresent);
  for (std::size_t i = 0; i < agents; ++i) {
    trace.header.group.push_back(i % 3 == 0 ? static_cast<std::int32_t>(i / 3) : -1);
    trace.exit_intent.push_back(static_cast<std::int8_t>(i % 5));
  }
  return trace;
}

skinning::Population make_population(std::size_t characters) {
  skinning::Population population;
  population.characters.resize(characters);
  for (skinning::Character& character : population.characters) {
    character.stature_m = 1.734F;
    character.wears = "long-sleeved shirt, trousers, leather shoes";
    for (auto& colors : character.tints) colors = {{0x77, 0x77, 0x6d}};
  }
  return population;
}

void run(const fs::path& folder, bool keypoints) {
  const render::Frame frame = frame_of_crowd();
  const world::Trace trace = make_trace(2 * kPeople);
  const skinning::Population population = make_population(24);
  const annotate::PersonFacts facts(trace, population, {});
  annotate::FrameLabels labels = annotate::label_people(frame);
  if (keypoints) annotate::add_keypoints(frame, labels);
  annotate::CocoImage image;
  image.run = "run000";
  image.camera_id = "d1";
  image.camera = frame.camera;
  image.facts = &facts;
  fmt::print("{} annotations\n", kFrames * labels.people.size());
  std::vector<fs::path> shards;
  {
    const Stage stage("writing shards");
    for (int first = 0; first < kFrames; first += kFramesPerShard) {
      shards.push_back(folder / fmt::format("shard{}", first));
      annotate::CocoShardWriter writer(shards.back());
      for (int i = first; i < std::min(first + kFramesPerShard, kFrames); ++i) {
        image.id = i + 1;
        image.frame_index = i;
        image.file_name = fmt::format("images/run000/d1/{:06}.jpg", i);
        writer.add(image, labels);
      }
      writer.finish();
    }
  }
  const fs::path root = folder / "dataset";
  fs::create_directories(root / "annotations");
  {
    const Stage stage("merging");
    annotate::merge_coco(shards, root / formats::kCocoFile, "a million", {keypoints, false});
  }
  const auto bytes = static_cast<double>(fs::file_size(root / formats::kCocoFile));
  fmt::print("{:.0f} MB, {:.0f} bytes an annotation\n", bytes / 1e6,
             bytes / static_cast<double>(kFrames * labels.people.size()));
  const nlohmann::json manifest = {
      {"generator", "bench"},
      {"schema_version", 1},
      {"job",
       {{"name", "million"},
        {"capture", {{"rate_hz", 1}, {"from_s", 0}, {"to_s", kFrames - 1}}},
        {"outputs", {{"annotations", {"coco"}}}}}},
      {"runs", {{{"run", "run000"}}}}};
  for (int i = 0; i < kFrames; ++i) {
    write_file_atomically(root / fmt::format("images/run000/d1/{:06}.jpg", i), "");
  }
  const Stage stage("exporting MOT, YOLO");
  const formats::DatasetInfo info = formats::describe_dataset(root, manifest, {});
  export_dataset(info, formats::choose_formats({"mot", "yolo-detect"}, {"coco"}, ""),
                 folder / "out");
}

}  // namespace
}  // namespace throng

int main(int argc, char** argv) {
  const auto folder = std::filesystem::temp_directory_path() / "throng_bench_coco_million";
  std::filesystem::remove_all(folder);
  throng::run(folder, argc < 2 || std::string_view(argv[1]) != "plain");
  std::filesystem::remove_all(folder);
}
