// Frames per second of this machine's cores on the whole way to a dataset: 1920 x 1080, a drone at
// 30 m looking down 45 degrees with 70 degrees across; drawn by Mesa's software driver or a GPU
// (--device gpu, with 4 samples a pixel), read back, labeled, and image, boxes, masks and depth
// written into a folder in memory. One process per core, as jobs do it. With --draw-only frames are
// drawn and read back.
// The place is a bare square, or the middle of a shipped scenario.
//   bench_render [--stages] [--seconds S] [--images FOLDER] [--quality WORD] [--people COUNT]
//                [--device WORD] [--processes COUNT] [--draw-only] [--scenario ID] [--stand]
// With --stand, people are spectators of a stand with seats for 20 000, all of which a drone sees.
#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "annotate/people/coco.h"
#include "annotate/people/labels.h"
#include "annotate/rasters/png.h"
#include "base/compute/random.h"
#include "base/files/files.h"
#include "base/geometry/angle.h"
#include "base/graphics/images/jpeg_writer.h"
#include "jobs/queue/dataset/publication.h"
#include "places/scenarios/blueprint/load_scenario.h"
#include "render/allocator.h"
#include "render/renderer.h"
#include "skinning/animate/spectator_pose.h"
#include "tests/render/synthetic_people.h"
#include "world/stand_seats.h"

