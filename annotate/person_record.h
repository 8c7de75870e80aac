// The members of a person's COCO record that no COCO reader needs, but many a user: pose, place and
// facts (docs/formats.md).
#pragma once

#include <string>

#include "annotate/coco.h"
#include "annotate/labels.h"

namespace throng::annotate {

/// Share of a box that is outside of the image.
double truncation_of(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k);

/// Appends the members, each after a comma.
void append_person_members(std::string& text, const CocoImage& image, const PersonLabel& label);

}  // namespace throng::annotate
