#include "render/lens.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "base/error.h"
#include "base/parallel.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;

/// Rows that one task of a loop takes.
constexpr std::size_t kGrain = 16;
/// Where a lens magnifies more than this, the wide picture is coarser than the image.
constexpr double kMostMagnified = 2;
/// Farther out are no pixels (px).
constexpr float kFarthestPosition = 1e6F;
/// Steps of the search for the largest magnification (px).
constexpr int kCoarse = 16;

std::size_t cells(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

bool is_whole(const Rows& rows, const camera::Intrinsics& lens) {
  return rows.first == 0 && rows.end == lens.height;
}

/// How many wide pixels per image pixel it takes to lose nothing where the lens magnifies most.
double magnification(const camera::Intrinsics& lens) {
  double most = 1;
  for (int y = 0; y < lens.height; y += kCoarse) {
    for (int x = 0; x < lens.width; x += kCoarse) {
      const auto direction = lens.direction_of({x, y});
      check(direction.has_value(), "a lens's model holds in its whole image");
      most =
          std::max(most, lens.distortion->derivatives(*direction).jacobiSvd().singularValues()[0]);
    }
  }
  return std::min(most, kMostMagnified);
}

/// Directions of a row of pixels from `first` on, NaN beyond the model.
void fill_row(const camera::Intrinsics& lens, const Eigen::Vector2i& first,
              std::span<Vector2d> row) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Vector2d before = Vector2d::Constant(kNone);
  Vector2d last = before;
  Vector2d pixel = first.cast<double>();
  for (Vector2d& direction : row) {
    // Along a row directions grow nearly evenly. NaN is no guess.
    direction = lens.direction_of(pixel, 2 * last - before).value_or(Vector2d::Constant(kNone));
    before = last;
    last = direction;
    pixel.x() += 1;
  }
}

/// Directions of an area's pixels, row by row: NaN beyond the model.
std::vector<Vector2d> directions_of(const camera::Intrinsics& lens,
                                    const Eigen::AlignedBox2i& area) {
  const Eigen::Vector2i size = area.sizes();
  const auto width = static_cast<std::size_t>(size.x());
  std::vector<Vector2d> directions(cells(size.x(), size.y()));
  parallel_ranges(static_cast<std::size_t>(size.y()), kGrain,
                  [&](std::size_t begin, std::size_t end) {
                    for (std::size_t row = begin; row < end; ++row) {
                      fill_row(lens, {area.min().x(), area.min().y() + static_cast<int>(row)},
                               std::span(directions).subspan(row * width, width));
                    }
                  });
  return directions;
}

/// The pinhole picture that holds all these directions, with a pixel more at each side for the
/// interpolation.
camera::Intrinsics wide_pinhole(const camera::Intrinsics& lens,
                                const std::vector<Vector2d>& directions) {
  Eigen::AlignedBox2d field;
  for (const Vector2d& direction : directions) field.extend(direction);
  const double finer = magnification(lens);
  camera::Intrinsics wide;
  wide.fx_px = lens.fx_px * finer;
  wide.fy_px = lens.fy_px * finer;
  // Whole pixels from the lens's own axis: where nothing is magnified, pixels lie on pixels.
  wide.cx_px = lens.cx_px + std::ceil(1 - field.min().x() * wide.fx_px - lens.cx_px);
  wide.cy_px = lens.cy_px + std::ceil(1 - field.min().y() * wide.fy_px - lens.cy_px);
  wide.width = static_cast<int>(std::ceil(field.max().x() * wide.fx_px + wide.cx_px)) + 2;
  wide.height = static_cast<int>(std::ceil(field.max().y() * wide.fy_px + wide.cy_px)) + 2;
  return wide;
}

/// Where in the wide picture a direction is seen. Floats, since it is kept for every pixel.
Eigen::Vector2f wide_position(const camera::Intrinsics& wide, const Vector2d& direction) {
  return Vector2d(direction.x() * wide.fx_px + wide.cx_px, direction.y() * wide.fy_px + wide.cy_px)
      .cast<float>();
}

