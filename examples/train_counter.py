"""Trains a small network that counts people by their density; on a CPU in minutes, on a GPU with the same command.

examples/train_counter.py bridge/dataset station/dataset -o counter.pt      # then examples/evaluate.py
"""

import learning
import networks
import throng
import torch
from torch.nn import functional

# A cell holds a few hundredths of a person: scaled, so that errors are of the size of 1.
SCALE = 100.0


def tile_of(side):
    """A transform for throng.CountingDataset: a tile and its people per cell."""

    def transform(image, target):
        tile, left, top, is_flipped = learning.cut_tile(image, side)
        density = target["density"][:, top : top + side, left : left + side]
        density = functional.pad(density, (0, side - density.shape[2], 0, side - density.shape[1]))
        if is_flipped:
            density = density.flip(2)
        return tile, functional.avg_pool2d(density, networks.STRIDE) * networks.STRIDE**2

    return transform


def loss_of(density, wanted):
    """Squared errors of cells, and the error of the tile's count, which is what is asked for."""
    cells = functional.mse_loss(density * SCALE, wanted * SCALE)
    count = (density.sum((1, 2, 3)) - wanted.sum((1, 2, 3))).abs().mean()
    return cells / SCALE + 0.1 * count


def main():
    given = learning.arguments("Trains a network that counts people on datasets of throng.", width=32)
    torch.manual_seed(given.seed)
    dataset = learning.open_datasets(given.datasets, given.split)
    if given.images:
        dataset = dataset.sample(given.images, seed=given.seed)
    learning.check_tile(dataset, given)
    visible = dataset.filter_annotations(min_visibility=learning.MIN_VISIBILITY, min_height_px=learning.MIN_HEIGHT_PX)
    counts = throng.CountingDataset(visible, transform=tile_of(given.tile))
    # evaluate.py compares with a counter that always says the mean count of the images trained on.
    mean = sum(learning.true_count(frame) for frame in visible) / len(visible)
    learning.train("counter", counts, loss_of, given, {"images": len(dataset), "mean_count": torch.tensor(mean)})


if __name__ == "__main__":
    learning.finish(main)
