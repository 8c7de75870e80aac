#include "annotate/semantic.h"

#include <gtest/gtest.h>

#include <utility>

namespace throng::annotate {
namespace {

TEST(Semantic, EveryIdHasItsClass) {
  using C = SemanticClass;
  const std::pair<std::uint32_t, C> cases[] = {
      {0, C::sky},
      {render::id_of_agent(0), C::person},
      {render::id_of_agent(99'999), C::person},
      {render::id_of_umbrella(0), C::umbrella},
      {render::id_of_umbrella(99'999), C::umbrella},
      {render::kIdBuilding, C::building},
      {render::kIdBuilding + 5000, C::building},
      {render::kIdProp, C::prop},
      {render::kIdProp + 70'000, C::prop},
      {render::kIdDrone, C::drone},
      {render::kIdDrone + 15, C::drone},
      {render::kIdGround, C::ground},
  };
  for (const auto& [id, expected] : cases) EXPECT_EQ(semantic_class(id), expected) << id;
}

}  // namespace
}  // namespace throng::annotate
