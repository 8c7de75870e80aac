// People in the distance, from what the CPU painted: render/people/distant_painter.h.
in vec3 ray;

// Depth (a float's bits), id, albedo and share of sunlight, other light
layout(binding = 6) uniform usampler2D painted;

layout(location = 0) out vec4 color;
layout(location = 1) out uint instance;

const float kNear = 0.001;  // m; also in render/view.h
const float kMaxLight = 16.0;  // also in render/people/distant_painter.h

void main() {
  uvec4 paint = texelFetch(painted, ivec2(gl_FragCoord.xy), 0);
  if (paint.x == 0u) discard;
  float depth = uintBitsToFloat(paint.x);
  vec3 world = light.eye.xyz + ray * (kNear / depth);
  vec4 albedo = unpackUnorm4x8(paint.z);
  vec3 even = vec3(uvec3(paint.w, paint.w >> 10, paint.w >> 20) & 1023u) * (1.0 / 1023.0);
  vec3 received = even * even * kMaxLight;
#ifdef FIRES
  received += fire_light(world, normalize(light.eye.xyz - world));
#endif
#ifdef SHADOWED
  albedo.a *= sunlit_small(world, 0.06);
#endif
  received += light.sun.rgb * albedo.a;
  color = vec4(film(through_air(albedo.rgb * albedo.rgb * received, world)), 1.0);
  instance = paint.y;
  gl_FragDepth = depth;
}
