#include "places/imports/sdf/description_file.h"

#include <cstdint>
#include <system_error>

#include "base/error.h"
#include "base/files/files.h"

namespace throng::imports {

std::string read_description(const std::filesystem::path& file, const std::string& expected) {
  constexpr std::uintmax_t kMaxFileBytes = 32U << 20U;
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) throw InputError({file.string(), "", "no file", expected});
  if (bytes > kMaxFileBytes) {
    throw InputError({file.string(), "", "a file of more than 32 MB", expected});
  }
  return read_file(file);
}

}  // namespace throng::imports
