// The JSON objects of a COCO file, one per line (layout: docs/formats.md).
#pragma once

#include <cstdint>
#include <string>

#include "annotate/people/coco_image.h"
#include "annotate/people/frame_labels.h"

namespace throng::annotate {

/// Appends the record of an image with these labels and a line break.
void append_image_record(std::string& text, const CocoImage& image, const FrameLabels& labels);

/// The track_id of an agent in the image's run.
std::int64_t track_id(const CocoImage& image, std::uint32_t agent);

/// Appends the record of a person's constant attributes and a line break.
void append_track_record(std::string& text, const CocoImage& image, std::uint32_t agent);

/// The number of a drone or vehicle that takes the part of an agent id in annotation and track ids.
std::uint32_t object_number(const render::ObjectInView& object);

/// Append the track record and the annotation record of a drone or vehicle, each with a line break.
void append_object_track_record(std::string& text, const CocoImage& image,
                                const render::ObjectInView& object);
void append_object_record(std::string& text, const CocoImage& image, const ObjectLabel& label);

/// Appends the annotation record of a person in the image and a line break.
void append_annotation_record(std::string& text, const CocoImage& image, const PersonLabel& label);

}  // namespace throng::annotate
