// The moving image of a screen beside a stage, as a camera that shows the band sends it; `p` counts in
// heights of the screen.

float ellipse(vec2 p, vec2 radii) { return smoothstep(1.12, 0.88, length(p / radii)); }

vec3 screen_image(vec2 p, float time_s) {
  // Colored light behind the band: soft beams from above through haze.
  float mood = 0.5 + 0.5 * sin(0.13 * time_s);
  float haze = 0.75 + 0.5 * noise(3.0 * p + vec2(0.2 * time_s, 0.0));
  vec3 back = haze * mix(vec3(0.02, 0.03, 0.20), vec3(0.24, 0.02, 0.15), clamp(0.7 * p.y + 0.5 * mood - 0.2, 0.0, 1.0));
  float beam = abs(fract(p.x * 1.3 + 0.45 * (1.1 - p.y) * sin(0.5 * time_s)) - 0.5);
  vec3 shown = back + haze * vec3(0.42, 0.38, 0.62) * (smoothstep(0.22, 0.0, beam) * clamp(p.y - 0.1, 0.0, 1.0));
  // A musician in each part, from the chest up, lit from the side.
  float part = floor(p.x / 0.92);
  vec2 sway = vec2(0.018 * sin(1.7 * time_s + 2.0 * part), 0.008 * sin(3.4 * time_s + part));
  vec2 at = vec2(p.x - 0.92 * part - 0.44, p.y - 0.66) + sway;
  at.x *= fract(0.5 * part) < 0.25 ? 1.0 : -1.0;
  float side = smoothstep(-0.12, 0.10, at.x);
  vec3 cloth = mix(vec3(0.015, 0.015, 0.02), vec3(0.10, 0.03, 0.035), fract(0.61 * part));
  vec3 skin = vec3(0.40, 0.22, 0.15);
  vec3 glow = mix(vec3(0.35, 0.15, 0.45), vec3(1.25, 1.05, 0.95), side);
  float body = max(ellipse(at + vec2(0.0, 0.47), vec2(0.27, 0.30)), ellipse(at + vec2(0.0, 0.24), vec2(0.20, 0.07)));
  shown = mix(shown, cloth * (0.6 + glow), body);
  shown = mix(shown, 0.7 * skin * glow, ellipse(at + vec2(0.0, 0.15), vec2(0.042, 0.07)));
  shown = mix(shown, vec3(0.03, 0.02, 0.015) * (1.0 + glow), ellipse(at - vec2(0.0, 0.018), vec2(0.098, 0.118)));
  float face = ellipse(at + vec2(-0.012, 0.022), vec2(0.074, 0.098));
  float eyes = ellipse(vec2(abs(at.x - 0.014) - 0.03, at.y + 0.005), vec2(0.016, 0.009));
  float mouth = ellipse(at + vec2(-0.014, 0.078), vec2(0.024, 0.012 + 0.008 * sin(5.0 * time_s + part)));
  shown = mix(shown, skin * glow * (1.0 - 0.6 * max(eyes, mouth)), face);
  // A microphone before the mouth, and an arm that holds it.
  vec2 hand = at + vec2(-0.05, 0.125);
  shown = mix(shown, 0.8 * skin * glow, ellipse(hand, vec2(0.034, 0.034)));
  shown = mix(shown, vec3(0.05, 0.05, 0.06), ellipse(hand - vec2(-0.012, 0.042), vec2(0.018, 0.026)));
  float arm = abs(hand.x - 0.10 + 0.35 * (hand.y + 0.13));
  return mix(shown, cloth * (0.6 + glow), smoothstep(0.045, 0.03, arm) * step(hand.y, -0.02) * step(-0.26, hand.y));
}
