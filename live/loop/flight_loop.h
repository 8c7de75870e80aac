// The loop of every live flight, from the service's page or from outside: steps when their time has
// come, and images beside them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "live/loop/control.h"
#include "live/loop/moment.h"
#include "live/loop/pilot_input.h"

namespace throng::live {

/// Draws what a drone's camera sees at a time within the moment's step: a JPEG file.
using DrawImage =
    std::function<std::string(const Moment& moment, std::size_t drone, double time_s)>;

/// An image of a drone's camera.
struct FlightImage {
  std::shared_ptr<const Moment> moment;
  std::size_t drone = 0;
  double time_s = 0;  ///< within the moment's step
  std::string jpeg;
  bool is_new = true;  ///< false: it shows the same time as the drone's last one
};

/// Source and receivers of images. All are called on a thread of their own.
struct FlightImages {
  /// Begins to draw, when an image is first wanted.
  std::function<DrawImage()> begin;
  /// Whether images of a drone's camera are wanted.
  std::function<bool(std::size_t drone)> is_wanted;
  std::function<void(const FlightImage&)> take;
  /// There will be no images. None: the flight ends with the exception.
  std::function<void(const std::string& problem)> fail = nullptr;
};

/// The flight that a loop flies. All but the images are called on the loop's thread.
struct FlightParts {
  /// Simulates a step with this input and returns the moment at its end.
  std::function<std::shared_ptr<const Moment>(const PilotInput& input)> step;
  /// Time has begun to stand still.
  std::function<void()> rest = [] {};
  /// Begins the flight that Control::take_reset() asks for. False: it cannot, and this one goes on.
  std::function<bool()> reset = [] { return false; };
  std::optional<FlightImages> images = std::nullopt;
};

/// Flies until the control ends the flight or a reset has begun another one, which it returns.
/// Meanwhile draws the cameras that are wanted in turn, at most 30 images a second; where time
/// stands still again now and then, for those who come later. Throws the exceptions of the parts
/// and that of Control::fail().
bool fly(Control& control, const FlightParts& parts);

}  // namespace throng::live
