// The moving image of a screen beside a stage; `p` counts in heights of the screen.
vec3 screen_image(vec2 p, float time_s) {
  float haze = 0.6 * noise(p * 2.2 + vec2(0.2 * time_s, 0.0)) + 0.4 * noise(p * 5.1 - vec2(0.0, 0.3 * time_s));
  vec3 shown = mix(vec3(0.02, 0.04, 0.22), vec3(0.42, 0.06, 0.38), smoothstep(0.3, 0.8, haze));
  // Beams from below, and what they meet at the top.
  float beam = abs(fract(p.x * 1.4 + 0.25 * (p.y - 0.5) * sin(0.7 * time_s)) - 0.5);
  shown += vec3(0.55, 0.5, 0.75) * smoothstep(0.10, 0.0, beam) * clamp(1.2 - p.y, 0.0, 1.0);
  return shown + vec3(0.9, 0.55, 0.2) * smoothstep(0.72, 0.95, haze);
}
