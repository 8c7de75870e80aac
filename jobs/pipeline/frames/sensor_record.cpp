#include "jobs/pipeline/frames/sensor_record.h"

#include <nlohmann/json.hpp>

namespace throng::jobs {

using nlohmann::json;

json sensor_record(const camera::CameraSpec& run_camera, const render::Exposed& exposed,
                   int jpeg_quality) {
  const camera::Sensor& sensor = run_camera.sensor;
  const camera::Processing& processing = run_camera.processing;
  return {{"ev", sensor.ev},
          {"white_balance_k", sensor.white_balance_k},
          {"vignette", sensor.vignette},
          {"color_shading", sensor.color_shading},
          {"iso", sensor.iso.value_or(0)},
          {"exposure_gain", exposed.gain},
          {"illuminance_lux", exposed.illuminance_lux},
          {"full_well_e", sensor.full_well_e},
          {"read_noise_e", sensor.read_noise_e},
          {"exposure_s", run_camera.exposure.exposure_s},
          {"readout_s", run_camera.exposure.readout_s},
          {"field_s", run_camera.exposure.field_s},
          {"blur_px", exposed.blur_px},
          {"samples", exposed.samples},
          {"strips", exposed.strips},
          {"processing",
           {{"point_spread_px", processing.point_spread_px},
            {"flare", processing.flare},
            {"denoising", processing.denoising},
            {"tone_mapping", processing.tone_mapping},
            {"sharpening", processing.sharpening},
            {"bits_per_px", processing.bits_per_px}}},
          {"jpeg_quality", jpeg_quality}};
}

}  // namespace throng::jobs
