#include "live/flight/session.h"

#include <unistd.h>

#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "jobs/pipeline/runs/job_scenario.h"
#include "jobs/queue/workers/worker_process.h"
#include "live/flight/flight.h"
#include "live/flight/flight_recording.h"
#include "live/flight/flight_topics.h"
#include "live/flight/onboard_camera.h"
#include "live/flight/people_in_motion.h"
#include "live/flight/state_message.h"
#include "live/loop/control.h"
#include "live/loop/flight_loop.h"
#include "live/loop/input_lines.h"
#include "render/allocator.h"
#include "spec/job/resolved_job.h"
#include "spec/live/commands.h"
#include "spec/live/messages.h"

namespace throng::live {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

std::string failure_message(const jobs::WorkerError& error) {
  // File names and messages of libraries may hold any bytes.
  return framed(
      {MessageType::failure, to_json(error).dump(-1, ' ', false, json::error_handler_t::replace)});
}

/// The recording of a flight: its topics, as they are sent to other programs, in a file.
class TopicRecording {
 public:
  /// Begins the file in `folder`. If its topics are invalid, it ends with a message instead.
  TopicRecording(const fs::path& folder, const RecordingOptions& options, const jobs::JobSpec& job,
                 const Flight& flight, const skinning::Population& population)
      : recording_(folder / kRecordingFile, options.min_free_bytes, options.max_bytes) {
    try {
      topics_.emplace(job, flight, statures_m(flight.header(), population, clothing(job)),
                      [this](const ros::TopicMessage& message) { recording_.add(message); });
      topics_->add(*flight.moment(0), {}, {});
    } catch (const InputError& error) {
      recording_.stop(error.what());
    }
  }

  FlightTopics* topics() { return topics_ ? &*topics_ : nullptr; }
  json finish() { return recording_.finish(); }

 private:
  FlightRecording recording_;
  std::optional<FlightTopics> topics_;
};

class Session {
 public:
  Session(const jobs::JobSpec& job, const world::Scenario& scenario, const fs::path& folder,
          const std::optional<RecordingOptions>& record, jobs::WorkerProcess& process)
      : job_(job),
        scenario_(scenario),
        process_(process),
        population_(skinning::load_population(skinning::population_folder())),
        flight_(job, scenario, folder),
        control_(drone_ids(flight_), {.is_watched = false}) {
    control_.begin(flight_.moment(0));
    if (record) recording_.emplace(folder, *record, job, flight_, population_);
  }

  void run() {
    const std::jthread reader([this](const std::stop_token& stop) { read(stop); });
    send(MessageType::hello, make_hello(flight_, scenario_, smoke_amount(job_)).dump());
    FlightParts parts;
    parts.step = [this](const PilotInput& input) { return step(input); };
    parts.rest = [this] {
      send(MessageType::state, state_bytes(*control_.shown().moment, 0, true));
    };
    parts.rest();
    parts.images = images();
    fly(control_, parts);
    json result = flight_.finish();
    result["recording"] = recording_ ? recording_->finish() : json();
    send(MessageType::result, result.dump());
  }

 private:
  /// The topics that are recorded; null if there are none.
  FlightTopics* topics() { return recording_ ? recording_->topics() : nullptr; }

  void send(MessageType type, std::string bytes) {
    process_.send(framed({type, std::move(bytes)}));
  }

  /// Without somebody at the other end there is no flight.
  void read(const std::stop_token& stop) {
    try {
      read_lines(STDIN_FILENO, stop, [this](const std::string& line) { take(line); });
      if (!stop.stop_requested()) throw EnvironmentError("the service has left the flight");
    } catch (...) {
      control_.fail(std::current_exception());
    }
  }

  void take(const std::string& line) {
    const json message = parse_own_json(line, "the service's message");
    if (const auto given = message.find("commands"); given != message.end()) {
      control_.command(commands_from_json(*given, flown_drones(flight_)));
    }
    if (const auto viewers = message.find("viewers"); viewers != message.end()) {
      control_.watch(viewers->get<int>() > 0);
    }
    if (message.value("stop", false)) control_.end();
  }

  std::shared_ptr<const Moment> step(const PilotInput& input) {
    const double reached_factor = control_.reached_factor();
    std::shared_ptr<const Moment> moment = flight_.step(input.commands, input.sequence);
    const std::vector<json> events = flight_.take_events();
    for (const json& event : events) send(MessageType::event, event.dump());
    if (FlightTopics* const recorded = topics()) recorded->add(*moment, input.commands, events);
    send(MessageType::state, state_bytes(*moment, reached_factor, false));
    return moment;
  }

  FlightImages images() {
    FlightImages images;
    images.begin = [this]() -> DrawImage {
      const auto camera = std::make_shared<OnboardCamera>(job_, scenario_, population_,
                                                          flight_.header(), flight_.drones());
      return [camera](const Moment& moment, std::size_t drone, double time_s) {
        return camera->image(moment, drone, time_s);
      };
    };
    images.is_wanted = [this](std::size_t drone) {
      return control_.is_watched() && control_.input().view == drone;
    };
    images.take = [this](const FlightImage& image) {
      const Moment& moment = *image.moment;
      send(MessageType::image, image_bytes(moment, image.time_s, image.drone, image.jpeg));
      FlightTopics* const recorded = topics();
      if (recorded != nullptr && image.is_new) {
        recorded->add_image(moment, image.drone, image.time_s, image.jpeg);
      }
    };
    return images;
  }

  const jobs::JobSpec& job_;
  const world::Scenario& scenario_;
  jobs::WorkerProcess& process_;
  const skinning::Population population_;
  Flight flight_;  ///< of the thread that flies, but for what never changes
  std::optional<TopicRecording> recording_;  ///< of the thread that flies, but for images
  Control control_;
};

}  // namespace

int run_session(const fs::path& folder, const std::optional<RecordingOptions>& record) {
  const fs::path scenarios = world::scenarios_folder();
  jobs::WorkerProcess process({.folder = folder, .unnamed = {scenarios}, .keeps_shaders = true});
  render::tune_allocator();
  const auto work = [&] {
    const jobs::ResolvedJob job =
        jobs::read_resolved_job(read_file(folder / "job.json"), (folder / "job.json").string());
    const world::Scenario scenario = jobs::load_job_scenario(job.spec(), scenarios);
    Session(job.spec(), scenario, folder, record, process).run();
  };
  return process.run(work, failure_message);
}

}  // namespace throng::live
