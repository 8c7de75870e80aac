// Messages about the world of a live flight; docs/studio.md describes their bytes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "jobs/live/flight.h"
#include "world/scenario.h"

namespace throng::live {

/// Place, people, drones and image: the first message. `smoke`: how much of it rises, 0 to 1.
nlohmann::json make_hello(const Flight& flight, const world::Scenario& scenario, double smoke);

/// Everybody's places at the end of the moment's step.
std::string state_bytes(const Moment& moment, double reached_factor, bool paused);

/// A image of a drone at a time of the moment's step.
std::string image_bytes(const Moment& moment, double time_s, std::size_t drone,
                        const std::string& jpeg);

}  // namespace throng::live
