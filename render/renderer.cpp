#include "render/renderer.h"

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "render/frame/view.h"
#include "render/gl/context.h"
#include "render/gl/gl_objects.h"
#include "render/gl/multisample_target.h"
#include "render/gl/opacity_target.h"
#include "render/gl/shadow_map.h"
#include "render/gl/surface_target.h"
#include "render/gl/target.h"
#include "render/light/place_light.h"
#include "render/passes/airframe_pass.h"
#include "render/passes/beam_pass.h"
#include "render/passes/contact_pass.h"
#include "render/passes/prop_pass.h"
#include "render/passes/scenery_pass.h"
#include "render/passes/sky_pass.h"
#include "render/passes/smoke_pass.h"
#include "render/passes/smooth_edges.h"
#include "render/passes/still_surfaces.h"
#include "render/people/distant_pass.h"
#include "render/people/people_in_view.h"
#include "render/people/people_pass.h"
#include "render/scenery/lighting.h"
#include "render/scenery/metering.h"
#include "render/scenery/place_meshes.h"
#include "render/scenery/scenery.h"
#include "render/scenery/surface_classes.h"
#include "render/truth/objects_in_view.h"
#include "render/truth/people_coverage.h"

namespace throng::render {

namespace {

std::vector<PersonDraw> make_draws(const std::vector<Seen>& seen) {
  std::vector<PersonDraw> draws;
  draws.reserve(seen.size());
  for (const Seen& person : seen) {
    if (!person.is_painted) draws.push_back(person.draw);
  }
  return draws;
}

/// The same camera with `times` as many pixels along each side.
camera::Camera scaled(const camera::Camera& camera, int times) {
  camera::Camera fine = camera;
  camera::Intrinsics& k = fine.intrinsics;
  k.width *= times;
  k.height *= times;
  k.fx_px *= times;
  k.fy_px *= times;
  // Pixel centers are whole numbers: the image begins half a pixel before the first.
  k.cx_px = (k.cx_px + 0.5) * times - 0.5;
  k.cy_px = (k.cy_px + 0.5) * times - 0.5;
  return fine;
}

/// A device's own rasterizer is faster than DistantPass unless it is software. Surfaces are drawn
/// again, where they have exactly the depth of the first time.
bool paints_distant(const RenderOptions& options, bool is_software) {
  return is_software &&
         !(options.normals || options.parts || options.flow || options.flow_backward);
}

/// Metering needs the shadows of whole buildings only.
constexpr int kShadowTexelsPerMeteringTexel = 8;

/// Makes a target of this size if there is none.
template <typename T, typename... Others>
void resize(std::optional<T>& target, int width, int height, Others... others) {
  if (target && target->width() == width && target->height() == height) return;
  target.reset();
  target.emplace(width, height, others...);
}

}  // namespace

struct Renderer::State {
  State(const world::Scenario& scenario, const skinning::Population& people,
        const Environment& shown, const DeviceChoice& device, const RenderOptions& wanted);
  ~State();
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void draw_shadows(const Scene& scene, const camera::Camera& camera,
                    const Eigen::AlignedBox2d& area, const ShadowMap& shadows);
  void draw_image(const Scene& scene, const camera::Camera& camera, const DrawChoice& choice,
                  std::vector<Seen>& seen, Frame& frame);
  void draw_light(const Scene& scene, const camera::Camera& camera, double exposure_gain,
                  const ShadowMap& shadows);
  const Frame& draw_metered(const Scene& scene, const camera::Camera& camera);
  void draw_smooth(const Scene& scene, const camera::Camera& camera, const std::vector<Seen>& seen,
                   Frame& frame);
  void upload_view(const camera::Camera& camera) const;
  void draw_view(const Scene& scene, const camera::Camera& camera, const std::vector<Seen>& seen,
                 PeoplePass::Purpose purpose, Target* kept);
  void draw_backdrop(const camera::Camera& camera, Target* kept) const;
  void draw_truth(const Scene& scene, const camera::Camera& camera, const std::vector<Seen>& seen);
  void draw_surfaces(const Scene& scene, const NeighborFrame* next, const NeighborFrame* previous,
                     const std::vector<Seen>& seen, Frame& frame);
  void draw_opacity(const Scene& scene, Frame& frame);
  void draw_motion(const Scene& scene, const NeighborFrame* other, const std::vector<Seen>& seen,
                   const camera::Camera& camera);
  void read_motion(const Scene& scene, const NeighborFrame* other, const Frame& frame,
                   std::vector<float>& flow, std::vector<float>* depth_m) const;

