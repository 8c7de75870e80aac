// A streak of light: brightest in its middle, and where it begins.
in vec2 on_strip;
in float distance_m;
flat in vec4 streak;

layout(location = 0) out vec4 color;

void main() {
  float across = 1.0 - on_strip.y * on_strip.y;
  float left = mix(1.0, streak.a, on_strip.x);
  // Beams widen and are seen through the haze: what they show falls off faster than their light.
  float along = left * left * mix(1.0, left, 0.5);
  // A camera within a beam sees little haze before it.
  float apart = streak.a < 1.0 ? smoothstep(3.0, 22.0, distance_m) : 1.0;
  vec3 radiance = light.lamps.rgb * streak.rgb * (across * across * along * apart);
  color = vec4(film(radiance), 1.0);
}
