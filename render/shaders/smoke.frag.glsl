// A puff as a ball whose rim is torn, lit from above and by the sun; flames shine by themselves.
in vec3 world;
in vec2 on_disc;
flat in vec4 puff;
flat in vec3 matter;
flat in vec2 shift;

layout(location = 0) out vec4 color;

void main() {
  float inside = 1.0 - dot(on_disc, on_disc);
  if (inside <= 0.0) discard;
  float torn = 0.6 * noise(on_disc * 2.0 + shift) + 0.4 * noise(on_disc * 5.0 + shift);
  float thick = smoothstep(0.1, 0.8, inside * (0.45 + 1.1 * torn));
  bool shines = puff.a > 1.5;
  float opacity = (shines ? puff.a - 2.0 : puff.a) * thick;
#ifdef OPACITY
  color = vec4(opacity * matter, 0.0);
#else
  // Up in the image is up in the world, nearly.
  float up = 0.5 - 0.5 * on_disc.y;
  vec3 received = mix(light.bounce.rgb, light.sky.rgb, 0.3 + 0.7 * up);
#ifndef NO_SUN
  received += light.sun.rgb * (0.25 + 0.35 * up);
#endif
#ifdef LAMPS
  received += light.lamps.rgb * 4.0e-4;
#endif
  vec3 radiance = shines ? puff.rgb : puff.rgb * received;
  color = vec4(film(through_air(radiance, world)), opacity);
#endif
}
