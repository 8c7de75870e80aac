// The license of generated images and labels, as datasets state it.
#pragma once

#include <string_view>

namespace throng::annotate {

/// SPDX identifier of the license of images and labels. Imported characters and a scenario's mesh
/// files keep their own licenses.
inline constexpr std::string_view kImageLicense = "CC0-1.0";

/// The list `licenses` of COCO files, as JSON.
inline constexpr std::string_view kCocoLicenses =
    R"([{"id":1,"name":"CC0-1.0","url":"https://creativecommons.org/publicdomain/zero/1.0/"}])";

}  // namespace throng::annotate
