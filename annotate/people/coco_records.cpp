#include "annotate/people/coco_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "annotate/people/decimals.h"
#include "annotate/people/person_record.h"
#include "annotate/people/run_lengths.h"
#include "base/error.h"

namespace throng::annotate {

namespace {

template <typename... Values>
void append(std::string& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

// JSON has no NaN or infinity, and none of our values may be one.
double finite(double value) {
  check(std::isfinite(value), "every number in a dataset is finite");
  return value;
}

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

// Shortest digits that read back as the same number.
template <typename Vector>
void append_exact(std::string& text, const Vector& values) {
  text.push_back('[');
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    append(text, "{}{}", i > 0 ? "," : "", finite(values[i]));
  }
  text.push_back(']');
}

void append_exact(std::string& text, const Eigen::Matrix3d& matrix) {
  text.push_back('[');
  for (Eigen::Index row = 0; row < 3; ++row) {
    if (row > 0) text.push_back(',');
    append_exact(text, Eigen::Vector3d(matrix.row(row)));
  }
  text.push_back(']');
}

// x, y, width and height.
void append_box(std::string& text, const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d size = box.sizes();
  append_decimals(text, Eigen::Vector4d(box.min().x(), box.min().y(), size.x(), size.y()),
                  kPixelDecimals);
}

// The middle of the head in box coordinates; null when the camera cannot see it.
void append_head(std::string& text, const render::PersonInView& person,
                 const camera::Camera& camera) {
  if (const std::optional<Eigen::Vector2d> head = render::head_in(person, camera)) {
    text += R"("head":)";
    append_decimals(text, *head, kPixelDecimals);
  } else {
    text += R"("head":null)";
  }
}

// The lens's model and its coefficients, by their names in OpenCV.
void append_lens(std::string& text, const std::optional<camera::Distortion>& distortion) {
  using Model = camera::Distortion::Model;
  constexpr std::array kBrown{"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"};
  constexpr std::array kFisheye{"k1", "k2", "k3", "k4"};
  if (!distortion) {
    text += R"(,"model":"pinhole")";
    return;
  }
  const bool fisheye = distortion->model() == Model::fisheye;
  text += fisheye ? R"(,"model":"fisheye","distortion":{)"
                  : R"(,"model":"brown_conrady","distortion":{)";
  const std::span<const char* const> names =
      fisheye ? std::span<const char* const>(kFisheye) : std::span<const char* const>(kBrown);
  for (std::size_t i = 0; i < names.size(); ++i) {
    append(text, R"({}"{}":{})", i > 0 ? "," : "", names[i],
           finite(distortion->coefficients().at(i)));
  }
  text.push_back('}');
}

// How many there are, and where those are of whom nothing is visible.
void append_people(std::string& text, const CocoImage& image, const FrameLabels& labels) {
  const auto truncated =
      std::count_if(labels.people.begin(), labels.people.end(), [&](const PersonLabel& label) {
        return recorded_truncation(label.person.amodal_box, image.camera.intrinsics) > 0;
      });
  append(text, R"(,"counts":{{"all":{},"visible":{},"truncated":{})",
         labels.people.size() + labels.hidden.size(), labels.people.size(), truncated);
  const auto drones =
      std::count_if(labels.objects.begin(), labels.objects.end(),
                    [](const ObjectLabel& label) { return render::is_drone(label.object.id); });
  const auto objects = static_cast<std::ptrdiff_t>(labels.objects.size());
  if (drones > 0) append(text, R"(,"drones":{})", drones);
  if (objects > drones) append(text, R"(,"vehicles":{})", objects - drones);
  text.push_back('}');
  if (labels.hidden.empty()) return;
  text += R"(,"hidden":[)";
  for (const HiddenPerson& person : labels.hidden) {
    if (text.back() != '[') text.push_back(',');
    append(text, R"({{"track_id":{},"bbox_amodal":)", track_id(image, person.agent));
    append_box(text, person.amodal_box);
    text.push_back('}');
  }
  text.push_back(']');
}

const ObjectCategory& object_category(world::SemanticClass surface) {
  const auto* found =
      std::find_if(kObjectCategories.begin(), kObjectCategories.end(),
                   [&](const ObjectCategory& category) { return category.surface == surface; });
  check(found != kObjectCategories.end(), "every object that is measured has a category");
  return *found;
}

// The characters of RLE strings run from '0' to 'o'; the backslash is among them.
void append_counts(std::string& text, const RunLengths& mask) {
  for (const char c : coco_counts(mask)) {
    if (c == '\\') text.push_back('\\');
    text.push_back(c);
  }
}

/// The visible part of a person, drone or vehicle in the image.
struct Shown {
  int category;
  std::uint32_t number;  ///< agent, or object_number()
  const PixelBox* box;
  const RunLengths* mask;
  std::uint64_t area_px;
};

// From the record's beginning to the end of its visible mask.
void append_shown(std::string& text, const CocoImage& image, const Shown& shown) {
  const PixelBox& box = *shown.box;
  append(text, R"({{"id":{},"image_id":{},"category_id":{},)",
         image.id * kMaxAgentsPerRun + shown.number + 1, image.id, shown.category);
  append(text, R"("bbox":[{}.0,{}.0,{}.0,{}.0],"area":{},"iscrowd":0,)", box.x, box.y, box.width,
         box.height, shown.area_px);
  append(text, R"("segmentation":{{"size":[{},{}],"counts":")", image.camera.intrinsics.height,
         image.camera.intrinsics.width);
  append_counts(text, *shown.mask);
  text += R"("})";
}

