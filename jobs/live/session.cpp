#include "jobs/live/session.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "base/json/problem_json.h"
#include "base/text/redact.h"
#include "jobs/live/flight.h"
#include "jobs/live/flight_recording.h"
#include "jobs/live/flight_topics.h"
#include "jobs/live/onboard_camera.h"
#include "jobs/live/people_in_motion.h"
#include "jobs/live/state_message.h"
#include "jobs/live/step_clock.h"
#include "jobs/live/wishes.h"
#include "jobs/pipeline/job_scenario.h"
#include "jobs/queue/confine/file_fence.h"
#include "jobs/queue/workers/worker_interface.h"
#include "render/allocator.h"
#include "spec/job/resolved_job.h"
#include "spec/live/commands.h"
#include "spec/live/messages.h"

namespace throng::live {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

namespace {

/// The way to the service: takes stdout for itself, so that a driver that prints there cannot spoil
/// a message.
class Output {
 public:
  Output() : output_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)) {
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~Output() { ::close(output_); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void send(MessageType type, std::string bytes) {
    const std::string message = framed({type, std::move(bytes)});
    const std::lock_guard lock(mutex_);
    std::string_view rest = message;
    while (!rest.empty()) {
      const ssize_t count = ::write(output_, rest.data(), rest.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) std::_Exit(jobs::worker_environment_error);  // nobody is there
      rest.remove_prefix(static_cast<std::size_t>(count));
    }
  }

 private:
  int output_;
  std::mutex mutex_;
};

class Session {
 public:
  /// `give_up` reports the current exception and ends the process.
  Session(const jobs::JobSpec& job, const world::Scenario& scenario, const fs::path& folder,
          const std::optional<RecordingOptions>& record, Output& output,
          std::function<void()> give_up)
      : scenario_(scenario),
        job_(job),
        output_(output),
        give_up_(std::move(give_up)),
        population_(skinning::load_population(skinning::population_folder())),
        flight_(job, scenario, folder),
        flown_(flight_.flown_drones()) {
    for (const FlownDrone& drone : flown_) ids_.push_back(drone.id);
    wishes_.commands.resize(ids_.size());
    moment_ = flight_.moment(0);
    if (record) begin_recording(folder, *record);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Ends the process: the reader waits for input, and nothing can end that.
  [[noreturn]] void run() {
    std::thread([this] { read(); }).detach();
    try {
      output_.send(MessageType::hello, make_hello(flight_, scenario_, smoke_amount(job_)).dump());
      output_.send(MessageType::state, state_bytes(*moment_, 0, true));
      {
        const std::jthread camera([this](const std::stop_token& stop) { show(stop); });
        fly();
      }
      if (failure_) std::rethrow_exception(failure_);
      json result = flight_.finish();
      result["recording"] = recording_ ? recording_->finish() : json();
      output_.send(MessageType::result, result.dump());
    } catch (...) {
      if (recording_) recording_->finish();
      give_up_();
    }
    std::_Exit(jobs::worker_succeeded);
  }

 private:
  void begin_recording(const fs::path& folder, const RecordingOptions& options) {
    recording_.emplace(folder / kRecordingFile, options.min_free_bytes, options.max_bytes);
    try {
      topics_.emplace(job_, flight_, statures_m(flight_.header(), population_, clothing(job_)),
                      [this](const ros::TopicMessage& message) { recording_->add(message); });
      topics_->add(*moment_, {}, {});
    } catch (const InputError& error) {
      recording_->stop(error.what());
    }
  }

  /// Without somebody at the other end there is no flight.
  void read() {
    std::string line;
    while (std::getline(std::cin, line)) {
      const json message = parse_own_json(line, "the service's message");
      const std::lock_guard lock(mutex_);
      if (const auto given = message.find("commands"); given != message.end()) {
        merge(commands_from_json(*given, flown_), ids_, wishes_);
        commanded_ = Clock::now();
      }
      viewers_ = message.value("viewers", viewers_);
      should_stop_ |= message.value("stop", false);
      changed_.notify_all();
    }
    std::_Exit(jobs::worker_environment_error);
  }

  /// A step whenever its time has come.
  void fly() {
    {
      const std::lock_guard lock(mutex_);
      clock_.rest();
    }
    while (flight_.time_s() + flight_.dt_s() <= kMaxFlightS) {
      std::unique_lock lock(mutex_);
      if (!runs() && !should_stop_) {
        output_.send(MessageType::state, state_bytes(*moment_, 0, true));
        changed_.wait(lock, [this] { return runs() || should_stop_ || failure_; });
        clock_.rest();
      }
      if (should_stop_ || failure_) return;
      changed_.wait_until(lock, clock_.next(), [this] { return !runs() || failure_; });
      if (!runs() || failure_) continue;
      const Wishes wishes = in_force();
      const double reached_factor = clock_.reached_factor(flight_.dt_s()).value_or(wishes.factor);
      lock.unlock();

      std::shared_ptr<const Moment> moment = flight_.step(wishes.commands, wishes.sequence);
      const std::vector<json> events = flight_.take_events();
      for (const json& event : events) output_.send(MessageType::event, event.dump());
      if (topics_) topics_->add(*moment, wishes.commands, events);
      output_.send(MessageType::state, state_bytes(*moment, reached_factor, false));

      lock.lock();
      moment_ = std::move(moment);
      clock_.done(flight_.dt_s(), wishes.factor);
      lock.unlock();
      changed_.notify_all();
    }
  }

  /// Whether time goes on. With the mutex held.
  bool runs() const { return viewers_ > 0 && !wishes_.paused && !should_stop_; }

  /// Drones whose pilot is gone stop.
  Wishes in_force() const {
    constexpr std::chrono::milliseconds kSilence(1000);
    Wishes wishes = wishes_;
    if (Clock::now() - commanded_ > kSilence) {
      for (sim::RemoteCommand& command : wishes.commands) stop_moving(command);
    }
    return wishes;
  }

  /// Images, as fast as they can be made.
  void show(const std::stop_token& stop) {
    constexpr std::chrono::milliseconds kMinPause(33);
    constexpr std::chrono::milliseconds kStill(500);  // between images of a world that rests
    try {
      OnboardCamera camera(job_, scenario_, population_, flight_.header(), flight_.drones());
      double shown_s = -1;
      std::size_t shown_view = 0;
      auto last = Clock::now() - kStill;
      while (!stop.stop_requested()) {
        std::unique_lock lock(mutex_);
        changed_.wait_until(lock, last + kMinPause, [&] { return stop.stop_requested(); });
        if (stop.stop_requested()) return;
        const std::shared_ptr<const Moment> moment = moment_;
        const double time_s = clock_.shown_time_s(moment->time_s, moment->dt_s);
        const std::size_t view = wishes_.view;
        const bool is_seen = viewers_ > 0;
        lock.unlock();
        const auto now = Clock::now();
        const bool is_new = time_s != shown_s || view != shown_view || now - last >= kStill;
        if (!is_seen || !is_new) {
          std::this_thread::sleep_for(std::chrono::milliseconds(5));
          continue;
        }
        last = now;
        const std::string jpeg = camera.image(*moment, view, time_s);
        output_.send(MessageType::image, image_bytes(*moment, time_s, view, jpeg));
        if (topics_ && (time_s != shown_s || view != shown_view)) {
          topics_->add_image(*moment, view, time_s, jpeg);
        }
        shown_s = time_s;
        shown_view = view;
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      changed_.notify_all();
    }
  }

  const world::Scenario& scenario_;
  const jobs::JobSpec& job_;
  Output& output_;
  std::function<void()> give_up_;
  skinning::Population population_;
  Flight flight_;  ///< of the thread that flies, but for what never changes
  std::vector<FlownDrone> flown_;
  std::vector<std::string> ids_;
  std::optional<FlightRecording> recording_;
  std::optional<FlightTopics> topics_;  ///< of the thread that flies, but for images
  std::mutex mutex_;                    ///< of all below
  std::condition_variable changed_;
  Wishes wishes_;
  int viewers_ = 0;
  bool should_stop_ = false;
  Clock::time_point commanded_;
  std::shared_ptr<const Moment> moment_;
  StepClock clock_;
  std::exception_ptr failure_;
};

// A flight without its service would be one that nobody can end.
void die_with_service() {
  const char* service = std::getenv(jobs::kSupervisorVariable);
  if (service == nullptr) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (std::to_string(::getppid()) != service) std::_Exit(jobs::worker_environment_error);
}

void confine(const fs::path& folder) {
  jobs::FileFence fence = jobs::fence_of_folder(folder);
  if (const fs::path cache = jobs::shader_cache_folder(); !cache.empty()) {
    std::error_code error;
    fs::create_directories(cache, error);
    fence.writable.push_back(cache);
  }
  for (const std::string& unlimited :
       {jobs::limit_this_process(), jobs::fence_this_process(fence)}) {
    if (!unlimited.empty()) {
      fmt::print(stderr, "warning: the kernel lets nobody limit {}\n", unlimited);
    }
  }
}

[[noreturn]] void fail(Output& output, jobs::WorkerExit code, const char* kind,
                       const std::string& message, const std::vector<Problem>& problems = {}) {
  fmt::print(stderr, "{}\n", message);
  output.send(MessageType::failure,
              json({{"kind", kind}, {"message", message}, {"problems", problems}})
                  .dump(-1, ' ', false, json::error_handler_t::replace));
  std::_Exit(code);
}

}  // namespace

int run_session(const fs::path& folder, const std::optional<RecordingOptions>& record) {
  die_with_service();
  const fs::path scenarios = world::scenarios_folder();
  confine(folder);
  render::tune_allocator();
  Output output;
  const auto give_up = [&] {
    const auto named = [&](const std::string& text) {
      return without_folders(text, {folder, scenarios});
    };
    try {
      throw;
    } catch (const InputError& error) {
      fail(output, jobs::worker_input_error, "input", named(error.what()), error.problems());
    } catch (const std::bad_alloc&) {
      fail(output, jobs::worker_out_of_memory, "environment", "out of memory");
    } catch (const std::exception& error) {
      fail(output, jobs::worker_environment_error, "environment", named(error.what()));
    }
  };
  try {
    const jobs::ResolvedJob job =
        jobs::read_resolved_job(read_file(folder / "job.json"), (folder / "job.json").string());
    const world::Scenario scenario = jobs::load_job_scenario(job.spec(), scenarios);
    Session(job.spec(), scenario, folder, record, output, give_up).run();
  } catch (...) {
    give_up();
  }
  return jobs::worker_bug;
}

}  // namespace throng::live
