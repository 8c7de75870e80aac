// The moving image of a screen beside a stage: the picture of a camera that shows the band; `p` counts
// in heights of the screen.

// How much of a soft figure with its head at `head` shows at p.
float figure(vec2 p, vec2 head, float size) {
  vec2 off = (p - head) / size;
  float skull = smoothstep(1.15, 0.85, length(off * vec2(1.25, 1.0)));
  vec2 chest = off - vec2(0.0, -2.6);
  float trunk = smoothstep(1.1, 0.8, max(abs(chest.x) / (1.5 + 0.18 * chest.y), abs(chest.y) / 1.7));
  return max(skull, trunk);
}

vec3 screen_image(vec2 p, float time_s) {
  // Colored light behind the band, in beams from above.
  float mood = 0.5 + 0.5 * sin(0.13 * time_s);
  vec3 back = mix(vec3(0.03, 0.05, 0.30), vec3(0.34, 0.03, 0.22), clamp(0.6 * p.y + 0.5 * mood - 0.1, 0.0, 1.0));
  float beam = abs(fract(p.x * 1.7 + 0.35 * (1.0 - p.y) * sin(0.5 * time_s)) - 0.5);
  vec3 shown = back + vec3(0.65, 0.55, 0.85) * (smoothstep(0.16, 0.0, beam) * clamp(p.y, 0.0, 1.0));
  // A singer near by, then musicians behind, again and again on wide screens.
  float cell = floor(p.x / 0.9);
  vec2 at = vec2(p.x - 0.9 * cell, p.y);
  float sway = 0.02 * sin(1.7 * time_s + 2.0 * cell);
  float size = fract(0.37 * cell) < 0.5 ? 0.13 : 0.085;
  vec2 head = vec2(0.42 + sway, size > 0.1 ? 0.66 : 0.56);
  float body = figure(at, head, size);
  vec3 skin = vec3(0.62, 0.36, 0.26) * (0.55 + 0.45 * smoothstep(-1.0, 1.0, (at.x - head.x) / size));
  vec3 cloth = mix(vec3(0.08, 0.08, 0.10), vec3(0.35, 0.30, 0.33), fract(0.61 * cell));
  shown = mix(shown, (at.y > head.y - 1.1 * size ? skin : cloth), body);
  return shown;
}
