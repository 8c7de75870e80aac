#include "live/flight/outside/outside_flight.h"

#include <fmt/core.h>
#include <unistd.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "live/flight/flight.h"
#include "live/flight/flight_recording.h"
#include "live/flight/flight_topics.h"
#include "live/flight/onboard_camera.h"
#include "live/flight/outside/foxglove_bridge.h"
#include "live/flight/outside/kept_flight.h"
#include "live/flight/people_in_motion.h"
#include "live/loop/control.h"
#include "live/loop/flight_loop.h"
#include "render/allocator.h"
#include "skinning/population_files.h"
#include "spec/job/scenario_mix.h"

namespace throng::live {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Recordings end when the disk has less free space.
constexpr std::uint64_t kMinFreeBytes = std::uint64_t{512} << 20;

/// One flight, from the start of the job or a reset to the next one.
struct Stage {
  Stage(jobs::JobSpec its_job, const fs::path& scenarios, const fs::path& final_folder,
        double max_s)
      : job(std::move(its_job)),
        scenario(jobs::load_job_scenario(job, scenarios)),
        folder(final_folder),
        flight(job, scenario, folder.path(), max_s) {}

  jobs::JobSpec job;
  world::Scenario scenario;
  StagingFolder folder;
  Flight flight;
};

/// Parameters that nobody can set.
std::vector<foxglove::Parameter> facts(const Stage& stage) {
  const world::TraceHeader& header = stage.flight.header();
  std::vector<foxglove::Parameter> facts = {{"scenario", stage.scenario.id},
                                            {"seed", stage.job.seed},
                                            {"people", header.agent_count()},
                                            {"step_s", stage.flight.dt_s()},
                                            {"drones", drone_ids(stage.flight)}};
  for (const sim::PlannedDrone& drone : stage.flight.drones()) {
    const std::string root = drone.mission.id + "/";
    const camera::CameraSpec camera = shown_camera(drone.mission.camera);
    facts.push_back({root + "airframe", drone.mission.airframe});
    facts.push_back({root + "start_m", {drone.start.x(), drone.start.y(), drone.start.z()}});
    facts.push_back({root + "camera_hfov_deg", camera.hfov_deg});
    facts.push_back({root + "camera_pitch_deg", camera.pitch_deg});
    facts.push_back({root + "camera_yaw_deg", camera.yaw_deg});
  }
  return facts;
}

class OutsideFlight {
 public:
  OutsideFlight(const jobs::JobSpec& job, fs::path scenarios, const OutsideOptions& options,
                const OutsideNews& news, const std::stop_token& stop)
      : scenarios_(std::move(scenarios)),
        options_(options),
        news_(news),
        population_(skinning::load_population(skinning::population_folder())),
        first_folder_(options.output.empty() ? 0 : first_free_number(options.output)),
        stage_(make_stage(jobs::in_scenario_of_run(job, 0), 0)),
        control_(drone_ids(stage_->flight),
                 {.factor = options.factor, .paused = options.paused, .max_s = options.duration_s},
                 stop) {
    control_.begin(stage_->flight.moment(0));
    foxglove::ServerOptions server;
    server.name = "throng: " + (job.name.empty() ? stage_->scenario.id : job.name);
    server.host = options.host;
    server.port = options.port;
    server.origins = options.origins;
    bridge_.emplace(server, flown_drones(stage_->flight), ros_names(stage_->flight),
                    options.has_camera, control_);
    bridge_->set_facts(facts(*stage_));
  }

  void run() {
    news_.on_listening(bridge_->port());
    while (fly_stage()) {
    }
  }

 private:
  /// The folder of a flight, by its number since the program began.
  fs::path folder(int flight) const {
    if (!options_.output.empty()) return flight_folder(options_.output, first_folder_ + flight);
    return fs::temp_directory_path() / fmt::format("throng-live-{}-{}", ::getpid(), flight);
  }

  std::unique_ptr<Stage> make_stage(jobs::JobSpec job, int flight) const {
    return std::make_unique<Stage>(std::move(job), scenarios_, folder(flight), options_.duration_s);
  }

