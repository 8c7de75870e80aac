"""Trains a small detector of people on datasets of throng; on a CPU in minutes, on a GPU with the same command.

examples/train_detector.py bridge/dataset station/dataset -o detector.pt      # then examples/evaluate.py
"""

import learning
import networks
import throng
import torch


def tile_of(side):
    """A transform for throng.DetectionDataset: a tile and the detector's targets."""

    def transform(image, target):
        tile, left, top, is_flipped = learning.cut_tile(image, side)
        boxes = target["boxes"] - torch.tensor([left, top, left, top], dtype=torch.float32)
        if is_flipped:
            boxes = torch.stack((side - boxes[:, 2], boxes[:, 1], side - boxes[:, 0], boxes[:, 3]), 1)
        cells = side // networks.STRIDE
        return (tile, *networks.detector_targets(boxes, cells, cells))

    return transform


def main():
    given = learning.arguments("Trains a detector of people on datasets of throng.", width=32)
    torch.manual_seed(given.seed)
    dataset = learning.open_datasets(given.datasets, given.split)
    if given.images:
        dataset = dataset.sample(given.images, seed=given.seed)
    learning.check_tile(dataset, given)
    people = dataset.filter_annotations(min_visibility=learning.MIN_VISIBILITY, min_height_px=learning.MIN_HEIGHT_PX)
    samples = throng.DetectionDataset(people, transform=tile_of(given.tile))
    learning.train("detector", samples, networks.detector_loss, given, {"images": len(dataset)})


if __name__ == "__main__":
    learning.finish(main)
