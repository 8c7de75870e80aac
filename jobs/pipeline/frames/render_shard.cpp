#include "jobs/pipeline/frames/render_shard.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "annotate/frame_writers.h"
#include "annotate/people/actions.h"
#include "annotate/people/coco.h"
#include "annotate/people/hazard_view.h"
#include "annotate/people/labels.h"
#include "annotate/rasters/preview.h"
#include "annotate/rasters/zone_counts.h"
#include "base/error.h"
#include "base/graphics/images/jpeg_writer.h"
#include "camera/camera.h"
#include "jobs/pipeline/frames/frame_capture.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/pipeline/runs/run_input.h"
#include "jobs/queue/dataset/publication.h"
#include "jobs/queue/pinned_library.h"
#include "jobs/queue/profile.h"
#include "render/renderer.h"
#include "skinning/population.h"
#include "spec/job/environment.h"
#include "spec/job/spec.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::jobs {

namespace {

/// Facts of the run that labels need; members that the job does not ask for are empty.
struct RunViews {
  annotate::PersonFacts facts;
  std::optional<annotate::ExitView> exits = std::nullopt;
  std::optional<annotate::HazardView> hazards = std::nullopt;
  std::optional<annotate::ActionFacts> actions = std::nullopt;
  std::optional<std::vector<annotate::CountZone>> zones = std::nullopt;
};

RunViews make_run_views(const JobSpec& job, const world::Scenario& scenario,
                        const world::Trace& trace, const skinning::Population& population) {
  using annotate::GroundTruth;
  RunViews views{annotate::PersonFacts(trace, population, job.styling)};
  if (!wants(job, GroundTruth::coco)) return views;
  if (wants(job, GroundTruth::exits)) {
    views.exits.emplace(scenario, metrics::exit_series(trace, scenario), trace.time_s);
  }
  if (wants(job, GroundTruth::hazards)) views.hazards.emplace(scenario, trace);
  if (wants(job, GroundTruth::actions)) views.actions.emplace(trace, population, job.styling);
  if (wants(job, GroundTruth::counts)) {
    views.zones = annotate::count_areas(scenario, job.outputs.counts).zones;
  }
  return views;
}

template <typename View>
const View* pointer_to(const std::optional<View>& view) {
  return view ? &*view : nullptr;
}

// One shard in the making: everything that its frames share.
class ShardOutput {
 public:
  ShardOutput(const std::filesystem::path& output, const JobSpec& job, const Shard& shard,
              std::string environment, nlohmann::json drawn, const RunViews& views,
              const std::vector<std::string>& drone_ids, StageClock* clock)
      : job_(job),
        shard_(shard),
        views_(views),
        drone_ids_(drone_ids),
        environment_(std::move(environment)),
        drawn_(std::move(drawn)),
        clock_(clock),
        publication_(output) {
    if (wants(job, annotate::GroundTruth::coco)) {
      coco_.emplace(publication_.folder() / "coco");
    }
  }

  void add(const CapturedFrame& captured, std::size_t camera) {
    const render::Frame& frame = captured.frame;
    annotate::FrameLabels labels = annotate::label_people(frame);
    lap("labels");
    const std::string& drone = job_.drones[camera].mission.id;
    const std::string place = fmt::format("{}/{}/{:06}", run_name(shard_.run), drone, frame.index);
    annotate::CocoImage image;
    image.id = image_id(job_, shard_.run, camera, frame.index);
    image.file_name = "images/" + place + ".jpg";
    image.run = run_name(shard_.run);
    image.run_index = shard_.run;
    image.camera_id = drone;
    image.frame_index = frame.index;
    image.time_s = frame.time_s;
    image.camera = frame.camera;
    image.environment = environment_;
    image.drawn = drawn_of(captured);
    image.sensor = captured.sensor;
    image.flight = captured.flight;
    image.facts = &views_.facts;
    image.drone_ids = &drone_ids_;
    const std::string jpeg =
        images::jpeg_bytes(frame.rgb, frame.width(), frame.height(), job_.outputs.image_quality);
    lap("jpeg");
    publication_.add(image.file_name, jpeg);
    lap("write");
    write_kinds(frame, labels, jpeg, image);
    if (has_preview(job_, frame.index)) {
      publication_.add("previews/" + place + ".jpg",
                       images::jpeg_bytes(annotate::draw_preview(frame, labels), frame.width(),
                                          frame.height(), job_.outputs.image_quality));
      lap("previews");
    }
    if (coco_) coco_->add(image, labels);
    lap("write");
    annotations_ += static_cast<std::int64_t>(labels.people.size() + labels.objects.size());
    for (const annotate::PersonLabel& label : labels.people) agents_.insert(label.agent);
    ++images_;
  }

  void publish(const std::string& device) {
    if (coco_) coco_->finish();
    publication_.publish({{"device", device},
                          {"images", images_},
                          {"annotations", annotations_},
                          {"agents", agents_}});
  }

