#include "render/people/people_in_view.h"

#include <algorithm>
#include <tuple>

#include "base/error.h"
#include "render/frame/view.h"
#include "skinning/levels.h"

namespace throng::render {

namespace {

/// Image height (px) of people whose shadows show a head.
constexpr double kFineShadowPx = 40;
/// Image height of people on stands who cast shadows: those of others are hidden by people.
constexpr double kStandShadowPx = 20;

/// The image with a margin on all sides, of which only the pixels `measured` are left.
Eigen::AlignedBox2d listed_pixels(const camera::Intrinsics& image, int margin_px,
                                  const Eigen::AlignedBox2i& measured) {
  const Eigen::AlignedBox2i widened(
      Eigen::Vector2i::Constant(-margin_px),
      Eigen::Vector2i(image.width + margin_px, image.height + margin_px));
  return widened.intersection(measured).cast<double>();
}

/// The camera whose image has a margin on all sides.
camera::Camera widened(camera::Camera camera, int margin_px) {
  camera.intrinsics.cx_px += margin_px;
  camera.intrinsics.cy_px += margin_px;
  camera.intrinsics.width += 2 * margin_px;
  camera.intrinsics.height += 2 * margin_px;
  return camera;
}

}  // namespace

PeopleFinder::PeopleFinder(const skinning::Population& population, const QualitySettings& quality,
                           bool bone_turns)
    : population_(&population), quality_(quality), bone_turns_(bone_turns) {
  landmarks_.reserve(population.characters.size());
  for (const skinning::Character& character : population.characters) {
    std::vector<BodyShape>& bodies = bodies_.emplace_back();
    std::vector<BodyShape>& umbrellas = umbrellas_.emplace_back();
    for (const skinning::Mesh& mesh : character.levels) {
      bodies.emplace_back(mesh, select_parts(character, mesh, Share::body));
      umbrellas.emplace_back(mesh, select_parts(character, mesh, Share::umbrella));
    }
    landmarks_.push_back(skinning::find_landmarks(character));
  }
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const std::size_t drawn = std::min(bodies_[i].size(), skinning::kDrawnLevels);
    boxes_.emplace_back(population, i, std::span(bodies_[i]).first(drawn));
  }
}

Shading PeopleFinder::shading_of(std::size_t level) const {
  return static_cast<int>(level) < quality_.textured_levels ? Shading::textured
                                                            : Shading::by_corners;
}

PersonDraw PeopleFinder::draw_of(std::uint32_t person, double height_px, double depth_m,
                                 std::size_t levels) const {
  const std::size_t level = level_of_detail(quality_.detail * height_px, levels);
  return {person, static_cast<std::uint32_t>(level), shading_of(level),
          static_cast<float>(depth_m)};
}

std::span<const SkinPoint> PeopleFinder::head_points(std::uint32_t character,
                                                     std::size_t level) const {
  // Coarser levels leave two or three points of some heads.
  constexpr std::size_t kCoarsest = 3;
  return bodies_[character][std::min(level, kCoarsest)].head;
}

bool PeopleFinder::casts_shadow(const PersonInstance& instance,
                                const camera::Camera& camera) const {
  constexpr float kOnGroundM = 0.1F;  // so are people on benches, which differ in height
  if (instance.position.z() < kOnGroundM) return true;
  const double distance_m = (instance.position.cast<double>() - camera.pose.center()).norm();
  const double stature_m = population_->characters[instance.appearance.character].stature_m;
  return camera.intrinsics.fy_px * stature_m > kStandShadowPx * distance_m;
}

PersonDraw PeopleFinder::caster(std::uint32_t person, const PersonInstance& instance,
                                const camera::Camera& camera) const {
  const skinning::Character& character = population_->characters[instance.appearance.character];
  const double distance_m = (instance.position.cast<double>() - camera.pose.center()).norm();
  const double height_px =
      camera.intrinsics.fy_px * character.stature_m / std::max(distance_m, double{kNear});
  const std::size_t finer = height_px < kFineShadowPx ? 0 : 2;
  const std::size_t level =
      character.levels.size() - 1 - std::min(finer, character.levels.size() - 1);
  return {person, static_cast<std::uint32_t>(level), shading_of(level), 0};
}

