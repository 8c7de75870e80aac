// A puff as a ball whose rim is torn, lit from above, by the sun and by fires; or a tongue of flame,
// which shines by itself. Neither has an edge where it meets the ground.
in vec3 world;
in vec2 on_disc;
flat in vec4 puff;  // albedo, opacity; of flames: heat, 0, 0, opacity + 2
flat in vec3 matter;
flat in vec2 shift;

layout(location = 0) out vec4 color;

// Opacity and heat, 0 to 1, of a tongue: pointed at the top, torn by what rises in it.
vec2 tongue() {
  float up = 0.5 - 0.5 * on_disc.y;
  vec2 rising = vec2(on_disc.x * 2.2, 2.6 * up - 2.6 * light.eye.w) + shift;
  float lick = noise(rising) + 0.5 * noise(2.3 * rising + 7.0) - 0.75;
  float half_width = 0.85 * sqrt(clamp(7.0 * up, 0.0, 1.0)) * pow(1.0 - up, 0.9) + 0.02;
  float inside = 1.0 - abs(on_disc.x + 1.1 * lick * up) / half_width;
  float torn = inside + 0.9 * lick * (0.4 + up);
  return vec2(smoothstep(0.0, 0.7, torn), clamp(torn * (1.05 - 0.8 * up), 0.0, 1.0));
}

// From dark red over orange to a yellow that the film shows as nearly white.
vec3 glow(float heat) {
  vec3 red = vec3(1.3, 0.11, 0.008);
  vec3 orange = vec3(3.6, 0.62, 0.03);
  vec3 yellow = vec3(8.0, 3.2, 0.45);
  return heat < 0.5 ? mix(red, orange, 2.0 * heat) : mix(orange, yellow, 2.0 * heat - 1.0);
}

void main() {
  bool shines = puff.a > 1.5;
  float thick;
  vec3 radiance;
  if (shines) {
    vec2 flame = tongue();
    thick = flame.x;
    radiance = glow(flame.y * puff.r);
  } else {
    float inside = 1.0 - dot(on_disc, on_disc);
    if (inside <= 0.0) discard;
    float torn = 0.6 * noise(on_disc * 2.0 + shift) + 0.4 * noise(on_disc * 5.0 + shift);
    thick = smoothstep(0.1, 0.8, inside * (0.45 + 1.1 * torn)) * smoothstep(0.0, 0.7, world.z);
    // Up in the image is up in the world, nearly.
    float up = 0.5 - 0.5 * on_disc.y;
    vec3 received = mix(light.bounce.rgb, light.sky.rgb, 0.3 + 0.7 * up);
#ifndef NO_SUN
    received += light.sun.rgb * (0.25 + 0.35 * up);
#endif
#ifdef LAMPS
    received += light.lamps.rgb * 4.0e-4;
#endif
#ifdef FIRES
    received += 0.6 * fire_light(world, vec3(0.0, 0.0, -1.0));
#endif
    radiance = puff.rgb * received;
  }
  if (thick <= 0.0) discard;
  float opacity = (shines ? puff.a - 2.0 : puff.a) * thick;
#ifdef OPACITY
  color = vec4(opacity * matter, 0.0);
#else
  color = vec4(film(through_air(radiance, world)), opacity);
#endif
}