void append_whole_mask(std::string& text, const CocoImage& image, const render::PixelMask& mask) {
  const camera::Intrinsics& k = image.camera.intrinsics;
  append(text, R"(,"amodal_segmentation":{{"size":[{},{}],"counts":")", k.height, k.width);
  append_counts(text, run_lengths(mask, k.width, k.height));
  text += R"("})";
}

// From the track to the name of the position.
void append_whole(std::string& text, const CocoImage& image, std::uint32_t number,
                  const Eigen::AlignedBox2d& box, std::uint64_t area_px, double visibility) {
  append(text, R"(,"track_id":{},"bbox_amodal":)", track_id(image, number));
  append_box(text, box);
  append(text, R"(,"area_amodal":{},"visibility":{:.3g},"position":)", area_px, finite(visibility));
}

}  // namespace

std::int64_t track_id(const CocoImage& image, std::uint32_t agent) {
  return track_id(image.run_index, agent);
}

void append_track_record(std::string& text, const CocoImage& image, std::uint32_t agent) {
  append(text, R"({{"id":{},"run":{})", track_id(image, agent), quoted(image.run));
  if (image.facts != nullptr) image.facts->append_track(text, agent);
  text += "}\n";
}

void append_image_record(std::string& text, const CocoImage& image, const FrameLabels& labels) {
  append(
      text,
      R"({{"id":{},"file_name":{},"license":1,"width":{},"height":{},"run":{},"camera_id":{},"frame":{},)",
      image.id, quoted(image.file_name), image.camera.intrinsics.width,
      image.camera.intrinsics.height, quoted(image.run), quoted(image.camera_id),
      image.frame_index);
  append(text, R"("time_s":{},"camera":{{"K":)", rounded(image.time_s, kTimeDecimals));
  append_exact(text, image.camera.intrinsics.matrix());
  text += R"(,"R":)";
  append_exact(text, image.camera.pose.R);
  text += R"(,"t":)";
  append_exact(text, image.camera.pose.t);
  text += R"(,"centre":)";
  append_exact(text, image.camera.pose.center());
  append_lens(text, image.camera.intrinsics.distortion);
  text.push_back('}');
  if (!image.sensor.empty()) text += R"(,"sensor":)" + image.sensor;
  if (!image.flight.empty()) text += R"(,"flight":)" + image.flight;
  if (!image.environment.empty()) text += R"(,"environment":)" + image.environment;
  if (!image.drawn.empty()) text += R"(,"drawn":)" + image.drawn;
  if (!image.density_file.empty()) {
    append(text, R"(,"density_file":{},"density_count":{})", quoted(image.density_file),
           image.density_count);
  }
  append_people(text, image, labels);
  if (!image.exits.empty()) text += R"(,"exits":)" + image.exits;
  if (!image.hazards.empty()) text += R"(,"hazards":)" + image.hazards;
  if (!image.zones.empty()) text += R"(,"zones":)" + image.zones;
  text += "}\n";
}

void append_annotation_record(std::string& text, const CocoImage& image, const PersonLabel& label) {
  check(label.agent < kFirstVehicleNumber, "a run has fewer agents than kFirstVehicleNumber");
  const render::PersonInView& person = label.person;
  append_shown(text, image, {kPersonCategory, label.agent, &label.box, &label.mask, label.area_px});
  if (image.whole_masks) append_whole_mask(text, image, *person.whole_mask);
  append_whole(text, image, label.agent, person.amodal_box, person.amodal_area_px,
               label.visibility);
  append_decimals(text, person.position, kMeterDecimals);
  text += R"(,"velocity":)";
  append_decimals(text, person.velocity, kBodyDecimals);
  text.push_back(',');
  append_head(text, person, image.camera);
  append_person_members(text, image, label);
  text += "}\n";
}

std::uint32_t object_number(const render::ObjectInView& object) {
  const bool is_drone = render::is_drone(object.id);
  check(object.number < (is_drone ? kMaxDronesPerRun : kMaxVehiclesPerRun),
        "a run has at most kMaxDronesPerRun drones and kMaxVehiclesPerRun vehicles");
  return static_cast<std::uint32_t>(is_drone ? kFirstDroneNumber : kFirstVehicleNumber) +
         object.number;
}

void append_object_track_record(std::string& text, const CocoImage& image,
                                const render::ObjectInView& object) {
  append(text, R"({{"id":{},"run":{},)", track_id(image, object_number(object)), quoted(image.run));
  if (render::is_drone(object.id)) {
    check(image.drone_ids != nullptr && object.number < image.drone_ids->size(),
          "drones that are seen are drones of the run");
    append(text, R"("drone":{}}})", quoted((*image.drone_ids)[object.number]));
  } else {
    append(text, R"("vehicle":"{}","prop":{}}})", object_category(object.surface).name,
           object.id - render::kIdProp);
  }
  text.push_back('\n');
}

void append_object_record(std::string& text, const CocoImage& image, const ObjectLabel& label) {
  const render::ObjectInView& object = label.object;
  const std::uint32_t number = object_number(object);
  append_shown(
      text, image,
      {object_category(object.surface).id, number, &label.box, &label.mask, label.area_px});
  if (image.whole_masks) append_whole_mask(text, image, *object.whole_mask);
  append_whole(text, image, number, object.amodal_box, object.amodal_area_px, label.visibility);
  append_decimals(text, object.position, kMeterDecimals);
  text += R"(,"velocity":)";
  append_decimals(text, object.velocity, kBodyDecimals);
  const Eigen::Quaterniond& q = object.orientation;
  text += R"(,"orientation_wxyz":)";
  append_exact(text, Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()));
  append_pose_members(text, image,
                      {object.amodal_box, object.yaw_rad, object.box_middle, object.box_size});
  text += "}\n";
}

}  // namespace throng::annotate