namespace throng {
namespace {

struct Settings {
  bool stages = false;
  double seconds = 4;
  std::string images;   ///< folder for one frame of each kind, or ""
  std::string quality;  ///< only this one, or ""
  std::vector<std::uint32_t> people = {625, 5000};
  std::string device = "software";
  unsigned processes = std::max(1U, std::thread::hardware_concurrency());
  bool draw_only = false;
  std::string scenario;  ///< id of a shipped one, or ""
  bool stand = false;    ///< people sit on a stand
};

skinning::Population people_to_draw() {
  const std::filesystem::path folder = skinning::population_folder();
  return std::filesystem::exists(folder) ? skinning::load_population(folder)
                                         : render::synthetic_people(8);
}

/// The stand that the drone at (0, 110, 40) sees.
world::Stand large_stand() {
  world::Stand stand;
  stand.id = "stand";
  stand.from = {-100, 0};
  stand.to = {100, 0};
  stand.rows = 64;
  stand.front_height_m = 1.2;
  return stand;
}

world::Scenario place_of_stand() {
  world::Scenario scenario;
  scenario.id = "bench";
  scenario.ground = {{-130, -80}, {130, 130}};
  scenario.ground_material = "grass";
  scenario.stands = {large_stand()};
  return scenario;
}

world::Scenario place(const std::string& id) {
  if (!id.empty()) return scenarios::find_scenario(world::scenarios_folder(), id);
  world::Scenario scenario;
  scenario.id = "bench";
  scenario.ground = {{-60, -60}, {60, 60}};
  scenario.ground_material = "pavers";
  for (const double x : {-45.0, 45.0}) {
    world::Building& building = scenario.buildings.emplace_back();
    building.footprint = {{x - 5, -30}, {x + 5, -30}, {x + 5, 30}, {x - 5, 30}};
  }
  return scenario;
}

/// Sees the ground from 10 m to 90 m in front of it; its middle is 30 m ahead. Or the stand.
camera::Camera drone(const world::Scenario& scenario) {
  if (!scenario.stands.empty()) {
    return {camera::intrinsics_from_hfov(1920, 1080, 84 * kDegree),
            camera::pose_looking({0, 110, 40}, -90 * kDegree, -12 * kDegree)};
  }
  const Eigen::Vector2d middle = scenario.inside.bounds.center();
  return {camera::intrinsics_from_hfov(1920, 1080, 70 * kDegree),
          camera::pose_looking({middle.x(), middle.y() - 30, 30}, 90 * kDegree, -45 * kDegree)};
}

/// Spectators who sit, stand and cheer.
render::Scene spectators(const skinning::Population& people, world::Stand stand,
                         std::uint32_t count) {
  stand.spectators = {static_cast<int>(count), 1};
  const std::vector<world::Seat> seats = world::seats(stand);
  const skinning::SpectatorPoses poses(people);
  render::Scene scene;
  for (const std::size_t i : world::taken_seats(stand, seats)) {
    render::PersonInstance person;
    person.agent = static_cast<std::uint32_t>(scene.people.size());
    person.position << seats[i].position.cast<float>(), static_cast<float>(seats[i].height_m);
    person.appearance = skinning::sample_appearance(people, 1, person.agent);
    person.yaw_rad = static_cast<float>(world::facing_rad(stand));
    skinning::PostureTime posture;
    posture.now = posture.before = person.agent % 3 == 0   ? skinning::StandPosture::cheering
                                   : person.agent % 3 == 1 ? skinning::StandPosture::standing
                                                           : skinning::StandPosture::sitting;
    posture.since_s = 2;
    const double phase = person.appearance.phase_offset;
    person.pose = poses.at(posture, phase, 2 + phase);
    person.actions = skinning::SpectatorPoses::actions(posture, phase);
    scene.people.push_back(person);
  }
  return scene;
}

/// Walkers spread over what the drone sees.
render::Scene crowd(const skinning::Population& people, const world::Scenario& scenario,
                    std::uint32_t count) {
  const camera::Camera camera = drone(scenario);
  const Eigen::Vector2d middle = scenario.inside.bounds.center();
  render::Scene scene;
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(1, Stream::crowd_generator, i);
    render::PersonInstance person;
    person.agent = i;
    Eigen::Vector2d pixel;
    do {
      const Eigen::Vector2d at =
          middle + Eigen::Vector2d(random.uniform(-35, 35), random.uniform(-20, 40));
      person.position = {static_cast<float>(at.x()), static_cast<float>(at.y()), 0};
      pixel = camera.project(person.position.cast<double>()).pixel;
    } while (pixel.minCoeff() < 0 || pixel.x() > 1919 || pixel.y() > 1079);
    person.appearance = skinning::sample_appearance(people, 1, i);
    person.yaw_rad = static_cast<float>(random.uniform(-3.1, 3.1));
    const double speed_mps = random.uniform() < 0.2 ? 2.8 : 1.3;
    person.pose = skinning::pose_at(people, random.uniform(), speed_mps, 0);
    scene.people.push_back(person);
  }
  return scene;
}

/// Figures of one process.
struct Figures {
  double frames = 0;
  double wall_s = 0;
  double cpu_s = 0;
  double min_cpu_s = 1e9;  ///< of one frame
};

double cpu_s() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The work of a job's worker, frame by frame.
class Worker {
 public:
  Worker(render::Quality quality, std::uint32_t count, const Settings& settings, StageClock* clock)
      : clock_(clock),
        draw_only_(settings.draw_only),
        people_(people_to_draw()),
        scenario_(settings.stand ? place_of_stand() : place(settings.scenario)),
        folder_(std::filesystem::path("/dev/shm") / fmt::format("throng_bench_{}", ::getpid())),
        renderer_(scenario_, people_, {}, {settings.device}, {.quality = quality, .clock = clock}),
        scene_(settings.stand ? spectators(people_, scenario_.stands.front(), count)
                              : crowd(people_, scenario_, count)),
        coco_(folder_ / "coco") {}
  ~Worker() { std::filesystem::remove_all(folder_); }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void frame() {
    if (clock_ != nullptr) clock_->skip();
    render::Frame frame = renderer_.draw(scene_, drone(scenario_));
    if (draw_only_) return renderer_.recycle(std::move(frame));
    const annotate::FrameLabels labels = annotate::label_people(frame);
    lap("labels");
    jpeg_ = images::jpeg_bytes(frame.rgb, frame.width(), frame.height(), 95);
    lap("jpeg");
    const std::string depth = annotate::depth_png(frame);
    lap("png");
    // The same names again and again: the disk is not what is measured.
    jobs::write_new_file(folder_ / "image.jpg", jpeg_);
    jobs::write_new_file(folder_ / "depth.png", depth);
    annotate::CocoImage image;
    image.id = next_++;
    image.file_name = "image.jpg";
    image.camera = frame.camera;
    coco_.add(image, labels);
    lap("write");
    renderer_.recycle(std::move(frame));
  }

  const std::string& jpeg() const { return jpeg_; }

 private:
  void lap(std::string_view stage) {
    if (clock_ != nullptr) clock_->lap(stage);
  }

