#include "render/lens/lens.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "base/compute/parallel.h"
#include "base/error.h"
#include "render/lens/depth_between.h"
#include "render/truth/objects_in_view.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;

/// Rows that one task of a loop takes.
constexpr std::size_t kRowsOfTask = 16;
/// The camera of some rows of a pinhole's image.
camera::Intrinsics cropped(camera::Intrinsics pinhole, const Rows& rows) {
  pinhole.cy_px -= rows.first;
  pinhole.height = rows.end - rows.first;
  return pinhole;
}

/// The measured pixels of the whole image that are in these rows.
PixelWeights cropped_weights(const camera::Intrinsics& pinhole, const Rows& rows) {
  return {measured_pixels(pinhole, rows).translated(Eigen::Vector2i(0, -rows.first)), {}};
}

std::uint8_t mixed(const std::uint8_t* above, const std::uint8_t* below, int right, float u,
                   float v) {
  const auto value = [](std::uint8_t byte) { return static_cast<float>(byte); };
  const float top = value(above[0]) + u * (value(above[right]) - value(above[0]));
  const float bottom = value(below[0]) + u * (value(below[right]) - value(below[0]));
  return static_cast<std::uint8_t>(std::lrint(top + v * (bottom - top)));
}

/// How far the image moves where the wide image moves by `flow` from one of its pixels; NaN
/// where the lens shows nothing.
Eigen::Vector2f flow_through(const camera::Intrinsics& lens, const camera::Intrinsics& wide,
                             const Vector2d& pixel, const Eigen::Vector2f& flow) {
  const auto seen = [&](const Vector2d& at) { return lens.pixel_of(*wide.direction_of(at)); };
  const auto from = seen(pixel);
  const auto to = seen(pixel + flow.cast<double>());
  if (!from || !to) return Eigen::Vector2f::Constant(std::numeric_limits<float>::quiet_NaN());
  return (*to - *from).cast<float>();
}

/// Buffers of the wide image that are not interpolated.
void copy_nearest(const Frame& wide, std::size_t from, std::size_t to, Frame& image) {
  image.id[to] = wide.id[from];
  if (!image.part.empty()) image.part[to] = wide.part[from];
  if (!image.surface.empty()) image.surface[to] = wide.surface[from];
  if (!image.normal.empty()) std::copy_n(&wide.normal[from * 3], 3, &image.normal[to * 3]);
  if (!image.hazard_opacity.empty()) {
    std::copy_n(&wide.hazard_opacity[from * 3], 3, &image.hazard_opacity[to * 3]);
  }
  if (!image.scene_flow_m.empty()) {
    std::copy_n(&wide.scene_flow_m[from * 3], 3, &image.scene_flow_m[to * 3]);
  }
}

/// Value of a pixel outside the domain of the lens model.
void show_nothing(std::size_t pixel, Frame& image) {
  image.id[pixel] = kIdNothing;
  image.depth_m[pixel] = std::numeric_limits<float>::infinity();
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  for (std::vector<float>* flow : {&image.flow, &image.flow_backward}) {
    if (!flow->empty()) std::fill_n(&(*flow)[2 * pixel], 2, kUnknown);
  }
  if (!image.flow_depth_m.empty()) image.flow_depth_m[pixel] = kUnknown;
  if (!image.scene_flow_m.empty()) std::fill_n(&image.scene_flow_m[3 * pixel], 3, kUnknown);
}

/// Looks pixels [begin, end) of the image up in the wide image.
void look_up(const LensMap& map, const camera::Intrinsics& lens, const Frame& wide,
             std::size_t begin, std::size_t end, Frame& image) {
  constexpr int kChannels = 3;
  const auto width = static_cast<std::size_t>(wide.width());
  for (std::size_t i = begin; i < end; ++i) {
    if (!map.shows(i)) {
      show_nothing(i, image);
      continue;
    }
    const float x = map.position[2 * i];
    const float y = map.position[2 * i + 1];
    const auto column = static_cast<std::size_t>(x);
    const auto row = static_cast<std::size_t>(y);
    const std::uint8_t* above = &wide.rgb[(row * width + column) * kChannels];
    const std::uint8_t* below = above + width * kChannels;
    for (std::size_t c = 0; c < kChannels; ++c) {
      image.rgb[i * kChannels + c] =
          mixed(above + c, below + c, kChannels, x - static_cast<float>(column),
                y - static_cast<float>(row));
    }
    const Eigen::Vector2i near(std::lround(x), std::lround(y));
    const std::size_t nearest =
        static_cast<std::size_t>(near.y()) * width + static_cast<std::size_t>(near.x());
    copy_nearest(wide, nearest, i, image);
    image.depth_m[i] = depth_between(
        wide, near, {x - static_cast<float>(near.x()), y - static_cast<float>(near.y())});
    if (!image.flow_depth_m.empty()) {
      // The depth between pixels is what is compared with it: at the horizon they differ by meters.
      const float share =
          std::isinf(image.depth_m[i]) ? 1 : image.depth_m[i] / wide.depth_m[nearest];
      image.flow_depth_m[i] = share * wide.flow_depth_m[nearest];
    }
    const auto look_up_flow = [&](const std::vector<float>& from, std::vector<float>& to) {
      if (to.empty()) return;
      Eigen::Map<Eigen::Vector2f> moved(&to[2 * i]);
      moved = flow_through(lens, map.wide, near.cast<double>(),
                           {from[2 * nearest], from[2 * nearest + 1]});
    };
    look_up_flow(wide.flow, image.flow);
    look_up_flow(wide.flow_backward, image.flow_backward);
  }
}

