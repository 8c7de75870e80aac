#include "server/live/live_flight.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <utility>

namespace throng::server {

using namespace std::chrono_literals;

namespace {

constexpr auto kSignOfLife = 1s;        // to viewers, of a world that rests
constexpr auto kOutcomePatience = 20s;  // for the outcome of a flight that ends

}  // namespace

LiveFlight::LiveFlight(LiveFlightSpec spec)
    : spec_(std::move(spec)),
      audience_{0, spec_.now()},
      process_(spec_, [this](const live::Message& message) { take(message); }) {}

LiveProgress LiveFlight::progress() const {
  const std::lock_guard lock(mutex_);
  return messages_.progress();
}

LiveAudience LiveFlight::audience() const {
  const std::lock_guard lock(mutex_);
  return audience_;
}

void LiveFlight::take(const live::Message& message) {
  const std::lock_guard lock(mutex_);
  if (messages_.has_ended()) return;
  messages_.add(message);
  if (messages_.has_ended()) audience_.last_seen = spec_.now();
  changed_.notify_all();
}

bool LiveFlight::command(const live::Commands& commands) {
  const std::lock_guard lock(mutex_);
  if (messages_.has_ended()) return false;
  // A drone at a time: lines stay short.
  live::Commands line = commands;
  line.drones.clear();
  for (const live::DroneCommand& drone : commands.drones) {
    live::Commands one;
    one.drones = {drone};
    process_.send({{"commands", to_json(one)}});
  }
  process_.send({{"commands", to_json(line)}});
  return true;
}

bool LiveFlight::stop() {
  std::unique_lock lock(mutex_);
  if (!messages_.has_ended()) process_.send({{"stop", true}});
  return changed_.wait_for(lock, kOutcomePatience, [this] { return messages_.has_ended(); });
}

void LiveFlight::end() {
  take(failure_message("removed", "the flight was removed"));
  process_.end();
}

LiveFlight::Viewer::Viewer(std::shared_ptr<LiveFlight> flight) : flight_(std::move(flight)) {
  count(1);
}

LiveFlight::Viewer::~Viewer() { count(-1); }

void LiveFlight::Viewer::count(int change) {
  LiveFlight& flight = *flight_;
  const std::lock_guard lock(flight.mutex_);
  flight.audience_.viewers += change;
  flight.audience_.last_seen = flight.spec_.now();
  if (!flight.messages_.has_ended()) {
    flight.process_.send({{"viewers", flight.audience_.viewers}});
  }
}

std::string LiveFlight::Viewer::next() {
  LiveFlight& flight = *flight_;
  const KeptMessages& messages = flight.messages_;
  std::unique_lock lock(flight.mutex_);
  if (messages.has_ended() && seen_ == messages.newest()) return "";
  if (!flight.changed_.wait_for(lock, kSignOfLife, [&] { return messages.newest() > seen_; })) {
    return live::framed({live::MessageType::alive, ""});
  }
  return messages.after(std::exchange(seen_, messages.newest()));
}

}  // namespace throng::server