  /// Flies until the end or a reset; returns whether there is another flight.
  bool fly_stage() {
    std::optional<FlightRecording> recording;
    const fs::path file = recording_file(options_.recording, flights_);
    if (!options_.recording.empty()) recording.emplace(file, kMinFreeBytes);
    Flight& flight = stage_->flight;
    FlightTopics topics(stage_->job, flight,
                        statures_m(flight.header(), population_, clothing(stage_->job)),
                        [&](const ros::TopicMessage& message) {
                          if (recording) recording->add(message);
                          bridge_->publish(message);
                        });
    topics.add(*flight.moment(0), {}, {});
    std::unique_ptr<Stage> next;
    FlightParts parts;
    parts.step = [&](const PilotInput& input) { return step(input, topics); };
    parts.reset = [&] {
      next = begin_anew();
      return next != nullptr;
    };
    if (options_.has_camera) parts.images = images(topics, recording.has_value());
    const bool is_reset = fly(control_, parts);
    end_stage(recording ? &*recording : nullptr, file);
    if (!is_reset) return false;
    stage_ = std::move(next);
    ++flights_;
    control_.begin(stage_->flight.moment(0));
    bridge_->set_facts(facts(*stage_));
    const Control::Answer answer = std::exchange(reset_answer_, nullptr);
    answer("", 0);
    return true;
  }

  std::shared_ptr<const Moment> step(const PilotInput& input, FlightTopics& topics) {
    Flight& flight = stage_->flight;
    std::shared_ptr<const Moment> moment = flight.step(input.commands, input.sequence);
    topics.add(*moment, input.commands, flight.take_events());
    news_.on_step(moment->time_s, control_.reached_factor());
    return moment;
  }

  FlightImages images(FlightTopics& topics, bool is_recorded) {
    FlightImages images;
    images.begin = [this]() -> DrawImage {
      const Flight& flight = stage_->flight;
      const auto camera = std::make_shared<OnboardCamera>(
          stage_->job, stage_->scenario, population_, flight.header(), flight.drones());
      return [camera](const Moment& moment, std::size_t drone, double time_s) {
        return camera->image(moment, drone, time_s);
      };
    };
    images.is_wanted = [this, is_recorded](std::size_t drone) {
      return bridge_->wants_images(drone) || (is_recorded && control_.input().view == drone);
    };
    images.take = [&topics](const FlightImage& image) {
      topics.add_image(*image.moment, image.drone, image.time_s, image.jpeg);
    };
    images.fail = [this](const std::string& problem) {
      fmt::print(stderr, "throng: no more images: {}\n", problem);
      bridge_->tell(foxglove::Level::error, "no more images: " + problem);
    };
    return images;
  }

  /// The flight after a reset; null if the job cannot be flown with that seed.
  std::unique_ptr<Stage> begin_anew() {
    const Control::Reset reset = control_.take_reset();
    jobs::JobSpec job = stage_->job;
    if (reset.seed) job.seed = *reset.seed;
    try {
      std::unique_ptr<Stage> next = make_stage(std::move(job), flights_ + 1);
      if (drone_ids(next->flight) != drone_ids(stage_->flight)) {
        throw InputError({"/throng/reset", "/seed", "other drones", "a seed with the same ones"});
      }
      reset_answer_ = reset.answer;
      return next;
    } catch (const InputError& error) {
      reset.answer(error.what(), stage_->flight.time_s());
      return nullptr;
    }
  }

  void end_stage(FlightRecording* recording, const fs::path& file) {
    Flown flown;
    flown.duration_s = stage_->flight.time_s();
    if (recording != nullptr) {
      const json result = recording->finish();
      flown.recording = file;
      if (result.at("problem").is_string()) flown.recording_problem = result.at("problem");
    }
    // A job cannot repeat a flight without a step.
    if (!options_.output.empty() && flown.duration_s > 0) {
      json result = stage_->flight.finish();
      flown.warnings = result.at("warnings").get<std::vector<std::string>>();
      result["seed"] = stage_->job.seed;
      write_flight(std::move(result), stage_->folder.path());
      flown.folder = folder(flights_);
      stage_->folder.commit();
    }
    const std::string text = fmt::format("the flight has ended at {:.1f} s", flown.duration_s);
    control_.refuse_all(text);
    bridge_->tell(foxglove::Level::info, text);
    news_.on_flown(flown);
  }

  const fs::path scenarios_;
  const OutsideOptions& options_;
  const OutsideNews& news_;
  const skinning::Population population_;
  const int first_folder_;  ///< number of the first flight's folder
  int flights_ = 0;         ///< that are over
  std::unique_ptr<Stage> stage_;
  Control control_;
  Control::Answer reset_answer_;
  std::optional<FoxgloveBridge> bridge_;
};

}  // namespace

void fly_outside(const jobs::JobSpec& job, const fs::path& scenarios, const OutsideOptions& options,
                 const OutsideNews& news, const std::stop_token& stop) {
  render::tune_allocator();
  OutsideFlight(job, scenarios, options, news, stop).run();
}

}  // namespace throng::live
