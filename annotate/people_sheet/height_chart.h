// Chart of the heights of a population's adults and of the distribution from which people are
// sampled.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "skinning/population.h"

namespace throng::annotate {

/// Draws the chart into an RGB image. Bars show the barefoot heights of people sampled with this
/// seed, curves the normal distributions corrected for age (skinning/wardrobe/person.h), and ticks
/// below the axis the population's adults with their shoes. Women and men have different colors.
void draw_height_chart(cv::Mat image, const skinning::Population& population, std::uint64_t seed);

}  // namespace throng::annotate
