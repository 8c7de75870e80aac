// Whatever has been lit corner by corner.
in vec3 lit;
flat in uint id;

layout(location = 0) out vec4 colour;
layout(location = 1) out uint instance;

void main() {
  colour = vec4(lit, 1.0);
  instance = id;
  leave_silhouette();
}
