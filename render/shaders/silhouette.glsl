// With SILHOUETTES every fragment of a person, hidden or not, also marks its pixel in their own
// tile of an atlas (render/truth/silhouettes.h).
#ifdef SILHOUETTES
flat in ivec2 to_tile;  // pixels
layout(r8, binding = 0) writeonly uniform image2D silhouettes;

void leave_silhouette() {
  imageStore(silhouettes, ivec2(gl_FragCoord.xy) + to_tile, vec4(1.0));
}
#else
void leave_silhouette() {}
#endif