/// The image's buffers, from those of the wide image.
Frame looked_up(const LensMap& map, const camera::Intrinsics& lens, const Frame& wide) {
  Frame image;
  image.index = wide.index;
  image.time_s = wide.time_s;
  const std::size_t pixels = map.position.size() / 2;
  image.rgb.resize(pixels * 3);
  image.id.resize(pixels);
  image.depth_m.resize(pixels);
  if (!wide.normal.empty()) image.normal.resize(pixels * 3);
  if (!wide.hazard_opacity.empty()) image.hazard_opacity.resize(pixels * 3);
  if (!wide.flow.empty()) image.flow.resize(pixels * 2);
  if (!wide.flow_backward.empty()) image.flow_backward.resize(pixels * 2);
  if (!wide.flow_depth_m.empty()) image.flow_depth_m.resize(pixels);
  if (!wide.scene_flow_m.empty()) image.scene_flow_m.resize(pixels * 3);
  if (!wide.part.empty()) image.part.resize(pixels);
  if (!wide.surface.empty()) image.surface.resize(pixels);
  parallel_ranges(
      pixels, kRowsOfTask * static_cast<std::size_t>(lens.width),
      [&](std::size_t begin, std::size_t end) { look_up(map, lens, wide, begin, end, image); });
  return image;
}

std::unordered_set<std::uint32_t> ids_in(const Frame& frame) {
  std::unordered_set<std::uint32_t> ids;
  std::uint32_t last = kIdNothing;
  for (const std::uint32_t id : frame.id) {
    if (id == last) continue;
    ids.insert(id);
    last = id;
  }
  return ids;
}

/// Bounds of a person's pixels in a frame that holds these rows.
Eigen::AlignedBox2d visible_box(const Frame& strip, const Rows& rows, std::uint32_t agent) {
  Eigen::AlignedBox2d box;
  std::size_t pixel = 0;
  for (int y = rows.first; y < rows.end; ++y) {
    for (int x = 0; x < strip.width(); ++x, ++pixel) {
      if (strip.id[pixel] != id_of_agent(agent)) continue;
      box.extend(Vector2d(x, y));
      box.extend(Vector2d(x + 1, y + 1));
    }
  }
  return box;
}

}  // namespace

struct Lens::Known {
  camera::Intrinsics lens;
  Rows rows;
  LensMap map;

  bool is_of(const camera::Intrinsics& other, const Rows& others) const {
    return lens.width == other.width && lens.height == other.height && lens.fx_px == other.fx_px &&
           lens.fy_px == other.fy_px && lens.cx_px == other.cx_px && lens.cy_px == other.cy_px &&
           lens.skew_px == other.skew_px && lens.distortion->model() == other.distortion->model() &&
           lens.distortion->coefficients() == other.distortion->coefficients() &&
           rows.first == others.first && rows.end == others.end;
  }
};

Lens::Lens(Renderer& renderer, const skinning::Population& population)
    : renderer_(&renderer), population_(&population) {}

Lens::~Lens() = default;

const LensMap& Lens::map_of(const camera::Intrinsics& lens, const Rows& rows) {
  for (const auto& known : known_) {
    if (known->is_of(lens, rows)) return known->map;
  }
  // Cameras of one job come in turn; more than these would be a camera that zooms.
  constexpr std::size_t kMaxKnown = 64;
  if (known_.size() == kMaxKnown) known_.erase(known_.begin());
  known_.push_back(std::make_unique<Known>(Known{lens, rows, lens_map(lens, rows)}));
  return known_.back()->map;
}

namespace {

/// A mask of an image of rows, or of a wide image, as pixels of the image.
PixelMask seen_through(const LensMap* map, const camera::Intrinsics& lens, const Rows& rows,
                       const PersonInView& person) {
  const PixelMask& drawn = *person.whole_mask;
  Eigen::AlignedBox2i bounds(Eigen::Vector2i(0, rows.first), Eigen::Vector2i(lens.width, rows.end));
  const Eigen::AlignedBox2d& box = person.amodal_box;
  bounds = bounds.intersection(Eigen::AlignedBox2i(box.min().array().floor().cast<int>() - 1,
                                                   box.max().array().ceil().cast<int>() + 1));
  PixelMask mask(bounds);
  if (mask.set.empty()) return mask;
  for (int y = bounds.min().y(); y < bounds.max().y(); ++y) {
    for (int x = bounds.min().x(); x < bounds.max().x(); ++x) {
      Eigen::Vector2i at(x, y - rows.first);
      if (map != nullptr) {
        const std::size_t pixel =
            static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(lens.width) +
            static_cast<std::size_t>(x);
        if (!map->shows(pixel)) continue;
        at = {static_cast<int>(std::lround(map->position[2 * pixel])),
              static_cast<int>(std::lround(map->position[2 * pixel + 1]))};
      }
      if (drawn.at(at.x(), at.y())) mask.put(x, y);
    }
  }
  return mask;
}

}  // namespace

