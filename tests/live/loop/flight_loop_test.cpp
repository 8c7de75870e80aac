// The loop of a flight of two drones that somebody else simulates and draws.
#include "live/loop/flight_loop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/live/loop/moments.h"

namespace throng::live {
namespace {

/// A flight whose steps are as many as they were asked for.
struct Flown {
  int steps = 0;
  std::vector<PilotInput> input;  ///< of each step

  std::shared_ptr<const Moment> step(const PilotInput& given) {
    input.push_back(given);
    return moment(++steps);
  }
};

FlightParts make_parts(Flown& flown) {
  FlightParts parts;
  parts.step = [&flown](const PilotInput& input) { return flown.step(input); };
  return parts;
}

/// Images as they arrive, for a thread that waits for them.
class Album {
 public:
  void add(const FlightImage& image) {
    const std::lock_guard lock(mutex_);
    images_.push_back(image);
    added_.notify_all();
  }
  FlightImage next() {
    std::unique_lock lock(mutex_);
    added_.wait(lock, [this] { return !images_.empty(); });
    FlightImage image = images_.front();
    images_.pop_front();
    return image;
  }

 private:
  std::mutex mutex_;
  std::condition_variable added_;
  std::deque<FlightImage> images_;
};

/// Images of the drone that is viewed, each with its name and time for a JPEG file.
FlightImages images_into(Album& album, const Control& control) {
  FlightImages images;
  images.begin = [] {
    return [](const Moment& /*moment*/, std::size_t drone, double time_s) {
      return std::to_string(drone) + "@" + std::to_string(time_s);
    };
  };
  images.is_wanted = [&control](std::size_t drone) { return control.input().view == drone; };
  images.take = [&album](const FlightImage& image) { album.add(image); };
  return images;
}

TEST(FlightLoop, FliesToItsEndAndADroneStopsASecondAfterItsPilot) {
  Control control({"d1", "d2"}, {.factor = 0, .max_s = 2});
  control.begin(moment(0));
  control.command(read(R"({"sequence": 7, "drones": [{"id": "d1", "velocity_mps": [3, 0, 0]}]})"));
  Flown flown;
  FlightParts parts = make_parts(flown);
  parts.step = [&](const PilotInput& input) {
    // The other drone's pilot goes on, every half second.
    if (flown.steps % 5 == 0) {
      control.command(read(R"({"drones": [{"id": "d2", "yaw_rate_deg_s": 20}]})"));
    }
    return flown.step(input);
  };
  EXPECT_FALSE(fly(control, parts));
  ASSERT_EQ(flown.steps, 20);
  for (std::size_t i = 0; i < flown.input.size(); ++i) {
    const std::vector<sim::RemoteCommand>& commands = flown.input[i].commands;
    EXPECT_EQ(commands[0].velocity_mps.x(), i < 10 ? 3 : 0) << i;
    EXPECT_EQ(commands[1].yaw_rate_deg_s, i > 0 ? 20 : 0) << i;
    EXPECT_EQ(flown.input[i].sequence, 7U);
  }
}

TEST(FlightLoop, TimeStandsStillWhileNobodyLooksOn) {
  Control control({"d1"}, {.factor = 0, .is_watched = false});
  control.begin(moment(0));
  Flown flown;
  std::vector<int> rests;  // the steps before them
  FlightParts parts = make_parts(flown);
  parts.step = [&](const PilotInput& input) {
    if (flown.steps == 4) control.watch(false);
    return flown.step(input);
  };
  parts.rest = [&] {
    rests.push_back(flown.steps);
    if (rests.size() == 1) control.watch(true);
    if (rests.size() == 2) control.command(read(R"({"paused": true})"));
    if (rests.size() == 2) control.step(2, [](const std::string&, double) {});
    if (rests.size() == 3) control.end();
  };
  EXPECT_FALSE(fly(control, parts));
  EXPECT_EQ(rests, (std::vector<int>{0, 5, 7})) << "at its beginning, unseen, and after two steps";
}

TEST(FlightLoop, AResetDuringAStepWaitsForItsEnd) {
  Control control({"d1"}, {.factor = 0});
  control.begin(moment(0));
  Flown flown;
  std::promise<void> begun;
  std::promise<void> asked;
  std::string order;
  FlightParts parts = make_parts(flown);
  parts.step = [&](const PilotInput& input) {
    begun.set_value();
    asked.get_future().wait();
    order += "step ";
    return flown.step(input);
  };
  parts.reset = [&] {
    const Control::Reset reset = control.take_reset();
    order += "reset " + std::to_string(reset.seed.value());
    reset.answer("", 0);
    return true;
  };
  std::string answered = "no";
  std::future<bool> is_reset = std::async(std::launch::async, [&] { return fly(control, parts); });
  begun.get_future().wait();
  control.reset(7, [&](const std::string& problem, double) { answered = "yes" + problem; });
  asked.set_value();
  EXPECT_TRUE(is_reset.get());
  EXPECT_EQ(order, "step reset 7");
  EXPECT_EQ(answered, "yes");
}

TEST(FlightLoop, GoesOnAfterAResetThatCannotBe) {
  Control control({"d1"}, {.factor = 0, .max_s = 1});
  control.begin(moment(0));
  control.reset({}, nullptr);
  Flown flown;
  FlightParts parts = make_parts(flown);
  parts.reset = [&] {
    control.take_reset();
    return false;
  };
  EXPECT_FALSE(fly(control, parts));
  EXPECT_EQ(flown.steps, 10);
}

TEST(FlightLoop, ThrowsTheProblemsOfOthers) {
  Control control({"d1"}, {.paused = true});
  control.begin(moment(0));
  Flown flown;
  FlightParts parts = make_parts(flown);
  std::thread other;
  parts.rest = [&] {
    other = std::thread(
        [&] { control.fail(std::make_exception_ptr(std::runtime_error("no more input"))); });
  };
  EXPECT_THROW(fly(control, parts), std::runtime_error);
  other.join();
  EXPECT_EQ(flown.steps, 0);
}

TEST(FlightLoop, ImagesShowWhatIsViewedAndAreRepeatedForThoseWhoCome) {
  Control control({"d1", "d2"}, {.paused = true});
  control.begin(moment(3));
  Flown flown{.steps = 3, .input = {}};
  FlightParts parts = make_parts(flown);
  Album album;
  parts.images = images_into(album, control);
  std::thread flight([&] { fly(control, parts); });
  const FlightImage first = album.next();
  EXPECT_EQ(first.jpeg, "0@" + std::to_string(0.3));
  EXPECT_EQ(first.moment->time_s, first.time_s);
  EXPECT_TRUE(first.is_new);
  const FlightImage again = album.next();
  EXPECT_EQ(again.jpeg, first.jpeg);
  EXPECT_FALSE(again.is_new);
  control.command(read(R"({"view": "d2"})"));
  FlightImage other = album.next();
  while (other.drone == 0) other = album.next();
  EXPECT_EQ(other.jpeg, "1@" + std::to_string(0.3));
  EXPECT_TRUE(other.is_new);
  control.step(1, [](const std::string&, double) {});
  FlightImage later = album.next();
  while (!later.is_new) later = album.next();
  EXPECT_EQ(later.jpeg, "1@" + std::to_string(0.4));
  control.end();
  flight.join();
}

TEST(FlightLoop, AProblemOfImagesEndsTheFlightUnlessItIsTaken) {
  Control control({"d1"}, {.paused = true});
  control.begin(moment(0));
  Flown flown;
  FlightParts parts = make_parts(flown);
  Album album;
  parts.images = images_into(album, control);
  parts.images->begin = []() -> DrawImage { throw std::runtime_error("no driver"); };
  EXPECT_THROW(fly(control, parts), std::runtime_error);

  Control other({"d1"}, {.paused = true, .max_s = 1});
  other.begin(moment(0));
  parts.images = images_into(album, other);
  parts.images->begin = []() -> DrawImage { throw std::runtime_error("no driver"); };
  parts.images->fail = [&](const std::string& problem) {
    EXPECT_EQ(problem, "no driver");
    other.command(read(R"({"paused": false, "factor": 10})"));
  };
  EXPECT_FALSE(fly(other, parts));
  EXPECT_EQ(flown.steps, 10) << "it goes on without images";
}

TEST(FlightLoop, ManyMayAskAtOnce) {
  Control control({"d1", "d2"}, {.factor = 0, .paused = true, .max_s = 100});
  control.begin(moment(0));
  Flown flown;
  FlightParts parts = make_parts(flown);
  Album album;
  parts.images = images_into(album, control);
  std::atomic<int> answers = 0;
  std::vector<std::thread> clients;
  for (int client = 0; client < 4; ++client) {
    clients.emplace_back([&] {
      for (int i = 0; i < 50; ++i) {
        control.command(read(R"({"drones": [{"id": "d2", "velocity_mps": [1, 0, 0]}]})"));
        control.step(1, [&](const std::string&, double) { ++answers; });
        control.watch(control.is_watched());
        control.shown();
        control.reached_factor();
      }
    });
  }
  std::thread flight([&] { fly(control, parts); });
  for (std::thread& client : clients) client.join();
  control.command(read(R"({"paused": false})"));
  flight.join();
  EXPECT_EQ(answers, 200);
  EXPECT_EQ(flown.steps, 1000);
}

}  // namespace
}  // namespace throng::live
