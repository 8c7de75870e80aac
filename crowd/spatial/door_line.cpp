#include "crowd/spatial/door_line.h"

namespace throng::crowd {

using Eigen::Vector2f;

bool crosses(const DoorLine& line, const Vector2f& before, const Vector2f& after,
             const LineMargins& margins, const Obstacles& obstacles, std::uint32_t class_mask) {
  constexpr float kInWallM = 0.05F;
  const Vector2f along = (line.to - line.from).normalized();
  const Vector2f across(-along.y(), along.x());
  const float was = across.dot(before - line.from);
  const float is = across.dot(after - line.from);
  if ((was >= 0) == (is >= 0)) return false;
  const Vector2f at = before + was / (was - is) * (after - before);
  const float place = along.dot(at - line.from);
  if (!line.is_beside(place, margins.open)) return true;
  if (line.is_beside(place, margins.walls)) return false;
  return obstacles.is_solid(at + kInWallM * across, class_mask) ||
         obstacles.is_solid(at - kInWallM * across, class_mask);
}

}  // namespace throng::crowd
