#include "live/loop/flight_loop.h"

#include <chrono>
#include <exception>
#include <stop_token>
#include <thread>
#include <vector>

namespace throng::live {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kMinPause(33);
constexpr std::chrono::milliseconds kStill(500);  // between images of a world that rests
constexpr std::chrono::milliseconds kNap(5);

/// The last image of a drone.
struct Last {
  double time_s = -1;
  Clock::time_point drawn;
};

void show(const Control& control, const FlightImages& images, const std::stop_token& stop) {
  DrawImage draw;
  std::vector<Last> last(control.drones().size());
  std::size_t next = 0;
  while (!stop.stop_requested()) {
    bool has_drawn = false;
    const auto begun = Clock::now();
    for (std::size_t i = 0; i < last.size() && !has_drawn; ++i) {
      const std::size_t drone = (next + i) % last.size();
      if (!images.is_wanted(drone)) {
        last[drone] = {};  // those who want it again get it at once
        continue;
      }
      const auto [moment, time_s] = control.shown();
      const bool is_new = time_s != last[drone].time_s;
      if (!is_new && begun - last[drone].drawn < kStill) continue;
      if (!draw) draw = images.begin();
      images.take({moment, drone, time_s, draw(*moment, drone, time_s), is_new});
      last[drone] = {time_s, begun};
      next = drone + 1;
      has_drawn = true;
    }
    std::this_thread::sleep_until(begun + (has_drawn ? kMinPause : kNap));
  }
}

/// The thread of the images; none without them.
std::jthread begin_images(Control& control, const std::optional<FlightImages>& images) {
  if (!images) return {};
  return std::jthread([&control, &images = *images](const std::stop_token& stop) {
    try {
      show(control, images, stop);
    } catch (const std::exception& error) {
      images.fail ? images.fail(error.what()) : control.fail(std::current_exception());
    }
  });
}

}  // namespace

bool fly(Control& control, const FlightParts& parts) {
  const std::jthread images = begin_images(control, parts.images);
  while (true) {
    const Turn turn = control.wait_for_turn();
    if (turn == Turn::end) return false;
    if (turn == Turn::rest) parts.rest();
    if (turn == Turn::reset && parts.reset()) return true;
    if (turn == Turn::step) control.done(parts.step(control.in_force()));
  }
}

}  // namespace throng::live
