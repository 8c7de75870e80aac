// Ground and buildings of draft images: lit corner by corner, without detail or shadows.
// ground_albedo comes from a ground_*.glsl, or stands for walls and roofs.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 3) in vec3 ambient;
layout(location = 4) in uint id_in;

out vec3 lit;
flat out uint id;

void main() {
  const vec2 kFar = vec2(1e3);  // a footprint in which all detail has its mean
  vec3 albedo = ground_albedo(position.xy, kFar);
  vec3 direct = light.sun.rgb * max(dot(normal, light.sun_direction.xyz), 0.0);
  gl_Position = project(position);
  lit = film(through_air(albedo * (direct + ambient), position));
  id = id_in;
}
