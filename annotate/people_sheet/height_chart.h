// How tall the adults of a population are, against the distribution that they are sampled from.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "skinning/population.h"

namespace throng::annotate {

/// Fills an RGB image: bars are the barefoot heights of people sampled with this seed, curves
/// the normal distributions less what age takes (skinning/wardrobe/person.h), ticks below the axis
/// the population's own adults as they stand in their shoes. Women and men in two colors.
void draw_height_chart(cv::Mat image, const skinning::Population& population, std::uint64_t seed);

}  // namespace throng::annotate
