// Linear albedos of what buildings are made of.
#pragma once

#include <Eigen/Core>

namespace throng::render::building_paints {

inline const Eigen::Vector3d kZinc(0.27, 0.28, 0.29);
inline const Eigen::Vector3d kIron(0.035, 0.036, 0.038);
inline const Eigen::Vector3d kMachine(0.42, 0.425, 0.42);
inline const Eigen::Vector3d kDark(0.045, 0.047, 0.05);
inline const Eigen::Vector3d kPane(0.03, 0.035, 0.04);
inline const Eigen::Vector3d kSolar(0.012, 0.016, 0.034);
inline const Eigen::Vector3d kBrick(0.27, 0.14, 0.095);
inline const Eigen::Vector3d kStone(0.50, 0.48, 0.44);

}  // namespace throng::render::building_paints
