"""Small fully convolutional networks of train_detector.py and train_counter.py: a detector of centers, and a density.

Both see a person by 4 x 4 pixels: outputs have a fourth of the image's rows and columns. 52 000 weights, so that
they train on a CPU in minutes; width=64 and more is for a GPU.
"""

import torch
from torch import nn
from torch.nn import functional

STRIDE = 4
# Height and width of inputs must be multiples of this.
MULTIPLE = 8
# Focal loss: most cells of the heat map are empty, so the map begins near 0.
PRIOR = 0.02


def block(inputs, outputs, stride=1, dilation=1):
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, 3, stride, dilation, dilation, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(inplace=True),
    )


class Trunk(nn.Module):
    """Features (N, width, rows / 4, columns / 4) of images (N, 3, rows, columns) from 0 to 1."""

    def __init__(self, width):
        super().__init__()
        self.fine = nn.Sequential(block(3, width // 2, 2), block(width // 2, width, 2), block(width, width))
        # Context at an eighth of the resolution: shadows, neighbors, what the place looks like.
        self.coarse = nn.Sequential(block(width, width, 2), block(width, width, dilation=2), block(width, width))
        self.join = block(width, width)

    def forward(self, images):
        fine = self.fine(images - 0.45)
        coarse = functional.interpolate(self.coarse(fine), scale_factor=2, mode="nearest")
        return self.join(fine + coarse)


class Detector(nn.Module):
    """Outputs: heat map (N, 1, h, w) as logits; log of width and height in cells (N, 2, h, w); the center's place in
    its cell (N, 2, h, w), 0 to 1. After Zhou et al., Objects as Points (2019)."""

    def __init__(self, width=32):
        super().__init__()
        self.trunk = Trunk(width)
        self.heat = nn.Conv2d(width, 1, 1)
        self.shape = nn.Conv2d(width, 4, 1)
        nn.init.constant_(self.heat.bias, float(torch.logit(torch.tensor(PRIOR))))

    def forward(self, images):
        features = self.trunk(images)
        shape = self.shape(features)
        return self.heat(features), shape[:, :2], torch.sigmoid(shape[:, 2:])


class Counter(nn.Module):
    """People per cell (N, 1, h, w); the sum is the count."""

    def __init__(self, width=32):
        super().__init__()
        self.trunk = Trunk(width)
        self.density = nn.Conv2d(width, 1, 1)
        nn.init.constant_(self.density.bias, -4.0)

    def forward(self, images):
        return functional.softplus(self.density(self.trunk(images)))


KINDS = {"detector": Detector, "counter": Counter}


def detector_targets(boxes, rows, columns):
    """Heat (1, rows, columns), shape (4, rows, columns) and where it is known (1, rows, columns), of boxes (N, 4) in
    pixels of the image. Heat is 1 at centers and falls off as a Gaussian as wide as a sixth of the box."""
    heat, shape, known = torch.zeros(1, rows, columns), torch.zeros(4, rows, columns), torch.zeros(1, rows, columns)
    cells = boxes / STRIDE
    center, size = (cells[:, :2] + cells[:, 2:]) / 2, (cells[:, 2:] - cells[:, :2]).clamp(min=0.25)
    y, x = torch.arange(rows)[:, None] + 0.5, torch.arange(columns)[None] + 0.5
    for (cx, cy), (width, height) in zip(center.tolist(), size.tolist()):
        column, row = int(cx), int(cy)
        if not (0 <= row < rows and 0 <= column < columns and cx >= 0 and cy >= 0):
            continue
        sx, sy = max(width / 6, 0.4), max(height / 6, 0.4)
        bump = torch.exp(-((x - column - 0.5) ** 2) / (2 * sx**2) - (y - row - 0.5) ** 2 / (2 * sy**2))
        heat[0] = torch.maximum(heat[0], bump)
        size_log = torch.log(torch.tensor([width, height]))
        shape[:, row, column] = torch.cat((size_log, torch.tensor([cx - column, cy - row])))
        known[0, row, column] = 1
    return heat, shape, known


def detector_loss(outputs, heat, shape, known):
    """Focal loss of the heat map, as CornerNet's, and absolute errors of sizes and places at centers."""
    logits, size, place = outputs
    people = known.sum().clamp(min=1)
    chance = torch.sigmoid(logits).clamp(1e-4, 1 - 1e-4)
    found = -torch.log(chance) * (1 - chance) ** 2 * (heat == 1)
    empty = -torch.log(1 - chance) * chance**2 * (1 - heat) ** 4 * (heat < 1)
    shape_error = (torch.cat((size, place), 1) - shape).abs() * known
    return ((found + empty).sum() + 0.5 * shape_error.sum()) / people


@torch.no_grad()
def detect(model, images, limit=500, threshold=0.02):
    """For each image of a batch: boxes (N, 4) in pixels and scores (N,), by falling scores. Neighboring maxima of the
    heat map are one person."""
    logits, size, place = model(images)
    chance = torch.sigmoid(logits)
    peaks = chance * (functional.max_pool2d(chance, 3, 1, 1) == chance)
    columns = peaks.shape[-1]
    found = []
    for peak, sides, corner in zip(peaks[:, 0], size, place):
        scores, at = peak.flatten().topk(min(limit, peak.numel()))
        at = at[scores > threshold]
        cell = torch.stack((at % columns, torch.div(at, columns, rounding_mode="floor")), 1)
        middle = cell + corner.flatten(1)[:, at].T
        half = sides.flatten(1)[:, at].clamp(-3, 6).exp().T / 2
        found.append((torch.cat((middle - half, middle + half), 1) * STRIDE, scores[scores > threshold]))
    return found
