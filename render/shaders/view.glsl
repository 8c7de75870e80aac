// The camera as the vertex shaders see it; filled by render/view.cpp.
layout(std140, binding = 0) uniform View {
  vec4 right;     // camera axes in the world
  vec4 down;
  vec4 forward;
  vec4 center;    // of the camera, m
  vec4 focal;     // fx, fy, then the principal point in window coordinates
  vec4 viewport;  // corner in window coordinates, then 2 / size
} view;

const float kNear = 0.001;        // m; also in render/view.h
const float kSnap = 256.0;        // positions per pixel

invariant gl_Position;

// World to (x z, y z, z): pixels from the principal point, times the depth.
vec3 seen(vec3 world) {
  vec3 d = world - view.center.xyz;
  return vec3(vec2(dot(view.right.xyz, d), dot(view.down.xyz, d)) * view.focal.xy,
              dot(view.forward.xyz, d));
}

// World to clip space. Depth is kNear / z (reversed, no far plane), so that z is exact.
vec4 project(vec3 world) {
  vec3 p = seen(world);
  vec2 window_z = p.xy + (view.focal.zw - view.viewport.xy) * p.z;
  return vec4(window_z * view.viewport.zw - p.z, kNear, p.z);
}

// The same, moved by whole pixels. The window position is first rounded to the rasterizer's own
// grid: a triangle then covers the same pixels wherever, and in whichever viewport, it is rendered.
vec4 project_movable(vec3 world, ivec2 shift) {
  vec3 p = seen(world);
  if (p.z < kNear) {  // will be clipped, and has no window position
    vec2 window_z = p.xy + (view.focal.zw + vec2(shift) - view.viewport.xy) * p.z;
    return vec4(window_z * view.viewport.zw - p.z, kNear, p.z);
  }
  vec2 window = round((p.xy / p.z + view.focal.zw) * kSnap) / kSnap + vec2(shift);
  return vec4(((window - view.viewport.xy) * view.viewport.zw - 1.0) * p.z, kNear, p.z);
}
