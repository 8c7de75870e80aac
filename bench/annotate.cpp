// Ground truth of one 1920x1080 frame, stage by stage, on one core. Items are frames.
#include <benchmark/benchmark.h>

#include <filesystem>
#include <map>
#include <vector>

#include "annotate/people/coco.h"
#include "annotate/people/keypoints.h"
#include "annotate/people/labels.h"
#include "annotate/rasters/density.h"
#include "annotate/rasters/preview.h"
#include "base/graphics/images/jpeg_writer.h"
#include "tests/annotate/synthetic_frame.h"

namespace throng::annotate {
namespace {

// About what a drone sees: 625 people of 20 to 100 pixels, or 5000 of a third of that.
const render::Frame& frame_with(std::int64_t people) {
  static std::map<std::int64_t, render::Frame> frames;
  auto [entry, is_new] = frames.try_emplace(people);
  if (is_new) {
    SyntheticScene scene;
    scene.width = 1920;
    scene.height = 1080;
    scene.people = static_cast<int>(people);
    scene.min_size_px = people > 1000 ? 5 : 15;
    scene.max_size_px = people > 1000 ? 15 : 40;
    entry->second = synthetic_frame(scene);
    entry->second.depth_m.assign(entry->second.id.size(), 9);
    for (render::PersonInView& person : entry->second.people) {
      for (std::size_t i = 0; i < person.keypoints.size(); ++i) {
        const auto shift = 0.1F * static_cast<float>(i);
        person.keypoints[i] = person.hips.cast<float>() + Eigen::Vector3f(shift, -shift, shift / 3);
      }
    }
  }
  return entry->second;
}

std::vector<Eigen::Vector2d> head_positions(const render::Frame& frame) {
  std::vector<Eigen::Vector2d> heads;
  heads.reserve(frame.people.size());
  for (const render::PersonInView& person : frame.people) {
    heads.push_back(frame.camera.project(person.head).pixel + Eigen::Vector2d(0.5, 0.5));
  }
  return heads;
}

CocoImage coco_image(const render::Frame& frame) {
  CocoImage image;
  image.file_name = "run000/d1/000000.jpg";
  image.run = "run000";
  image.camera_id = "d1";
  image.camera = frame.camera;
  return image;
}

// A shard in a folder of its own, which goes away with it.
class ScratchShard {
 public:
  ScratchShard()
      : folder_(std::filesystem::temp_directory_path() / "throng_bench_annotate"),
        writer_(folder_) {}
  ~ScratchShard() { std::filesystem::remove_all(folder_); }
  ScratchShard(const ScratchShard&) = delete;
  ScratchShard& operator=(const ScratchShard&) = delete;
  CocoShardWriter& writer() { return writer_; }

 private:
  std::filesystem::path folder_;
  CocoShardWriter writer_;
};

void label(benchmark::State& state) {
  const render::Frame& frame = frame_with(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(label_people(frame));
  state.SetItemsProcessed(state.iterations());
  state.counters["visible"] = static_cast<double>(label_people(frame).people.size());
}

void density(benchmark::State& state) {
  const render::Frame& frame = frame_with(state.range(0));
  const auto heads = head_positions(frame);
  for (auto _ : state) {
    benchmark::DoNotOptimize(density_map(heads, frame.width(), frame.height(), 4));
  }
  state.SetItemsProcessed(state.iterations());
}

void coco_add(benchmark::State& state) {
  const render::Frame& frame = frame_with(state.range(0));
  const FrameLabels labels = label_people(frame);
  CocoImage image = coco_image(frame);
  ScratchShard shard;
  for (auto _ : state) {
    ++image.id;
    shard.writer().add(image, labels);
  }
  state.SetItemsProcessed(state.iterations());
}

void keypoints(benchmark::State& state) {
  const render::Frame& frame = frame_with(state.range(0));
  FrameLabels labels = label_people(frame);
  for (auto _ : state) add_keypoints(frame, labels);
  state.SetItemsProcessed(state.iterations());
}

// Boxes, masks, visibility, density and the COCO records: all but the image.
void annotate_all(benchmark::State& state, bool with_keypoints) {
  const render::Frame& frame = frame_with(state.range(0));
  CocoImage image = coco_image(frame);
  ScratchShard shard;
  for (auto _ : state) {
    ++image.id;
    FrameLabels labels = label_people(frame);
    if (with_keypoints) add_keypoints(frame, labels);
    shard.writer().add(image, labels);
    benchmark::DoNotOptimize(
        npy_bytes(density_map(head_positions(frame), frame.width(), frame.height(), 4)));
  }
  state.SetItemsProcessed(state.iterations());
}
void annotate_frame(benchmark::State& state) { annotate_all(state, false); }
void annotate_with_keypoints(benchmark::State& state) { annotate_all(state, true); }

// Each head's kernel as wide as its three nearest neighbors say, from 2 to 40 px.
void density_adaptive(benchmark::State& state) {
  const render::Frame& frame = frame_with(state.range(0));
  const auto heads = head_positions(frame);
  std::vector<double> sigmas;
  for (std::size_t i = 0; i < heads.size(); ++i) {
    sigmas.push_back(2 + 38 * static_cast<double>(i % 20) / 20);
  }
  for (auto _ : state) {
    benchmark::DoNotOptimize(density_map(heads, sigmas, frame.width(), frame.height()));
  }
  state.SetItemsProcessed(state.iterations());
}

void preview(benchmark::State& state) {
  const render::Frame& frame = frame_with(state.range(0));
  const FrameLabels labels = label_people(frame);
  for (auto _ : state) benchmark::DoNotOptimize(draw_preview(frame, labels));
  state.SetItemsProcessed(state.iterations());
}

void jpeg(benchmark::State& state) {
  const render::Frame& frame = frame_with(state.range(0));
  const auto rgb = draw_preview(frame, label_people(frame));
  for (auto _ : state) {
    benchmark::DoNotOptimize(images::jpeg_bytes(rgb, frame.width(), frame.height(), 95));
  }
  state.SetItemsProcessed(state.iterations());
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->ArgName("people")->Arg(625)->Arg(5000)->Unit(benchmark::kMillisecond);
}

BENCHMARK(label)->Name("BM_Label")->Apply(sizes);
BENCHMARK(density)->Name("BM_Density")->Apply(sizes);
BENCHMARK(coco_add)->Name("BM_CocoAdd")->Apply(sizes);
BENCHMARK(keypoints)->Name("BM_Keypoints")->Apply(sizes);
BENCHMARK(annotate_frame)->Name("BM_Annotate")->Apply(sizes);
BENCHMARK(annotate_with_keypoints)->Name("BM_AnnotateKeypoints")->Apply(sizes);
BENCHMARK(density_adaptive)->Name("BM_DensityOfManyWidths")->Apply(sizes);
BENCHMARK(preview)->Name("BM_Preview")->Apply(sizes);
BENCHMARK(jpeg)->Name("BM_Jpeg")->Apply(sizes);

}  // namespace
}  // namespace throng::annotate
