// A streak of light as a strip that faces the camera.
layout(location = 0) in vec4 from;   // per instance: start and radius, m
layout(location = 1) in vec4 to;     // end and radius
layout(location = 2) in vec4 shine;  // color, and the share that the end keeps

out vec2 on_strip;  // along, 0 to 1, and across, -1 to 1
out float distance_m;  // from the camera
out float widening;    // radius here by the radius at the start
flat out vec4 streak;

void main() {
  on_strip = vec2(float(gl_VertexID >> 1), float((gl_VertexID & 1) * 2 - 1));
  streak = shine;
  vec4 place = mix(from, to, on_strip.x);
  widening = place.w / from.w;
  vec3 side = cross(to.xyz - from.xyz, place.xyz - view.center.xyz);
  side /= max(length(side), 1e-6);
  distance_m = length(place.xyz - view.center.xyz);
  gl_Position = project(place.xyz + side * (place.w * on_strip.y));
}
