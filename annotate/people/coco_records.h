// The JSON objects of a COCO file, one per line (layout: docs/formats.md).
#pragma once

#include <cstdint>
#include <string>

#include "annotate/people/coco.h"
#include "annotate/people/labels.h"

namespace throng::annotate {

/// Appends the record of an image with these labels and a line break.
void append_image_record(std::string& text, const CocoImage& image, const FrameLabels& labels);

/// A person's track_id in the file.
std::int64_t track_id(const CocoImage& image, std::uint32_t agent);

/// Appends what is true of a person all run long, and a line break.
void append_track_record(std::string& text, const CocoImage& image, std::uint32_t agent);

/// The number of a drone or vehicle, in place of people's agent number.
std::uint32_t object_number(const render::ObjectInView& object);

/// The like for a drone or vehicle.
void append_object_track_record(std::string& text, const CocoImage& image,
                                const render::ObjectInView& object);
void append_object_record(std::string& text, const CocoImage& image, const ObjectLabel& label);

/// Appends the record of a person in that image and a line break.
void append_annotation_record(std::string& text, const CocoImage& image, const PersonLabel& label);

}  // namespace throng::annotate
