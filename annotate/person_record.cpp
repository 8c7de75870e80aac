#include "annotate/person_record.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/error.h"

namespace throng::annotate {

namespace {

constexpr int kPlaces = 3;  // a millimetre, or a thousandth of a pixel

/// The number with three decimals, a fraction's last zeros left out. A record has some hundred and
/// twenty of them, so this does without the generality of a formatting library.
void append_thousandths(std::string& text, double value) {
  check(std::isfinite(value) && std::abs(value) < 1e12, "every number in a dataset is finite");
  constexpr std::int64_t kScale = 1000;
  std::int64_t scaled = std::llround(value * static_cast<double>(kScale));
  if (scaled < 0) {
    text.push_back('-');
    scaled = -scaled;
  }
  std::array<char, 24> digits;
  const auto whole = std::to_chars(digits.begin(), digits.end(), scaled / kScale);
  text.append(digits.data(), whole.ptr);
  std::int64_t rest = scaled % kScale;
  if (rest == 0) return;
  std::array<char, kPlaces + 1> fraction = {'.'};
  std::size_t length = 1;
  for (std::int64_t place = kScale / 10; rest > 0; place /= 10) {
    fraction[length++] = static_cast<char>('0' + rest / place);
    rest %= place;
  }
  text.append(fraction.data(), length);
}

void append_vector(std::string& text, const Eigen::Vector3f& vector) {
  for (int i = 0; i < 3; ++i) {
    text.push_back(i == 0 ? '[' : ',');
    append_thousandths(text, static_cast<double>(vector[i]));
  }
  text.push_back(']');
}

}  // namespace

double truncation_of(const Eigen::AlignedBox2d& box, const camera::Intrinsics& k) {
  const Eigen::AlignedBox2d image(Eigen::Vector2d::Zero(), Eigen::Vector2d(k.width, k.height));
  const Eigen::AlignedBox2d inside = box.intersection(image);
  if (box.volume() <= 0) return 0;
  return inside.isEmpty() ? 1 : std::clamp(1 - inside.volume() / box.volume(), 0.0, 1.0);
}

namespace {

void append_keypoints(std::string& text, const PersonLabel& label) {
  text += R"(,"keypoints":[)";
  int labelled = 0;
  for (std::size_t i = 0; i < label.keypoints.size(); ++i) {
    const Keypoint& point = label.keypoints[i];
    if (i > 0) text.push_back(',');
    append_thousandths(text, static_cast<double>(point.x));
    text.push_back(',');
    append_thousandths(text, static_cast<double>(point.y));
    text.push_back(',');
    text.push_back(static_cast<char>('0' + point.visibility));
    if (point.visibility > 0) ++labelled;
  }
  text += R"(],"num_keypoints":)" + std::to_string(labelled) + R"(,"keypoints_3d":[)";
  for (std::size_t i = 0; i < label.keypoints.size(); ++i) {
    if (i > 0) text.push_back(',');
    append_vector(text, label.person.keypoints[i]);
  }
  text.push_back(']');
}

}  // namespace

void append_person_members(std::string& text, const CocoImage& image, const PersonLabel& label) {
  const render::PersonInView& person = label.person;
  text += R"(,"height_px":)";
  append_thousandths(text, person.amodal_box.sizes().y());
  text += R"(,"truncation":)";
  append_thousandths(text, truncation_of(person.amodal_box, image.camera.intrinsics));
  text += R"(,"heading":)";
  append_thousandths(text, person.yaw_rad);
  text += R"(,"box_3d":{"middle":)";
  append_vector(text, person.box_middle);
  text += R"(,"size":)";
  append_vector(text, person.box_size);
  text.push_back('}');
  if (!label.keypoints.empty()) append_keypoints(text, label);
  if (image.facts != nullptr) {
    image.facts->append(text, label.agent, image.time_s, person.velocity.norm());
  }
}

}  // namespace throng::annotate
