// Doors that let no more people pass than their capacity, whatever the pedestrian model
// does.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/state/crowd.h"

namespace throng::crowd {

/// The doors of a crowd. Each has a token bucket: at most 1 + rate * (t + dt) people are admitted
/// in any time t. People who come nearer to a closed door than their radius brake before it;
/// an admitted person keeps the ticket until they have passed, or for some seconds if they
/// turn away.
class MeteredDoors {
 public:
  MeteredDoors(std::vector<MeteredDoor> doors, std::size_t agent_count);

  /// Must be called before agents move: admits people, and slows down the others.
  void hold(const Crowd& crowd, std::span<Eigen::Vector2f> new_velocity);
  /// Must be called after they have moved: puts those back who were pushed through.
  void put_back(Crowd& crowd);

 private:
  /// Somebody before a door.
  struct Approach {
    std::size_t agent = 0;
    std::size_t door = 0;
    Eigen::Vector2f position;  ///< before the step
    Eigen::Vector2f way;       ///< unit vector through the door
    float distance_m = 0;
  };
  struct Ticket {
    std::int32_t door = -1;
    float left_s = 0;
  };

  void find_near(const Crowd& crowd);
  void expire(float dt_s);
  void hold(const Crowd& crowd, const Approach& near, std::span<Eigen::Vector2f> new_velocity);

  std::vector<MeteredDoor> doors_;
  std::vector<float> tokens_;    // by door
  std::vector<Ticket> tickets_;  // by agent
  std::vector<Approach> near_;   // by door, the nearest first
};

}  // namespace throng::crowd