/// Counts the nearest wide pixel of every pixel of the image and of what is around these rows.
PixelWeights weights_of(const camera::Intrinsics& lens, const Rows& rows,
                        const camera::Intrinsics& wide) {
  const int beside = lens.width / 4;
  const int above = rows.first == 0 ? lens.height / 4 : 0;
  const int below = rows.end == lens.height ? lens.height / 4 : 0;
  const Eigen::AlignedBox2i area(Eigen::Vector2i(-beside, rows.first - above),
                                 Eigen::Vector2i(lens.width + beside, rows.end + below));
  const Eigen::Vector2i size(wide.width, wide.height);
  PixelWeights weights;
  weights.domain = Eigen::AlignedBox2i(-size / 2, size + size / 2);
  const Eigen::Vector2i span = weights.domain.sizes();
  weights.count.resize(cells(span.x(), span.y()));
  for (const Vector2d& direction : directions_of(lens, area)) {
    const Eigen::Vector2f at = wide_position(wide, direction);
    // Written so that NaN leaves, too.
    if (!(at.cwiseAbs().maxCoeff() < kFarthestPosition)) continue;
    const Eigen::Vector2i pixel(std::lround(at.x()), std::lround(at.y()));
    if (!weights.domain.contains(pixel) || pixel.x() == weights.domain.max().x() ||
        pixel.y() == weights.domain.max().y()) {
      continue;
    }
    const Eigen::Vector2i inside = pixel - weights.domain.min();
    std::uint8_t& count =
        weights.count[static_cast<std::size_t>(inside.y()) * static_cast<std::size_t>(span.x()) +
                      static_cast<std::size_t>(inside.x())];
    if (count < std::numeric_limits<std::uint8_t>::max()) ++count;
  }
  return weights;
}

/// The camera of some rows of a pinhole's image.
camera::Intrinsics cropped(camera::Intrinsics pinhole, const Rows& rows) {
  pinhole.cy_px -= rows.first;
  pinhole.height = rows.end - rows.first;
  return pinhole;
}

/// Everything of the image's column in these rows, and beyond the image's border.
PixelWeights cropped_weights(const camera::Intrinsics& pinhole, const Rows& rows) {
  constexpr int kFar = 1 << 20;
  PixelWeights weights;
  weights.domain.extend(Eigen::Vector2i(-kFar, rows.first == 0 ? -kFar : 0));
  weights.domain.extend(
      Eigen::Vector2i(kFar, rows.end == pinhole.height ? kFar : rows.end - rows.first));
  return weights;
}

std::uint8_t mixed(const std::uint8_t* above, const std::uint8_t* below, int right, float u,
                   float v) {
  const auto value = [](std::uint8_t byte) { return static_cast<float>(byte); };
  const float top = value(above[0]) + u * (value(above[right]) - value(above[0]));
  const float bottom = value(below[0]) + u * (value(below[right]) - value(below[0]));
  return static_cast<std::uint8_t>(std::lrint(top + v * (bottom - top)));
}

/// How far the image moves where the wide picture moves by `flow` from one of its pixels; NaN
/// where the lens shows nothing.
Eigen::Vector2f flow_through(const camera::Intrinsics& lens, const camera::Intrinsics& wide,
                             const Vector2d& pixel, const Eigen::Vector2f& flow) {
  const auto seen = [&](const Vector2d& at) { return lens.pixel_of(*wide.direction_of(at)); };
  const auto from = seen(pixel);
  const auto to = seen(pixel + flow.cast<double>());
  if (!from || !to) return Eigen::Vector2f::Constant(std::numeric_limits<float>::quiet_NaN());
  return (*to - *from).cast<float>();
}

/// What of the wide picture is not interpolated.
void copy_nearest(const Frame& wide, std::size_t from, std::size_t to, Frame& image) {
  image.id[to] = wide.id[from];
  image.depth_m[to] = wide.depth_m[from];
  if (!image.part.empty()) image.part[to] = wide.part[from];
  if (!image.normal.empty()) std::copy_n(&wide.normal[from * 3], 3, &image.normal[to * 3]);
}

/// Looks pixels [begin, end) of the image up in the wide picture.
void look_up(const LensMap& map, const camera::Intrinsics& lens, const Frame& wide,
             std::size_t begin, std::size_t end, Frame& image) {
  constexpr int kChannels = 3;
  const auto width = static_cast<std::size_t>(wide.width());
  for (std::size_t i = begin; i < end; ++i) {
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
    if (image.flow.empty()) continue;
    const Eigen::Vector2f flow = flow_through(lens, map.wide, near.cast<double>(),
                                              {wide.flow[2 * nearest], wide.flow[2 * nearest + 1]});
    image.flow[2 * i] = flow.x();
    image.flow[2 * i + 1] = flow.y();
  }
}

