// The camera as the vertex shaders see it; filled by render/view.cpp.
layout(std140, binding = 0) uniform View {
  vec4 right;     // camera axes in the world
  vec4 down;
  vec4 forward;
  vec4 centre;    // of the camera, m
  vec4 focal;     // fx, fy, then the principal point in window coordinates
  vec4 viewport;  // corner in window coordinates, then 2 / size
} view;

const float kNear = 0.1;          // m; also in render/view.h
const float kSnap = 256.0;        // positions per pixel

invariant gl_Position;

// World to clip space. Depth is kNear / z (reversed, no far plane), so that z is exact. Window
// positions are rounded to the rasteriser's own grid before `shift` (whole pixels) is added: a
// triangle then covers the same pixels wherever it is moved to.
vec4 project(vec3 world, ivec2 shift) {
  vec3 d = world - view.centre.xyz;
  float z = dot(view.forward.xyz, d);
  vec2 scaled = vec2(dot(view.right.xyz, d), dot(view.down.xyz, d)) * view.focal.xy;
  if (z < kNear) {  // will be clipped, and has no window position
    vec2 window_z = scaled + (view.focal.zw + vec2(shift) - view.viewport.xy) * z;
    return vec4(window_z * view.viewport.zw - z, kNear, z);
  }
  vec2 window = round((scaled / z + view.focal.zw) * kSnap) / kSnap + vec2(shift);
  return vec4(((window - view.viewport.xy) * view.viewport.zw - 1.0) * z, kNear, z);
}
