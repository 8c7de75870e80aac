#include "render/passes/airframe_pass.h"

#include <algorithm>

#include "render/gl/shaders.h"
#include "render/passes/prop_pass.h"

namespace throng::render {

AirframePass::AirframePass(std::string_view words, const QualitySettings& quality,
                           const ProbeGrid& air)
    : air_(air), words_(words), has_shadows_(quality.shadow_texels > 0) {}

void AirframePass::prepare() {
  if (is_prepared_) return;
  is_prepared_ = true;
  vertices_ = make_buffer();
  indices_ = make_buffer();
  array_ = make_prop_array(vertices_, indices_);
  program_ =
      make_prop_program(PropSurface::shiny, words_ + (has_shadows_ ? "" : "#define NO_SHADOWS\n"));
  check_gl("loading drones");
}

void AirframePass::draw(const std::vector<DroneInstance>& drones, const camera::Camera& camera) {
  std::vector<PropVertex> vertices;
  std::vector<std::uint32_t> indices;
  const Eigen::Vector3d eye = camera.pose.center();
  for (const DroneInstance& drone : drones) {
    if (carries(drone, eye)) continue;
    const PropMesh mesh = airframe_mesh(drone);
    const auto base = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const std::uint32_t index : mesh.indices) indices.push_back(base + index);
    for (std::size_t i = base; i < vertices.size(); ++i) {
      PropVertex& vertex = vertices[i];
      const LightField light = air_.at(Eigen::Vector3f(vertex.position.data()));
      const Eigen::Array3f received = light.received(Eigen::Vector3f(vertex.normal.data()));
      std::copy_n(received.data(), 3, vertex.light.data());
    }
  }
  if (indices.empty()) return;
  prepare();
  const auto bytes = [](const auto& values) {
    return static_cast<GLsizeiptr>(values.size() * sizeof(values.front()));
  };
  glNamedBufferData(vertices_.name(), bytes(vertices), vertices.data(), GL_STREAM_DRAW);
  glNamedBufferData(indices_.name(), bytes(indices), indices.data(), GL_STREAM_DRAW);
  glBindVertexArray(array_.name());
  glDisable(GL_CULL_FACE);
  glUseProgram(program_.name());
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(indices.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace throng::render