/// The image's buffers, from those of the wide picture.
Frame looked_up(const LensMap& map, const camera::Intrinsics& lens, const Frame& wide) {
  Frame image;
  image.index = wide.index;
  image.time_s = wide.time_s;
  const std::size_t pixels = map.position.size() / 2;
  image.rgb.resize(pixels * 3);
  image.id.resize(pixels);
  image.depth_m.resize(pixels);
  if (!wide.normal.empty()) image.normal.resize(pixels * 3);
  if (!wide.flow.empty()) image.flow.resize(pixels * 2);
  if (!wide.part.empty()) image.part.resize(pixels);
  parallel_ranges(
      pixels, kGrain * static_cast<std::size_t>(lens.width),
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

Eigen::Vector2i wide_size(const camera::Intrinsics& lens) {
  if (!lens.distortion) return {lens.width, lens.height};
  // A picture that does not fold has its extremes at its border; the grid inside finds folds.
  std::vector<Vector2d> directions;
  const auto step = [](int at, int size) { return std::min(at + kCoarse, size - 1); };
  for (int y = 0;; y = step(y, lens.height)) {
    for (int x = 0;; x = step(x, lens.width)) {
      const auto direction = lens.direction_of({x, y});
      if (!direction) return Eigen::Vector2i::Zero();
      directions.push_back(*direction);
      if (x == lens.width - 1) break;
    }
    if (y == lens.height - 1) break;
  }
  const camera::Intrinsics wide = wide_pinhole(lens, directions);
  return {wide.width, wide.height};
}

LensMap lens_map(const camera::Intrinsics& lens, const Rows& rows) {
  check(lens.distortion.has_value(), "only a lens that distorts has a map");
  const std::vector<Vector2d> directions =
      directions_of(lens, {Eigen::Vector2i(0, rows.first), Eigen::Vector2i(lens.width, rows.end)});
  check(std::none_of(directions.begin(), directions.end(),
                     [](const Vector2d& direction) { return direction.hasNaN(); }),
        "a lens's model holds in its whole image");
  LensMap map;
  map.wide = wide_pinhole(lens, directions);
  map.position.reserve(directions.size() * 2);
  for (const Vector2d& direction : directions) {
    const Eigen::Vector2f at = wide_position(map.wide, direction);
    map.position.push_back(at.x());
    map.position.push_back(at.y());
  }
  map.weights = weights_of(lens, rows, map.wide);
  return map;
}

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
  constexpr std::size_t kMostKnown = 64;
  if (known_.size() == kMostKnown) known_.erase(known_.begin());
  known_.push_back(std::make_unique<Known>(Known{lens, rows, lens_map(lens, rows)}));
  return known_.back()->map;
}

namespace {

/// A mask of a picture of rows, or of a wide picture, as pixels of the image.
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
        at = {static_cast<int>(std::lround(map->position[2 * pixel])),
              static_cast<int>(std::lround(map->position[2 * pixel + 1]))};
      }
      if (drawn.at(at.x(), at.y())) mask.put(x, y);
    }
  }
  return mask;
}

}  // namespace

Frame Lens::draw(const Scene& scene, const camera::Camera& camera, const NextFrame* next) {
  return draw_rows(scene, camera, {0, camera.intrinsics.height}, next);
}

Frame Lens::draw_rows(const Scene& scene, const camera::Camera& camera, const Rows& rows,
                      const NextFrame* next, bool truth) {
  const camera::Intrinsics& lens = camera.intrinsics;
  const LensMap* map = lens.distortion ? &map_of(lens, rows) : nullptr;
  if (map == nullptr && is_whole(rows, lens)) {
    return renderer_->draw(scene, camera, next, {nullptr, truth});
  }
  const camera::Intrinsics drawn = map == nullptr ? cropped(lens, rows) : map->wide;
  const PixelWeights weights = map == nullptr ? cropped_weights(lens, rows) : PixelWeights();
  std::optional<NextFrame> next_drawn;
  if (next != nullptr) next_drawn = NextFrame{next->scene, {drawn, next->camera.pose}};
  Frame frame = renderer_->draw(scene, {drawn, camera.pose}, next_drawn ? &*next_drawn : nullptr,
                                {map == nullptr ? &weights : &map->weights, truth});
  if (map != nullptr) {
    Frame image = looked_up(*map, lens, frame);
    image.people = std::move(frame.people);
    renderer_->recycle(std::move(frame));
    frame = std::move(image);
  }
  frame.camera = camera;
  measure_boxes(scene, rows, frame);
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
    const PersonInstance& instance = *instances.at(person.agent);
    const skinning::Mesh& mesh =
        population_->characters[instance.appearance.character].levels[person.level];
    const Eigen::AlignedBox2d box =
        shown_box(mesh, blended_palette(*population_, instance), instance, frame.camera, rows);
    const bool shows = visible.contains(id_of_agent(person.agent));
    if (!shows && (box.isEmpty() || !box.intersects(image))) continue;
    // Of somebody right at the camera the model may show triangles but no corner of them.
    person.amodal_box = box.isEmpty() ? visible_box(frame, rows, person.agent) : box;
    kept.push_back(std::move(person));
  }
  frame.people = std::move(kept);
}

}  // namespace throng::render
