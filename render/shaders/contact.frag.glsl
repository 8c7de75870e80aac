// Less of the sky reaches the ground beside something that stands on it.
in vec3 world;
in vec2 from_middle;
flat in vec4 extent;
flat in float rounding;

layout(location = 0) out vec4 color;

void main() {
  float away = max(length(max(abs(from_middle) - extent.xy + rounding, 0.0)) - rounding, 0.0);
  float near = max(1.0 - away / extent.z, 0.0);
  // The air before it shines all the same.
  color = vec4(film(through_air(vec3(0.0), world)), extent.w * near * near);
}
