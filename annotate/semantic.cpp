#include "annotate/semantic.h"

#include <algorithm>
#include <vector>

#include "annotate/png.h"

namespace throng::annotate {

std::string semantic_png(const render::Frame& frame) {
  thread_local std::vector<std::uint8_t> classes;
  classes.resize(frame.id.size());
  std::transform(frame.id.begin(), frame.id.end(), classes.begin(),
                 [](std::uint32_t id) { return static_cast<std::uint8_t>(semantic_class(id)); });
  return png_bytes({frame.width(), frame.height(), 1}, classes);
}

}  // namespace throng::annotate
