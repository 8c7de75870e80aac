#include "spec/calibration/request_files.h"

namespace throng::embedded {
extern const std::string_view kCalibrationSchema;
}  // namespace throng::embedded

namespace throng::calibrate {

std::string_view request_schema() { return embedded::kCalibrationSchema; }

}  // namespace throng::calibrate
