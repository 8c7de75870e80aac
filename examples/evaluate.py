"""Scores a model of train_detector.py or train_counter.py on images it has not seen, throng's or photographs.

examples/evaluate.py detector.pt campus/dataset --split all
examples/evaluate.py detector.pt --real visdrone VisDrone2019-DET-val

Prints a JSON object: average precision (COCO's definition), or errors of counts beside those of a counter that always
says the mean count of the images that the model was trained on.
"""

import argparse
import dataclasses
import json
import math
import sys

import learning
import networks
import numpy as np
import throng
import torch
from throng.scores import DetectedImage, score_counts, score_detections


def throng_images(dataset):
    """Image, boxes of people, regions without scores, and count of each frame."""
    visible = dataset.filter_annotations(min_visibility=learning.MIN_VISIBILITY, min_height_px=learning.MIN_HEIGHT_PX)
    for frame, kept in zip(dataset, visible):
        chosen = set(kept.people.track_ids.tolist())
        others = frame.people.select([track not in chosen for track in frame.people.track_ids.tolist()])
        yield frame.image(), kept.people.boxes_xyxy, others.boxes_xyxy, learning.true_count(kept)


def real_images(images, kind):
    for image in images:
        if kind == "detector" and image.boxes is None:
            raise throng.DatasetError(f"{image.path}: found heads only, expected boxes, which a detector is scored by")
        try:
            pixels = image.image()
        except throng.DatasetError as error:
            print(f"skipped {error}", file=sys.stderr)
            continue
        yield pixels, image.boxes, image.ignored, image.count


def tensor_of(pixels, scale, device):
    """The image (3, rows, columns) from 0 to 1, resized by scale."""
    image = torch.from_numpy(np.ascontiguousarray(pixels.transpose(2, 0, 1))).to(device).float() / 255
    if scale != 1:
        smooth = {"mode": "bilinear", "antialias": scale < 1}
        image = torch.nn.functional.interpolate(image[None], scale_factor=scale, **smooth)[0]
    return image


def evaluate_detector(model, images, scale, device):
    def detected():
        for pixels, truth, ignored, _ in images:
            boxes, scores = networks.detect(model, learning.padded(tensor_of(pixels, scale, device)))[0]
            yield DetectedImage(boxes.cpu().numpy() / scale, scores.cpu().numpy(), truth, ignored)

    return dataclasses.asdict(score_detections(detected()))


@torch.no_grad()
def evaluate_counter(model, images, scale, device, mean_count):
    counted, true = [], []
    for pixels, _, _, count in images:
        image = tensor_of(pixels, scale, device)
        rows, columns = (math.ceil(side / networks.STRIDE) for side in image.shape[1:])
        counted.append(float(model(learning.padded(image))[0, 0, :rows, :columns].sum()))
        true.append(count)
    scores = dataclasses.asdict(score_counts(counted, true))
    return {**scores, "always_the_mean": dataclasses.asdict(score_counts([mean_count] * len(true), true))}


def main():
    parser = argparse.ArgumentParser(description="Scores a model on images that it has not seen.")
    parser.add_argument("model")
    parser.add_argument("datasets", nargs="*", help="datasets of throng: folders, .tar or .zip")
    parser.add_argument("--split", default="val", help="of the datasets; all: every image (of places not trained on)")
    kinds = ", ".join(sorted(throng.REAL_SETS))
    parser.add_argument("--real", nargs=2, metavar=("KIND", "FOLDER"), help=f"photographs instead; KIND: {kinds}")
    parser.add_argument("--scale", type=float, default=1.0, help="resize images by this; people as large as trained on")
    parser.add_argument("--limit", type=learning.positive, help="only so many images, evenly spread over the set")
    learning.add_machine(parser)
    given = parser.parse_args()
    if bool(given.datasets) == bool(given.real):
        parser.error("expected either datasets or --real KIND FOLDER")
    if not 0.05 <= given.scale <= 20:
        parser.error(f"--scale: found {given.scale:g}, expected 0.05 to 20")
    device = learning.device_of(given)
    model, saved = learning.load(given.model, device)
    images = throng.open_real_set(*given.real) if given.real else learning.open_datasets(given.datasets, given.split)
    if given.limit and given.limit < len(images):
        chosen = np.linspace(0, len(images) - 1, given.limit).round().astype(int)
        images = [images[int(i)] for i in chosen] if given.real else images[chosen]
    labeled = real_images(images, saved["kind"]) if given.real else throng_images(images)
    if saved["kind"] == "detector":
        scores = evaluate_detector(model, labeled, given.scale, device)
    else:
        scores = evaluate_counter(model, labeled, given.scale, device, float(saved["mean_count"]))
    trained = {"kind": saved["kind"], "trained_images": saved["images"], "steps": saved["steps"]}
    print(json.dumps({**trained, **{name: rounded(value) for name, value in scores.items()}}))


def rounded(value):
    if isinstance(value, dict):
        return {name: rounded(one) for name, one in value.items()}
    if isinstance(value, float):
        return None if math.isnan(value) else round(value, 4)
    return value


if __name__ == "__main__":
    learning.finish(main)