void PeopleFinder::measure(const PersonInstance& person, const Stance& stance,
                           const skinning::Palette& palette, PersonInView& truth) const {
  const std::uint32_t character = person.appearance.character;
  const float stature_m = population_->characters[character].stature_m;
  truth.agent = person.agent;
  truth.position = stance.position;
  truth.hips = posed_point(palette, stance, skinning::Bone::hips, kHipsShare * stature_m);
  truth.head = posed_point(palette, stance, skinning::Bone::head, kHeadShare * stature_m);
  truth.velocity = person.velocity.cast<double>();
  truth.yaw_rad = person.yaw_rad;
  truth.actions = person.actions;
  truth.stature_m = stature_m;
  measure_body(boxes_[character].box_of(person.pose, palette), landmarks_[character], palette,
               stance, truth);
  if (bone_turns_) measure_turns(palette, stance, truth);
}

/// Near people show the most texels; equals go by agent, so that nothing hangs on their order.
void PeopleFinder::texture_the_nearest(std::vector<Seen>& seen) const {
  std::vector<Seen*> others;
  for (Seen& person : seen) {
    if (person.draw.shading == Shading::by_corners) others.push_back(&person);
  }
  const auto room = static_cast<std::size_t>(quality_.people_positions);
  const auto count =
      static_cast<std::ptrdiff_t>(std::min(others.size(), room - std::min(room, seen.size())));
  const auto key = [](const Seen* person) {
    return std::tuple(person->draw.depth_m, person->truth.agent);
  };
  std::nth_element(others.begin(), others.begin() + count, others.end(),
                   [&](const Seen* a, const Seen* b) { return key(a) < key(b); });
  std::for_each(others.begin(), others.begin() + count,
                [](Seen* person) { person->draw.shading = Shading::lit_by_corners; });
}

std::vector<Seen> PeopleFinder::find(const Scene& scene, const camera::Camera& camera,
                                     const Eigen::AlignedBox2i& measured, int margin_px) const {
  const ClipPlanes planes = clip_planes(widened(camera, margin_px));
  const Eigen::AlignedBox2d listed = listed_pixels(camera.intrinsics, margin_px, measured);
  std::vector<Seen> seen;
  seen.reserve(scene.people.size());
  skinning::Palette blended;
  for (std::uint32_t i = 0; i < scene.people.size(); ++i) {
    const PersonInstance& person = scene.people[i];
    check(person.appearance.character < population_->characters.size() &&
              std::max(person.pose.a, person.pose.b) < population_->palettes_per_character,
          "people use characters and palettes that the population has");
    const skinning::Character& character = population_->characters[person.appearance.character];
    const Eigen::Vector3d middle =
        person.position.cast<double>() + Eigen::Vector3d(0, 0, 0.5 * character.stature_m);
    if (is_outside(planes, middle, kPersonReach * character.stature_m)) continue;
    const double depth_m = std::max<double>(camera.project(middle).depth_m, kNear);
    const double height_px = camera.intrinsics.fy_px * character.stature_m / depth_m;
    const PersonDraw draw = draw_of(i, height_px, depth_m, character.levels.size());
    const skinning::PoseBlend drawn = drawn_pose(person.pose, draw.level);
    if (drawn.blend > 0) blended = blended_palette(*population_, person);
    const skinning::Palette& palette =
        drawn.blend > 0 ? blended : population_->palette(person.appearance.character, drawn.a);
    const Stance stance(person);
    const auto box_of = [&](const std::vector<std::vector<BodyShape>>& shapes) {
      const BodyShape& shape = shapes[person.appearance.character][draw.level];
      return silhouette_box(shape, palette, stance, camera).intersection(measured.cast<double>());
    };
    const auto shows = [&](const Eigen::AlignedBox2d& box) {
      return !box.isEmpty() && box.intersects(listed);
    };
    const Eigen::AlignedBox2d body = box_of(bodies_);
    if (!shows(body) && !shows(box_of(umbrellas_))) continue;
    Seen& found = seen.emplace_back();
    found.draw = draw;
    found.is_listed = shows(body);
    found.truth.amodal_box = body;
    found.truth.head_box =
        head_box(head_points(person.appearance.character, draw.level), palette, stance, camera);
    found.truth.level = draw.level;
    // In space everybody is the same for all cameras.
    if (drawn.blend == 0 && person.pose.blend > 0) blended = blended_palette(*population_, person);
    measure(person, stance, person.pose.blend > 0 ? blended : palette, found.truth);
  }
  const auto by_agent = [](const Seen& a, const Seen& b) { return a.truth.agent < b.truth.agent; };
  // Scenes list people in this order already, and large values are slow to move.
  if (!std::is_sorted(seen.begin(), seen.end(), by_agent)) {
    std::sort(seen.begin(), seen.end(), by_agent);
  }
  texture_the_nearest(seen);
  return seen;
}

}  // namespace throng::render
