// Messages with the state of a live flight; docs/studio.md describes their bytes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "live/flight/flight.h"
#include "world/scenario.h"

namespace throng::live {

/// The first message: scenario, people, drones and image size. `smoke` is its amount, 0 to 1.
nlohmann::json make_hello(const Flight& flight, const world::Scenario& scenario, double smoke);

/// The message with the positions of all people and drones at the end of the moment's step.
/// `reached_factor` is the simulated time per real time.
std::string state_bytes(const Moment& moment, double reached_factor, bool paused);

/// The message with a drone's image at a time within the moment's step.
std::string image_bytes(const Moment& moment, double time_s, std::size_t drone,
                        const std::string& jpeg);

}  // namespace throng::live
