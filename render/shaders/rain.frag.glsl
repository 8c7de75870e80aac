// A drop shows the sky.
in float share;

layout(location = 0) out vec4 color;

void main() { color = vec4(film(light.sky.rgb * 0.9 + light.haze.rgb * 0.25), share); }
