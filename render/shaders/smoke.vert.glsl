// A puff of smoke, or a tongue of flame, that faces the camera.
layout(location = 0) in vec4 place;  // per instance: middle and radius, m
layout(location = 1) in vec4 look;   // albedo, opacity; of flames see smoke.frag.glsl
layout(location = 2) in float kind;  // HazardMatter
layout(location = 3) in vec3 above_in;  // light from above and from below
layout(location = 4) in vec3 below_in;

out vec3 world;
out vec2 on_disc;  // -1 to 1
out vec3 off_middle;  // the same in the world
flat out vec4 puff;
flat out vec3 matter;  // 1 in the channel of its kind
flat out vec3 above;
flat out vec3 below;
flat out vec2 shift;  // no two puffs are torn alike

void main() {
  on_disc = vec2(float((gl_VertexID & 1) * 2 - 1), float((gl_VertexID & 2) - 1));
  puff = look;
  above = above_in;
  below = below_in;
  matter = vec3(kind == 0.0, kind == 1.0, kind == 2.0);
  shift = place.xy * 3.0 + vec2(gl_InstanceID);
  // Tongues are higher than wide, seen from the side.
  float stretch = look.a > 1.5 ? 1.0 + 0.9 * abs(view.down.z) : 1.0;
  off_middle = view.right.xyz * on_disc.x + view.down.xyz * (stretch * on_disc.y);
  world = place.xyz + place.w * off_middle;
  gl_Position = project(world);
}
