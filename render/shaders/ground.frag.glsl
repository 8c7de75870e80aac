// Ground of one material; ground_albedo comes from a ground_*.glsl.
in vec3 world;
in float openness;
flat in uint id;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint instance;

void main() {
  vec3 albedo = ground_albedo(world.xy, fwidth(world.xy));
  float sun = light.sun_direction.z * sunlit(world, 0.02);
  vec3 radiance = albedo * (light.sun.rgb * sun + light.sky.rgb * openness);
  colour = vec4(film(through_air(radiance, 1.0 / gl_FragCoord.w)), 1.0);
  instance = id;
}