Frame Lens::draw(const Scene& scene, const camera::Camera& camera, const NeighborFrame* next) {
  return draw_rows(scene, camera, {0, camera.intrinsics.height}, next);
}

Frame Lens::draw_rows(const Scene& scene, const camera::Camera& camera, const Rows& rows,
                      const NeighborFrame* next, const DrawChoice& choice) {
  const camera::Intrinsics& lens = camera.intrinsics;
  const LensMap* map = lens.distortion ? &map_of(lens, rows) : nullptr;
  if (map == nullptr && rows.are_all(lens)) {
    Frame frame = renderer_->draw(scene, camera, next, choice);
    if (choice.truth) measure_objects(scene, renderer_->vehicles(), rows, frame);
    return frame;
  }
  const camera::Intrinsics drawn = map == nullptr ? cropped(lens, rows) : map->wide;
  const PixelWeights weights = map == nullptr ? cropped_weights(lens, rows) : PixelWeights();
  const auto as_rendered = [&](const NeighborFrame* other) {
    return other == nullptr
               ? std::nullopt
               : std::optional(NeighborFrame{other->scene, {drawn, other->camera.pose}});
  };
  const std::optional<NeighborFrame> next_rendered = as_rendered(next);
  const std::optional<NeighborFrame> previous_rendered = as_rendered(choice.previous);
  DrawChoice weighted = choice;
  weighted.previous = previous_rendered ? &*previous_rendered : nullptr;
  weighted.weights = map == nullptr ? &weights : &map->weights;
  weighted.whole = map == nullptr ? &lens : &map->whole;
  Frame frame = renderer_->draw(scene, {drawn, camera.pose},
                                next_rendered ? &*next_rendered : nullptr, weighted);
  if (map != nullptr) {
    Frame image = looked_up(*map, lens, frame);
    image.people = std::move(frame.people);
    renderer_->recycle(std::move(frame));
    frame = std::move(image);
  }
  frame.camera = camera;
  measure_boxes(scene, rows, frame);
  if (choice.truth) measure_objects(scene, renderer_->vehicles(), rows, frame);
  for (PersonInView& person : frame.people) {
    if (person.whole_mask == nullptr) continue;
    person.whole_mask = std::make_shared<PixelMask>(seen_through(map, lens, rows, person));
  }
  return frame;
}

void Lens::recycle(Frame&& frame) { renderer_->recycle(std::move(frame)); }

void Lens::measure_boxes(const Scene& scene, const Rows& rows, Frame& frame) const {
  std::unordered_map<std::uint32_t, const PersonInstance*> instances;
  for (const PersonInstance& person : scene.people) instances[person.agent] = &person;
  const std::unordered_set<std::uint32_t> visible = ids_in(frame);
  const Eigen::AlignedBox2d image(Vector2d(0, 0), Vector2d(frame.width(), frame.height()));
  std::vector<PersonInView> kept;
  for (PersonInView& person : frame.people) {
    PersonInstance instance = *instances.at(person.agent);
    instance.pose = drawn_pose(instance.pose, person.level);
    const skinning::Character& character = population_->characters[instance.appearance.character];
    const skinning::Mesh& mesh = character.levels[person.level];
    const std::vector<skinning::Part> parts = select_parts(character, mesh, Share::body);
    const skinning::Palette palette = blended_palette(*population_, instance);
    const Stance stance(instance);
    bool is_cut = false;
    const Eigen::AlignedBox2d box =
        shown_box(mesh, parts, palette, stance, frame.camera, rows, is_cut);
    const bool shows = visible.contains(id_of_agent(person.agent));
    // Parts beside the image count where another strip shows the person.
    const bool is_beside = !box.intersects(image);
    if (!shows && (box.isEmpty() || (is_beside && rows.are_all(frame.camera.intrinsics)))) {
      continue;
    }
    // Right at the camera, at the border, or where the lens's model ends, an image may show
    // triangles of somebody but no corner of them.
    person.amodal_box = box;
    person.head_box = head_box(renderer_->head_points(instance.appearance.character, person.level),
                               palette, stance, frame.camera);
    if (shows && (box.isEmpty() || is_beside || is_cut)) {
      person.amodal_box.extend(visible_box(frame, rows, person.agent));
    }
    kept.push_back(std::move(person));
  }
  frame.people = std::move(kept);
}

}  // namespace throng::render
