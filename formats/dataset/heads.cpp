#include "formats/dataset/heads.h"

#include <fmt/format.h>

#include "base/error.h"

namespace throng::formats {

bool is_in_image(const Image& image, const Eigen::Vector2d& place) {
  return place.x() >= 0 && place.y() >= 0 && place.x() < image.width && place.y() < image.height;
}

std::vector<Head> heads_with_boxes(const Image& image) {
  std::vector<Head> heads;
  for (const Person& person : image.people) {
    if (person.is_ignored || !person.head) continue;
    const Eigen::Vector2d& at = *person.head;
    if (!is_in_image(image, at)) continue;
    if (!person.head_box) {
      // A camera inside a head may see the head's middle and nothing of its surface.
      if (person.record.contains("head_box")) continue;
      throw InputError({image.file, fmt::format("annotation {}", person.id), "no head_box",
                        "a box of each head that is in the image"});
    }
    heads.push_back(
        {&person, at, *person.head_box, person.head_visibility.value_or(person.visibility)});
  }
  return heads;
}

}  // namespace throng::formats
