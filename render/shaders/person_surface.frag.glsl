// Surface properties of a person beyond color: normal, motion to the next frame, body part.
in vec3 normal;
in vec3 next;
in vec2 uv;
flat in uvec2 surface;
flat in uint is_next;

layout(binding = 0) uniform sampler2DArray textures;

layout(location = 0) out vec4 normal_out;  // 128 + 127 n, of 255
layout(location = 1) out vec4 flow;  // px, right and down, then depth in the next frame; NaN where unknown
layout(location = 2) out uint body_part;

void main() {
#ifdef ALPHA_TEST
  if (texture(textures, vec3(uv, float(surface.x))).a < 0.5) discard;
#endif
  vec3 n = normalize(gl_FrontFacing ? normal : -normal);  // hair is rendered from both sides
  normal_out = vec4((n * 127.0 + 128.0) / 255.0, 1.0);
  bool known = is_next != 0u && next.z >= 0.001;  // kNear of view.glsl
  flow = known ? vec4(next.xy / next.z - gl_FragCoord.xy, next.z, 0.0)
               : vec4(uintBitsToFloat(0x7FC00000u));
  body_part = surface.y;
}
