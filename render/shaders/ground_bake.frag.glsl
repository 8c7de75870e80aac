// One tile of a ground's texture; ground_albedo comes from a ground_*.glsl. Square roots are stored:
// eight bits then hold dark grounds as finely as bright ones.
uniform float texels;

layout(location = 0) out vec4 root;

void main() {
  vec2 width = vec2(kTileM / texels);
  root = vec4(sqrt(ground_albedo(gl_FragCoord.xy * width, width)), 1.0);
}
