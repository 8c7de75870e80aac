#include "render/people/distant_pass.h"

#include <algorithm>
#include <array>
#include <memory>

#include "render/gl/shaders.h"
#include "skinning/levels.h"

namespace throng::render {

namespace {

/// A corner of a tile, in pixels.
using TileCorner = std::array<std::uint16_t, 2>;

/// Two triangles a tile.
std::vector<TileCorner> tile_corners(const std::vector<Eigen::Vector2i>& tiles) {
  constexpr int kSide = DistantPainter::kTilePx;
  constexpr std::array<std::array<int, 2>, 6> kCornersOfTile = {
      {{0, 0}, {kSide, 0}, {0, kSide}, {0, kSide}, {kSide, 0}, {kSide, kSide}}};
  std::vector<TileCorner> corners;
  corners.reserve(tiles.size() * kCornersOfTile.size());
  for (const Eigen::Vector2i& tile : tiles) {
    for (const auto& [x, y] : kCornersOfTile) {
      corners.push_back(
          {static_cast<std::uint16_t>(tile.x() + x), static_cast<std::uint16_t>(tile.y() + y)});
    }
  }
  return corners;
}

template <typename T>
void upload_to(const Buffer& buffer, const std::vector<T>& content) {
  glNamedBufferData(buffer.name(), static_cast<GLsizeiptr>(content.size() * sizeof(T)),
                    content.data(), GL_STREAM_DRAW);
}

}  // namespace

DistantPass::DistantPass(const skinning::Population& population, const PeopleMeshes& meshes,
                         const ProbeGrid& air, bool shadowed, std::string_view words)
    : population_(&population),
      air_(&air),
      corners_(make_buffer()),
      array_(make_vertex_array()),
      program_(make_program({embedded::shader_view, embedded::shader_distant_vert},
                            {words, shadowed ? "#define SHADOWED\n" : "", embedded::shader_light,
                             embedded::shader_distant_frag})) {
  for (const PackedMesh& mesh : meshes.distant) meshes_.push_back(distant_mesh(mesh));
  describe_vertices(array_, 0, corners_, sizeof(TileCorner), 0,
                    {{0, 2, GL_UNSIGNED_SHORT, false, 0}});
  check_gl("loading people in the distance");
}

void DistantPass::paint(const Scene& scene, const camera::Camera& camera,
                        const Eigen::Vector3f& sun, const Measured& measured,
                        std::vector<Seen>& seen) {
  painter_.begin(camera, sun);
  PaintedShape shape;
  for (Seen& person : seen) {
    if (person.draw.level < skinning::kDistantLevel || !person.is_listed ||
        person.draw.shading != Shading::by_corners) {
      continue;
    }
    const PersonInstance& instance = scene.people[person.draw.person];
    const std::uint32_t character = instance.appearance.character;
    const skinning::PoseBlend pose = drawn_pose(instance.pose, person.draw.level);
    person.is_painted = painter_.paint(
        {meshes_[character], population_->palette(character, pose.a), instance.appearance,
         Stance(instance), air_->at(light_point(instance.position)), id_of_agent(instance.agent)},
        shape);
    if (!person.is_painted) continue;
    if (measured.areas) person.truth.amodal_area_px = shape.area(measured.weights);
    if (measured.masks) person.truth.whole_mask = std::make_shared<PixelMask>(shape.mask());
  }
  upload();
}

void DistantPass::upload() {
  corner_count_ = static_cast<GLsizei>(painter_.tiles().size() * 6);
  if (corner_count_ == 0) return;
  upload_to(corners_, tile_corners(painter_.tiles()));
  const int width = painter_.width();
  const int height = painter_.height();
  if (width != texture_width_ || height != texture_height_) {
    pixels_ = make_texture_2d(GL_RGBA32UI, width, height);
    texture_width_ = width;
    texture_height_ = height;
  }
  const auto [first, last] =
      std::minmax_element(painter_.tiles().begin(), painter_.tiles().end(),
                          [](const auto& a, const auto& b) { return a.y() < b.y(); });
  const int top = first->y();
  const int rows = std::min(last->y() + DistantPainter::kTilePx, height) - top;
  static_assert(sizeof(PaintedPixel) == 16);
  glTextureSubImage2D(
      pixels_.name(), 0, 0, top, width, rows, GL_RGBA_INTEGER, GL_UNSIGNED_INT,
      &painter_.pixels()[static_cast<std::size_t>(top) * static_cast<std::size_t>(width)]);
}

void DistantPass::draw() const {
  if (corner_count_ == 0) return;
  glBindVertexArray(array_.name());
  glBindTextureUnit(6, pixels_.name());
  glDisable(GL_CULL_FACE);
  glUseProgram(program_.name());
  glDrawArrays(GL_TRIANGLES, 0, corner_count_);
}

}  // namespace throng::render
