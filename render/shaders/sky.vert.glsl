// One triangle over the whole window, infinitely far away.
out vec3 ray;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  vec2 window = view.viewport.xy + (corner + 1.0) / view.viewport.zw;
  vec2 image = (window - view.focal.zw) / view.focal.xy;
  ray = view.right.xyz * image.x + view.down.xyz * image.y + view.forward.xyz;
  gl_Position = vec4(corner, 0.0, 1.0);
}
