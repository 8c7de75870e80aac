"""Networks from nothing but torch: a detector of people of all sizes, and a counter by density.

Both see an image at a fourth of its resolution and, through layers at an eighth to a thirty-second, what surrounds a place:
a person of 300 px is as much in their sight as one of 10.
"""

from __future__ import annotations

from typing import Any

from .._optional import require

torch = require("torch", "throng.train")
nn, functional = torch.nn, torch.nn.functional
Module: Any = nn.Module

STRIDE = 4
MULTIPLE = 32
"""Heights and widths that go through a network are multiples of this."""
# Focal loss: most cells of the heat map are empty, so the map begins near 0.
_PRIOR = 0.02
# A cell holds a few hundredths of a person: scaled, so that errors are of the size of 1.
_DENSITY_SCALE = 100.0
_MAX_PEOPLE = 500
_MIN_SCORE = 0.02


def _block(inputs: int, outputs: int, stride: int = 1, dilation: int = 1) -> Any:
    return nn.Sequential(
        nn.Conv2d(inputs, outputs, 3, stride, dilation, dilation, bias=False),
        nn.BatchNorm2d(outputs),
        nn.ReLU(inplace=True),
    )


class _Trunk(Module):  # type: ignore[misc]
    """Features (N, width, rows / 4, columns / 4) of images (N, 3, rows, columns) from 0 to 1."""

    def __init__(self, width: int) -> None:
        super().__init__()
        self.stem = nn.Sequential(_block(3, width // 2, 2), _block(width // 2, width, 2), _block(width, width))
        sides = [width, 3 * width // 2, 2 * width, 3 * width]
        self.down = nn.ModuleList(
            nn.Sequential(_block(a, b, 2), _block(b, b, dilation=2 if b == sides[-1] else 1), _block(b, b))
            for a, b in zip(sides, sides[1:])
        )
        self.up = nn.ModuleList(_block(b + a, a) for a, b in zip(sides, sides[1:]))

    def forward(self, images: Any) -> Any:
        # Brightness and contrast of a photograph are its own: they are taken out of each image.
        middle = images.mean((1, 2, 3), keepdim=True)
        levels = [self.stem((images - middle) / images.std((1, 2, 3), keepdim=True).clamp(min=0.05))]
        for down in self.down:
            levels.append(down(levels[-1]))
        features = levels.pop()
        for up in reversed(self.up):
            fine = levels.pop()
            features = up(torch.cat((functional.interpolate(features, scale_factor=2, mode="nearest"), fine), 1))
        return features


class Detector(Module):  # type: ignore[misc]
    """A heat map of middles of people, and in each cell the distances to the four sides of the box. After Zhou et al., Objects
    as Points (2019); every cell near a middle learns the box, as in Liu et al., Training-Time-Friendly Network (2020).
    """

    def __init__(self, width: int = 24) -> None:
        super().__init__()
        self.trunk = _Trunk(width)
        self.heat = nn.Sequential(_block(width, width), nn.Conv2d(width, 1, 1))
        self.sides = nn.Sequential(_block(width, width), nn.Conv2d(width, 4, 1))
        nn.init.constant_(self.heat[-1].bias, float(torch.logit(torch.tensor(_PRIOR))))
        nn.init.constant_(self.sides[-1].bias, 1.0)

    def forward(self, images: Any) -> Any:
        features = self.trunk(images)
        return self.heat(features)[:, 0], _boxes_of(self.sides(features).clamp(-4, 6).exp())

    def loss(self, images: Any, people: list[Any]) -> Any:
        """people: of each image (N, 5), x0, y0, x1, y1 in pixels, and 0 where nothing is asked for."""
        logits, boxes = self(images)
        heat, wanted, weight, asked = (
            torch.stack(part).to(images.device)
            for part in zip(*(_targets(each.cpu(), *logits.shape[1:]) for each in people))
        )
        chance = torch.sigmoid(logits).clamp(1e-4, 1 - 1e-4)
        found = -torch.log(chance) * (1 - chance) ** 2 * (heat == 1)
        empty = -torch.log(1 - chance) * chance**2 * (1 - heat) ** 4 * (heat < 1) * asked
        misfit = (1 - _giou(boxes, wanted)) * weight
        # Each tile counts as much, whether it shows a crowd or nobody.
        count = (heat == 1).sum((1, 2)).clamp(min=1)
        return ((found + empty + 2 * misfit).sum((1, 2)) / count).mean()

    def detect(self, images: Any) -> list[Any]:
        """Of each image boxes (N, 4) in pixels and scores (N,), by falling scores."""
        logits, boxes = self(images)
        chance = torch.sigmoid(logits)
        peaks = chance * (functional.max_pool2d(chance[:, None], 3, 1, 1)[:, 0] == chance)
        found = []
        for peak, sides in zip(peaks.flatten(1), boxes.flatten(2)):
            scores, at = peak.topk(min(_MAX_PEOPLE, len(peak)))
            at, scores = at[scores > _MIN_SCORE], scores[scores > _MIN_SCORE]
            found.append((sides[:, at].T, scores))
        return found


class Counter(Module):  # type: ignore[misc]
    """People per cell, whose sum is the count; the wide view is that of Li et al., CSRNet (2018), by coarser layers."""

    def __init__(self, width: int = 24) -> None:
        super().__init__()
        self.trunk = _Trunk(width)
        self.density = nn.Conv2d(width, 1, 1)
        nn.init.constant_(self.density.bias, -4.0)

    def forward(self, images: Any) -> Any:
        return functional.softplus(self.density(self.trunk(images)))[:, 0]

    def loss(self, images: Any, people: list[Any]) -> Any:
        """people: of each image heads (N, 2) in pixels. Squared errors of cells, and the error of the count, which is asked for."""
        density = self(images)
        wanted = torch.stack([_density(heads, *density.shape[1:]) for heads in people]).to(images.device)
        cells = functional.mse_loss(density * _DENSITY_SCALE, wanted * _DENSITY_SCALE)
        count = (density.sum((1, 2)) - wanted.sum((1, 2))).abs().mean()
        return cells / _DENSITY_SCALE + 0.1 * count


def _boxes_of(sides: Any) -> Any:
    """Boxes (N, 4, h, w) in pixels of distances (N, 4, h, w) in cells: left, up, right, down."""
    x = torch.arange(sides.shape[3], device=sides.device) + 0.5
    y = torch.arange(sides.shape[2], device=sides.device)[:, None] + 0.5
    return STRIDE * torch.stack((x - sides[:, 0], y - sides[:, 1], x + sides[:, 2], y + sides[:, 3]), 1)


def _targets(people: Any, rows: int, columns: int) -> tuple[Any, Any, Any, Any]:
    """Heat (rows, columns), 1 at middles and falling as a Gaussian as wide as a sixth of the box; the box (4, rows, columns) of
    whose heat is highest, in pixels; how much it counts, as much for small people as for large; and where heat is asked for.
    """
    boxes = people[people[:, 4] > 0, :4]
    asked = torch.ones(rows, columns)
    for x0, y0, x1, y1 in (people[people[:, 4] == 0, :4] / STRIDE).tolist():
        asked[int(y0) : int(y1) + 1, int(x0) : int(x1) + 1] = 0
    heat, weight = torch.zeros(rows, columns), torch.zeros(rows, columns)
    wanted = torch.zeros(4, rows, columns)
    middle = (boxes[:, :2] + boxes[:, 2:]) / 2 / STRIDE
    sigma = ((boxes[:, 2:] - boxes[:, :2]) / STRIDE / 6).clamp(min=0.4)
    y, x = torch.arange(rows)[:, None], torch.arange(columns)[None]
    for i, ((cx, cy), (sx, sy)) in enumerate(zip(middle.tolist(), sigma.tolist())):
        if not (0 <= cx < columns and 0 <= cy < rows):
            continue
        bump = torch.exp(-((x - int(cx)) ** 2) / (2 * sx**2) - (y - int(cy)) ** 2 / (2 * sy**2))
        mine = bump > heat
        heat = torch.where(mine, bump, heat)
        mine = mine & (bump > 0.3)
        wanted[:, mine] = boxes[i][:, None]
        weight[mine] = bump[mine] / bump[bump > 0.3].sum()
    return heat, wanted, weight, asked


def _giou(a: Any, b: Any) -> Any:
    """Generalized IoU (N, h, w) of boxes (N, 4, h, w), after Rezatofighi et al. (2019)."""
    common = (torch.minimum(a[:, 2:], b[:, 2:]) - torch.maximum(a[:, :2], b[:, :2])).clamp(min=0).prod(1)
    joint = (a[:, 2:] - a[:, :2]).prod(1) + (b[:, 2:] - b[:, :2]).prod(1) - common
    around = (torch.maximum(a[:, 2:], b[:, 2:]) - torch.minimum(a[:, :2], b[:, :2])).prod(1)
    return common / joint.clamp(min=1e-3) - (around - joint) / around.clamp(min=1e-3)


def _density(heads: Any, rows: int, columns: int) -> Any:
    """People per cell (rows, columns): each head is shared out as a Gaussian of one cell, whose part in the image sums to 1."""
    density = torch.zeros(rows, columns)
    y, x = torch.arange(rows)[:, None] + 0.5, torch.arange(columns)[None] + 0.5
    for cx, cy in (heads / STRIDE).tolist():
        if 0 <= cx < columns and 0 <= cy < rows:
            bump = torch.exp(-((x - cx) ** 2 + (y - cy) ** 2) / 2)
            density += bump / bump.sum()
    return density
