// Buildings in the shadow map.
layout(location = 0) in vec3 position;

void main() {
  gl_Position = vec4(shadow_uv(position) * 2.0 - 1.0, position.z * light.shadow_slope.z, 1.0);
}