  /// Reports the end of a stage, for profiles.
  void lap(std::string_view stage) const {
    if (options.clock == nullptr) return;
    glFinish();
    options.clock->lap(stage);
  }

  Context context;  // first: everything below needs it, also to be destroyed
  RenderOptions options;
  QualitySettings quality;
  bool multisample;
  bool color_apart;  ///< colors have several samples a pixel, and are rendered on their own
  const skinning::Population* population;
  PeopleFinder finder;
  Environment environment;
  std::vector<world::Disaster> disasters;
  Daylight daylight;
  Eigen::AlignedBox2d ground;
  double tallest;
  PlaceMeshes meshes;  ///< until they are on the device
  ProbeGrid air;       ///< the light for what moves
  SceneryPass place;
  PropPass props;
  AirframePass airframes;
  ContactPass contacts;
  PeoplePass people_pass;
  std::optional<DistantPass> distant;
  SkyPass sky;
  SmokePass smoke;
  BeamPass beams;
  ShadowMap shadow_map;
  ShadowMap metering_shadows;
  std::vector<Vehicle> vehicles;
  PeopleCoverage coverage;
  Buffer view_buffer;
  Buffer next_view_buffer;
  Buffer light_buffer;
  std::optional<Target> target;
  /// For color alone, when a pixel has several samples of it.
  std::optional<Target> fine_target;
  std::optional<MultisampleTarget> multisample_target;
  std::optional<SurfaceTarget> surface_target;
  std::optional<OpacityTarget> opacity_target;  ///< made when asked for
  std::optional<Target> metering_target;
  Frame metered;
  Frame spare;  ///< its buffers serve the next frame
};

Renderer::State::State(const world::Scenario& scenario, const skinning::Population& people,
                       const Environment& shown, const DeviceChoice& device,
                       const RenderOptions& wanted)
    : context(device.name),
      options(wanted),
      quality(quality_settings(wanted.quality)),
      multisample(quality.smooth_edges && wanted.multisample.value_or(!context.is_software())),
      color_apart(quality.supersampling > 1 || multisample),
      population(&people),
      finder(people, quality, wanted.bone_turns),
      environment(shown),
      disasters(scenario.disasters),
      daylight(render::daylight(environment)),
      ground(scenario.ground.min, scenario.ground.max),
      tallest(tallest_m(scenario)),
      meshes(place_meshes(scenario, wanted.semantic)),
      air(light_place(scenario, environment, daylight, quality, wanted.light_folder, meshes)),
      place(meshes, scenario, environment, quality),
      props(meshes.props, light_words(environment, scenario.disasters), quality),
      airframes(light_words(environment, scenario.disasters), quality, air),
      contacts(scenario, daylight),
      people_pass(people, air, quality, light_words(environment, scenario.disasters), color_apart),
      sky(environment),
      smoke(environment, scenario.disasters, air),
      beams(scenario, daylight.lamps_on, light_words(environment, scenario.disasters)),
      shadow_map(quality.shadow_texels),
      metering_shadows(quality.shadow_texels / kShadowTexelsPerMeteringTexel),
      view_buffer(make_buffer()),
      next_view_buffer(make_buffer()),
      light_buffer(make_buffer()) {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  // Image rows grow downwards and GL's window upwards, so that rows read back top-down; what is
  // counter-clockwise in the world is then clockwise in the window.
  glFrontFace(GL_CW);
  glDepthFunc(GL_GREATER);
  meshes = {};
  if (options.vehicles) vehicles = list_vehicles(scenario);
  if (!color_apart && paints_distant(options, context.is_software())) {
    distant.emplace(people, people_pass.meshes(), air, quality.shadow_texels > 0,
                    light_words(environment, scenario.disasters));
  }
  check_gl("setting up");
}

Renderer::State::~State() { context.make_current(); }

void Renderer::State::draw_shadows(const Scene& scene, const camera::Camera& camera,
                                   const Eigen::AlignedBox2d& area, const ShadowMap& shadows) {
  const Eigen::Vector2d slope = shadow_slope(daylight);
  std::vector<PersonDraw> casters;
  for (std::uint32_t i = 0; i < scene.people.size(); ++i) {
    const PersonInstance& person = scene.people[i];
    if (!finder.casts_shadow(person, camera)) continue;
    const skinning::Character& character = population->characters[person.appearance.character];
    const double reach = kPersonReach * character.stature_m;
    Eigen::AlignedBox2d shade(person.position.head<2>().cast<double>());
    shade.extend(Eigen::Vector2d(shade.min() - slope * reach));
    shade = {shade.min().array() - reach, shade.max().array() + reach};
    if (!shade.intersects(area)) continue;
    casters.push_back(finder.caster(i, person, camera));
  }
  shadows.begin();
  place.draw_shadow();
  props.draw_shadow(area, slope, scene.time_s);
  people_pass.draw(PeoplePass::Purpose::shadow, scene.people, std::move(casters));
}

/// The uniforms of light, and the shadows of what is in `scene`.
void Renderer::State::draw_light(const Scene& scene, const camera::Camera& camera,
                                 double exposure_gain, const ShadowMap& shadows) {
  const Eigen::AlignedBox2d area =
      shadow_area(clip_planes(camera), ground, tallest, shadow_slope(daylight));
  const std::vector<Fire> fires =
      fires_at(environment, disasters, scene.time_s, camera.pose.center());
  const LightBlock light = light_block(
      daylight, {area, tallest, camera.pose.center(), scene.time_s, fires, exposure_gain});
  glNamedBufferData(light_buffer.name(), sizeof(light), &light, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 1, light_buffer.name());
  glEnable(GL_DEPTH_TEST);
  if (quality.shadow_texels > 0 && !daylight.dark) draw_shadows(scene, camera, area, shadows);
  shadows.bind();
}

const Frame& Renderer::State::draw_metered(const Scene& scene, const camera::Camera& camera) {
  Scene scenery_only;
  scenery_only.index = scene.index;
  scenery_only.time_s = scene.time_s;
  scenery_only.dangers = scene.dangers;
  draw_light(scenery_only, camera, 1, metering_shadows);
  resize(metering_target, camera.intrinsics.width, camera.intrinsics.height);
  metering_target->begin(Eigen::Vector3f::Zero());
  draw_view(scenery_only, camera, {}, PeoplePass::Purpose::image, &*metering_target);
  metering_target->read(true, metered);
  lap("metering");
  return metered;
}

void Renderer::State::draw_image(const Scene& scene, const camera::Camera& camera,
                                 const DrawChoice& choice, std::vector<Seen>& seen, Frame& frame) {
  const camera::Intrinsics& k = camera.intrinsics;
  const camera::Camera whole{choice.whole != nullptr ? *choice.whole : camera.intrinsics,
                             camera.pose};
  draw_light(scene, whole, choice.exposure_gain, shadow_map);
  lap("shadows");
  draw_smooth(scene, camera, seen, frame);
  resize(target, k.width, k.height);
  using Purpose = PeoplePass::Purpose;
  if (distant) {
    distant->paint(scene, camera, daylight.direction.cast<float>(),
                   {choice.truth, choice.weights, options.whole_masks}, seen);
    lap("paint");
  }
  if (choice.truth) coverage.prepare(camera, seen);
  target->begin(Eigen::Vector3f::Zero());
  if (choice.truth && color_apart) {
    draw_truth(scene, camera, seen);
  } else {
    draw_view(scene, camera, seen, choice.truth ? Purpose::truth : Purpose::image, &*target);
  }
  lap("draw");
}

/// Colors that have several samples a pixel, rendered for their own sake.
void Renderer::State::draw_smooth(const Scene& scene, const camera::Camera& camera,
                                  const std::vector<Seen>& seen, Frame& frame) {
  if (quality.supersampling > 1) {
    const camera::Camera fine = scaled(camera, quality.supersampling);
    resize(fine_target, fine.intrinsics.width, fine.intrinsics.height);
    fine_target->begin(Eigen::Vector3f::Zero());
    draw_view(scene, fine, seen, PeoplePass::Purpose::image, nullptr);
    lap("draw");
    fine_target->read_light(quality.supersampling, frame);
    lap("read back");
  }
  if (multisample) {
    resize(multisample_target, camera.intrinsics.width, camera.intrinsics.height, kSamples);
    multisample_target->begin();
    draw_view(scene, camera, seen, PeoplePass::Purpose::image, nullptr);
    lap("draw");
    multisample_target->read(frame);
    lap("read back");
  }
}

void Renderer::State::upload_view(const camera::Camera& camera) const {
  const camera::Intrinsics& k = camera.intrinsics;
  const ViewBlock view = view_block(camera, guarded_viewport(k.width, k.height));
  glNamedBufferData(view_buffer.name(), sizeof(view), &view, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_buffer.name());
}

void Renderer::State::draw_view(const Scene& scene, const camera::Camera& camera,
                                const std::vector<Seen>& seen, PeoplePass::Purpose purpose,
                                Target* kept) {
  upload_view(camera);
  // People first: they are many small triangles, and hide ground that then costs nothing.
  if (distant && !seen.empty()) distant->draw();
  people_pass.draw(purpose, scene.people, make_draws(seen));
  props.draw(clip_planes(camera), scene.time_s);
  airframes.draw(scene.drones, camera);
  place.draw();
  if (quality.textured) contacts.draw(scene.people, camera);
  sky.draw_sky(camera);
  draw_backdrop(camera, kept);
  smoke.draw(scene, camera);
  beams.draw(scene);
  sky.draw_rain(camera, scene.index);
}

/// The land beyond shows in colors only: the depth of `kept`, if there is one, stays.
void Renderer::State::draw_backdrop(const camera::Camera& camera, Target* kept) const {
  const ClipPlanes planes = clip_planes(camera);
  if (!props.sees_backdrop(planes)) return;
  if (kept != nullptr) kept->keep_depth();
  props.draw_backdrop(planes);
  if (kept != nullptr) kept->restore_depth();
}

/// Ids, depth and silhouettes without colors.
void Renderer::State::draw_truth(const Scene& scene, const camera::Camera& camera,
                                 const std::vector<Seen>& seen) {
  upload_view(camera);
  people_pass.draw(PeoplePass::Purpose::truth, scene.people, make_draws(seen));
  props.draw_ids(clip_planes(camera), scene.time_s);
  airframes.draw(scene.drones, camera);
  place.draw_ids();
}

void Renderer::State::draw_surfaces(const Scene& scene, const NeighborFrame* next,
                                    const NeighborFrame* previous, const std::vector<Seen>& seen,
                                    Frame& frame) {
  resize(surface_target, frame.width(), frame.height(), target->depth_texture(),
         options.flow_depth);
  if (options.normals || options.parts || options.flow) {
    draw_motion(scene, next, seen, frame.camera);
  }
  if (options.normals) {
    surface_target->read_normals(frame.normal);
    fill_still_normals(frame);
  }
  if (options.parts) surface_target->read_parts(frame.part);
  if (options.flow) {
    read_motion(scene, next, frame, frame.flow, options.flow_depth ? &frame.flow_depth_m : nullptr);
  }
  if (options.scene_flow) {
    frame.scene_flow_m = compute_scene_flow(frame, next == nullptr ? frame.camera : next->camera);
  }
  if (!options.flow_backward) return;
  draw_motion(scene, previous, seen, frame.camera);
  read_motion(scene, previous, frame, frame.flow_backward, nullptr);
}

void Renderer::State::draw_opacity(const Scene& scene, Frame& frame) {
  resize(opacity_target, frame.width(), frame.height(), target->depth_texture());
  opacity_target->begin();
  smoke.draw_opacity(scene, frame.camera);
  opacity_target->read(frame.hazard_opacity);
}

void Renderer::State::draw_motion(const Scene& scene, const NeighborFrame* other,
                                  const std::vector<Seen>& seen, const camera::Camera& camera) {
  const Viewport viewport = guarded_viewport(camera.intrinsics.width, camera.intrinsics.height);
  const ViewBlock view = view_block(other == nullptr ? camera : other->camera, viewport);
  glNamedBufferData(next_view_buffer.name(), sizeof(view), &view, GL_STREAM_DRAW);
  glBindBufferBase(GL_UNIFORM_BUFFER, 2, next_view_buffer.name());
  surface_target->begin();
  people_pass.draw_surfaces(
      scene.people, make_draws(seen),
      other == nullptr ? std::span<const PersonInstance>() : std::span(other->scene.people));
  surface_target->end();
}

void Renderer::State::read_motion(const Scene& scene, const NeighborFrame* other,
                                  const Frame& frame, std::vector<float>& flow,
                                  std::vector<float>* depth_m) const {
  surface_target->read_flow(flow, depth_m);
  if (other == nullptr) return;
  fill_still_flow(other->camera, frame, flow, depth_m);
  fill_drone_flow(scene, *other, frame, flow, depth_m);
}

int max_image_px(const DeviceChoice& device) {
  const Context context(device.name);
  return max_target_px();
}

Renderer::Renderer(const world::Scenario& scenario, const skinning::Population& population,
                   const Environment& environment, const DeviceChoice& device,
                   const RenderOptions& options)
    : state_(std::make_unique<State>(scenario, population, environment, device, options)) {}

Renderer::~Renderer() = default;

Frame Renderer::draw(const Scene& scene, const camera::Camera& camera, const NeighborFrame* next,
                     const DrawChoice& choice) {
  check(!camera.intrinsics.distortion, "a renderer renders pinhole cameras");
  State& state = *state_;
  state.context.make_current();
  Frame frame = std::move(state.spare);
  frame.normal.clear();
  frame.flow.clear();
  frame.flow_backward.clear();
  frame.flow_depth_m.clear();
  frame.scene_flow_m.clear();
  frame.flow_target.clear();
  frame.hazard_opacity.clear();
  frame.part.clear();
  frame.surface.clear();
  frame.index = scene.index;
  frame.time_s = scene.time_s;
  frame.camera = camera;
  frame.people.clear();
  frame.objects.clear();
  const bool is_strip = choice.weights != nullptr && choice.weights->count.empty();
  const Eigen::AlignedBox2i measured =
      is_strip ? choice.weights->domain : measured_pixels(camera.intrinsics);
  std::vector<Seen> seen = state.finder.find(scene, camera, measured, choice.margin_px);
  state.lap("cull");
  state.draw_image(scene, camera, choice, seen, frame);
  state.target->read(!state.color_apart, frame);
  if (state.options.semantic) split_classes(*state.population, scene, frame);
  state.lap("read back");
  if (state.quality.smooth_edges && !state.multisample) smooth_edges(frame);
  state.lap("smooth");
  const RenderOptions& options = state.options;
  if (choice.truth && (options.normals || options.flow || options.flow_backward || options.parts)) {
    state.draw_surfaces(scene, next, choice.previous, seen, frame);
    state.lap("surfaces");
  }
  if (choice.truth && options.hazard_opacity) {
    state.draw_opacity(scene, frame);
    state.lap("opacity");
  }
  if (choice.truth) {
    state.coverage.measure(state.people_pass, scene, frame, measured, choice.weights,
                           options.whole_masks, seen);
  }
  check_gl("drawing a frame");
  frame.people.reserve(seen.size());
  for (Seen& person : seen) {
    if (person.is_listed) frame.people.push_back(std::move(person.truth));
  }
  state.lap("coverage");
  return frame;
}

double Renderer::metered_gain(const Scene& scene, const camera::Camera& camera) {
  State& state = *state_;
  state.context.make_current();
  const Frame& image = state.draw_metered(scene, metering_camera(camera));
  check_gl("metering a frame");
  return metering_gain(image.rgb, metered_lightness(state.daylight.illuminance_lux),
                       state.daylight.film_black);
}

std::span<const Vehicle> Renderer::vehicles() const { return state_->vehicles; }

std::span<const SkinPoint> Renderer::head_points(std::uint32_t character, std::size_t level) const {
  return state_->finder.head_points(character, level);
}

double Renderer::illuminance_lux() const { return state_->daylight.illuminance_lux; }

void Renderer::recycle(Frame&& frame) { state_->spare = std::move(frame); }

std::string Renderer::device_description() const { return state_->context.description(); }

}  // namespace throng::render
