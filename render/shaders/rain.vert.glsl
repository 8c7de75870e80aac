// A drop's streak, as a strip of two triangles across the image. No two frames have the same drops.
uniform uint salt;    // of the frame
uniform vec2 image;   // width and height, px

out float share;  // of the light behind it that a drop replaces

const float kLength = 0.13;   // m: 8 m/s for 1/60 s
const float kWidth = 0.0024;  // m
const vec3 kSlant = vec3(0.11, 0.06, 1.0);

void main() {
  ivec2 cell = ivec2(gl_InstanceID, int(salt >> 8u));
  vec2 at = vec2(hash(cell), hash(cell + ivec2(0, 1013))) * image;
  // Equally many in every volume of the view, from 1.5 to 11 m.
  float z = 1.5 + 9.5 * pow(hash(cell + ivec2(0, 2027)), 0.5);
  vec2 plane = (at - view.focal.zw) / view.focal.xy;
  vec3 drop = view.center.xyz + z * (view.right.xyz * plane.x + view.down.xyz * plane.y +
                                     view.forward.xyz);
  vec3 head = seen(drop);
  vec3 tail = seen(drop + kLength * kSlant);
  vec2 a = head.xy / head.z;
  vec2 b = tail.xy / max(tail.z, 0.5);
  vec2 along = b - a;
  vec2 across = vec2(-along.y, along.x) / max(length(along), 1e-3);
  float width = view.focal.x * kWidth / z;
  // A streak thinner than a pixel covers a share of it.
  share = 0.42 * min(width, 1.0);
  float side = (gl_VertexID & 1) == 0 ? -0.5 : 0.5;
  vec2 window = view.focal.zw + (gl_VertexID < 2 ? a : b) + across * max(width, 1.0) * side;
  gl_Position = vec4(((window - view.viewport.xy) * view.viewport.zw - 1.0) * z, kNear, z);
}