 private:
  /// The values sampled for the run and for the frame, or "".
  std::string drawn_of(const CapturedFrame& captured) const {
    nlohmann::json drawn = drawn_;
    drawn.update(captured.drawn);
    return drawn.empty() ? "" : drawn.dump();
  }

  // Every kind of ground truth that is asked for.
  void write_kinds(const render::Frame& frame, annotate::FrameLabels& labels, std::string_view jpeg,
                   annotate::CocoImage& image) {
    annotate::FrameOutput output{
        .frame = frame,
        .labels = labels,
        .jpeg = jpeg,
        .record = image,
        .exits = pointer_to(views_.exits),
        .actions = pointer_to(views_.actions),
        .hazards = pointer_to(views_.hazards),
        .zones = pointer_to(views_.zones),
        .density_sigma_px = job_.outputs.density_sigma_px,
        .add = [this](const std::string& path,
                      std::string_view bytes) { publication_.add(path, bytes); },
        .lap = [this](std::string_view stage) { lap(stage); }};
    for (const annotate::FrameWriter& writer : annotate::frame_writers()) {
      if (wants(job_, writer.kind)) writer.write(output);
    }
  }

  void lap(std::string_view stage) {
    if (clock_ != nullptr) clock_->lap(stage);
  }

  const JobSpec& job_;
  const Shard& shard_;
  const RunViews& views_;
  const std::vector<std::string>& drone_ids_;
  std::string environment_;  ///< JSON
  nlohmann::json drawn_;     ///< for the run
  StageClock* clock_;
  Publication publication_;
  std::optional<annotate::CocoShardWriter> coco_;
  std::int64_t images_ = 0;
  std::int64_t annotations_ = 0;
  std::set<std::uint32_t> agents_;
};

}  // namespace

void render_shard(const JobFolder& folder, const JobSpec& whole_job,
                  const std::filesystem::path& scenarios, const Shard& shard,
                  const OnTaskProgress& on_progress, const std::stop_token& stop) {
  JobSpec job = job_of_run(whole_job, shard.run);
  const std::uint64_t seed = run_seed(job, shard.run);
  const world::Trace trace = world::read_trace(folder.output_of({Task::Kind::simulate, shard.run}));
  world::Scenario scenario = scenario_of_run(job, scenarios, trace.header);
  world::thin_out(scenario, job.props_density, seed);
  const skinning::Population population = skinning::load_population(skinning::population_folder());
  pin_library(folder, population.content_hash);
  const RunEnvironment environment = environment_of_run(job.environment, seed);
  job.styling = styling_in(job, environment.light.weather);
  std::optional<StageClock> clock;
  if (is_profiling()) clock.emplace();
  render::RenderOptions options;
  options.quality = job.quality;
  const annotate::RenderNeeds needs = annotate::render_needs(job.outputs.annotations);
  options.normals = needs.normals;
  options.flow = needs.flow;
  options.flow_backward = needs.flow_backward;
  options.flow_depth = needs.flow_depth;
  options.hazard_opacity = needs.hazard_opacity;
  options.scene_flow = needs.scene_flow;
  options.parts = needs.parts;
  options.semantic = needs.semantic;
  options.whole_masks = needs.whole_masks;
  options.bone_turns = needs.bone_turns;
  options.vehicles = needs.vehicles;
  options.light_folder = folder.path() / "work" / "light";
  options.clock = clock ? &*clock : nullptr;
  render::Renderer renderer(scenario, population, environment.light, {}, options);
  FrameCapture frame_capture(job, seed, scenario, trace, population, renderer, options.clock);

  const Task task{Task::Kind::render, shard.run, shard.index};
  const nlohmann::json drawn = samples_of_run(whole_job, shard.run);
  RunViews views = make_run_views(job, scenario, trace, population);
  ShardOutput output(folder.output_of(task), job, shard, to_json(environment).dump(), drawn, views,
                     trace.header.drone_ids, options.clock);
  const double images = static_cast<double>((shard.end_frame - shard.first_frame) *
                                            static_cast<std::int64_t>(job.drones.size()));
  double done = 0;
  for (std::int64_t frame = shard.first_frame; frame < shard.end_frame; ++frame) {
    if (views.hazards) views.hazards->advance(job.frame_time_s(frame));
    for (std::size_t i = 0; i < job.drones.size(); ++i) {
      if (stop.stop_requested()) throw Cancelled();
      CapturedFrame captured = frame_capture.take(i, frame);
      output.add(captured, i);
      frame_capture.recycle(std::move(captured));
      if (on_progress) on_progress({++done, images});
    }
  }
  if (clock) write_profile(folder, task, *clock, static_cast<std::int64_t>(done));
  output.publish(renderer.device_description());
}

}  // namespace throng::jobs
