// A puff as a ball whose rim is torn, lit from above, by the sun and by fires; or a tongue of flame,
// which shines by itself. Neither has an edge where it meets the ground.
in vec3 world;
in vec2 on_disc;
in vec3 off_middle;
flat in vec4 puff;  // albedo, opacity; of flames: heat, 0, 0, opacity + 2
flat in vec3 matter;
flat in vec3 above;
flat in vec3 below;
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
  // Hottest inside and below, in streaks; red where it thins out.
  float streaks = 0.55 + 0.6 * noise(vec2(3.1, 1.3) * rising + 11.0);
  return vec2(smoothstep(0.0, 0.6, torn), clamp(torn * (1.0 - 0.85 * up) * streaks, 0.0, 1.0));
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
    // Billows: two octaves, which rise within the puff.
    vec2 rising = on_disc + vec2(0.0, 0.25 * light.eye.w);
    float large = noise(rising * 2.1 + shift);
    float torn = 0.62 * large + 0.38 * noise(rising * 5.3 + shift + 3.0 * large);
    torn = clamp(0.5 + 1.8 * (torn - 0.5), 0.0, 1.0);
    float depth = inside * (0.35 + 1.3 * torn);
    thick = smoothstep(0.18, 0.5, depth) * smoothstep(0.0, 0.7, world.z);
    // Each bulges toward the eye; hollows between billows are darker, thin edges let light through.
    vec3 bulge = normalize(off_middle + sqrt(inside) * normalize(light.eye.xyz - world));
    float hollow = 0.35 + 1.3 * torn;
    float through = mix(1.2, 0.75, smoothstep(0.2, 0.8, depth));
    vec3 received = mix(below, above, 0.5 + 0.5 * bulge.z) * hollow * through;
#ifndef NO_SUN
    float facing = 0.5 + 0.5 * dot(bulge, light.sun_direction.xyz);
    received += light.sun.rgb * (0.75 * facing * facing * hollow * through);
#endif
#ifdef FIRES
    // Smoke above hides the fire from what is higher.
    const float kLitM = 3.0;
    received += (0.9 * hollow * exp(-world.z / kLitM)) * fire_light(world, vec3(0.0, 0.0, -1.0));
#endif
    // Soot is thickest above what burns.
    float soot = puff.r < 0.2 ? 0.5 + 0.5 * smoothstep(1.0, 9.0, world.z) : 1.0;
    radiance = puff.rgb * received * soot;
  }
  if (thick <= 0.0) discard;
  float opacity = (shines ? puff.a - 2.0 : puff.a) * thick;
#ifdef OPACITY
  color = vec4(opacity * matter, 0.0);
#else
  color = vec4(film(through_air(radiance, world)), opacity);
#endif
}
