// A file of its own: only it is compiled again in another checkout, all else comes from ccache.
#include "base/files/resources.h"

namespace throng {

std::filesystem::path source_folder() { return THRONG_SOURCE_FOLDER; }

}  // namespace throng
