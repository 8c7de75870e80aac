// The camera of the next frame; filled by render/view.cpp like the View block.
layout(std140, binding = 2) uniform NextView {
  vec4 right;
  vec4 down;
  vec4 forward;
  vec4 center;
  vec4 focal;
  vec4 viewport;
} next_view;

// World to (x z, y z, z): pixels from the principal point, times the depth.
vec3 next_seen(vec3 world) {
  vec3 d = world - next_view.center.xyz;
  return vec3(vec2(dot(next_view.right.xyz, d), dot(next_view.down.xyz, d)) * next_view.focal.xy,
              dot(next_view.forward.xyz, d));
}
