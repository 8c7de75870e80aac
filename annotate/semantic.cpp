#include "annotate/semantic.h"

#include "annotate/png.h"

namespace throng::annotate {

std::string semantic_png(const render::Frame& frame) {
  return png_bytes({frame.width(), frame.height(), 1}, frame.surface);
}

}  // namespace throng::annotate