  StageClock* clock_;
  bool draw_only_;
  skinning::Population people_;
  world::Scenario scenario_;
  std::filesystem::path folder_;
  render::Renderer renderer_;
  render::Scene scene_;
  annotate::CocoShardWriter coco_;
  std::string jpeg_;
  std::int64_t next_ = 0;
};

void print_stages(const StageClock& clock, double frames) {
  for (const auto& [stage, time] : clock.times()) {
    fmt::print(stderr, "    {:<12}{:8.2f} CPU ms\n", stage, 1000 * time.cpu_s / frames);
  }
}

Figures measure(render::Quality quality, std::uint32_t count, bool first,
                const Settings& settings) {
  render::tune_allocator();
  std::optional<StageClock> clock;
  if (settings.stages) clock.emplace();
  Worker worker(quality, count, settings, clock ? &*clock : nullptr);
  for (int i = 0; i < 2; ++i) worker.frame();
  if (clock) *clock = StageClock();
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const double cpu_begin_s = cpu_s();
  Figures figures;
  while (figures.wall_s < settings.seconds) {
    const double before_s = cpu_s();
    worker.frame();
    figures.min_cpu_s = std::min(figures.min_cpu_s, cpu_s() - before_s);
    ++figures.frames;
    figures.wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  figures.cpu_s = cpu_s() - cpu_begin_s;
  if (first && clock) print_stages(*clock, figures.frames);
  if (first && !settings.images.empty()) {
    write_file_atomically(
        std::filesystem::path(settings.images) /
            fmt::format("{}_{}.jpg", render::quality_settings(quality).word, count),
        worker.jpeg());
  }
  return figures;
}

void run(render::Quality quality, std::uint32_t count, const Settings& settings) {
  std::array<int, 2> pipe{};
  if (::pipe(pipe.data()) != 0) std::abort();
  for (unsigned i = 0; i < settings.processes; ++i) {
    if (::fork() != 0) continue;
    const Figures figures = measure(quality, count, i == 0, settings);
    const bool is_sent = ::write(pipe[1], &figures, sizeof(figures)) == sizeof(figures);
    std::_Exit(is_sent ? EXIT_SUCCESS : EXIT_FAILURE);
  }
  ::close(pipe[1]);
  double frames_per_s = 0;
  Figures all;
  for (Figures one; ::read(pipe[0], &one, sizeof(one)) == sizeof(one);) {
    frames_per_s += one.frames / one.wall_s;
    all.frames += one.frames;
    all.cpu_s += one.cpu_s;
    all.min_cpu_s = std::min(all.min_cpu_s, one.min_cpu_s);
  }
  ::close(pipe[0]);
  while (::wait(nullptr) > 0) {
  }
  if (all.frames == 0) {
    fmt::print("{:<10}{:>8}  no process drew a frame\n", render::quality_settings(quality).word,
               count);
    return;
  }
  const double cpu_ms = 1000 * all.cpu_s / all.frames;
  fmt::print("{:<10}{:>8}{:>14.1f}{:>16.1f}{:>10.1f}{:>20.1f}\n",
             render::quality_settings(quality).word, count, frames_per_s, cpu_ms,
             1000 * all.min_cpu_s, 1000 * settings.processes / cpu_ms);
}

}  // namespace
}  // namespace throng

int main(int count, char** arguments) {
  throng::Settings settings;
  for (int i = 1; i < count; ++i) {
    const std::string_view word = arguments[i];
    const char* value = i + 1 < count ? arguments[i + 1] : "";
    if (word == "--stages") settings.stages = true;
    if (word == "--seconds") settings.seconds = std::atof(value);
    if (word == "--images") settings.images = value;
    if (word == "--quality") settings.quality = value;
    if (word == "--device") settings.device = value;
    if (word == "--scenario") settings.scenario = value;
    if (word == "--processes")
      settings.processes = static_cast<unsigned>(std::max(1, std::atoi(value)));
    if (word == "--stand") settings.stand = true;
    if (word == "--draw-only") settings.draw_only = true;
    if (word == "--people") settings.people = {static_cast<std::uint32_t>(std::atoi(value))};
  }
  ::setenv("LP_NUM_THREADS", "0", 0);  // one core per process
  fmt::print("{:<10}{:>8}{:>14}{:>16}{:>10}{:>20}\n", "quality", "people", "frames/s",
             "CPU ms/frame", "least", "frames/s when idle");
  for (const throng::render::QualitySettings& row : throng::render::kQualities) {
    const auto quality =
        static_cast<throng::render::Quality>(&row - throng::render::kQualities.data());
    if (!settings.quality.empty() && settings.quality != row.word) continue;
    for (const std::uint32_t people : settings.people) throng::run(quality, people, settings);
    std::fflush(stdout);
  }
}
