// Geometry lit per vertex.
in vec3 lit;
flat in uint id;

layout(location = 0) out vec4 color;
layout(location = 1) out uint instance;

void main() {
  color = vec4(lit, 1.0);
  instance = id;
  leave_silhouette();
}
