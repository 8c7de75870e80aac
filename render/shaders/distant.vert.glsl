// A tile of the image that shows people in the distance.
layout(location = 0) in uvec2 pixel;  // its corner

out vec3 ray;  // from the camera to a point at z = 1

void main() {
  vec2 corner = vec2(pixel);
  vec2 at = (corner - view.focal.zw) / view.focal.xy;
  ray = view.forward.xyz + view.right.xyz * at.x + view.down.xyz * at.y;
  gl_Position = vec4((corner - view.viewport.xy) * view.viewport.zw - 1.0, 0.5, 1.0);
}
