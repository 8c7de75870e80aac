#include "spec/job/airframe_camera.h"

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "spec/job/camera_fields.h"

namespace throng::jobs {

using nlohmann::json;

json with_airframe_camera(const json& drone, const FieldLocation& place) {
  const auto airframe = drone.find("airframe");
  if (airframe == drone.end() || !airframe->is_object() || !airframe->contains("camera")) {
    return drone;
  }
  json camera = airframe->at("camera");
  const FieldLocation camera_place = place.below("airframe").below("camera");
  CameraSpec own;
  const std::size_t before = camera_place.problems.size();
  camera_fields().read_checked(camera, own, camera_place);
  if (camera_place.problems.size() > before) return drone;
  const json given = drone.value("camera", json::object());
  if (given.contains("preset") || given.contains("calibration")) {
    for (const char* field : calibrated_fields()) camera.erase(field);
  }
  // Both say how wide the lens is.
  if (given.contains("hfov_deg")) {
    for (const char* field : {"fx_px", "fy_px", "cx_px", "cy_px"}) camera.erase(field);
  }
  if (given.contains("fx_px")) camera.erase("hfov_deg");
  camera.merge_patch(given);
  json completed = drone;
  completed["camera"] = std::move(camera);
  return completed;
}

}  // namespace throng::jobs
