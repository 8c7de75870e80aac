// A streak of light: brightest in its middle, and where it begins.
in vec2 on_strip;
in float distance_m;
in float widening;
flat in vec4 streak;

layout(location = 0) out vec4 color;

void main() {
  float across = 1.0 - on_strip.y * on_strip.y;
  bool is_beam = streak.a < 1.0;
  float length_left = mix(1.0, streak.a, on_strip.x);
  // The light of a beam is spread over its section, whose width the eye looks through.
  float along = is_beam ? length_left / widening : 4.0 * on_strip.x * (1.0 - on_strip.x);
  // A camera within a beam sees little haze before it.
  float apart = is_beam ? smoothstep(3.0, 22.0, distance_m) : 1.0;
  float soft = across * across * (is_beam ? across : 1.0);
  vec3 radiance = light.lamps.rgb * streak.rgb * (soft * along * apart);
  color = vec4(film(radiance), 1.0);
}
