"""Images with their labels, and animated trajectories. Needs matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._optional import require

if TYPE_CHECKING:
    from .frame import Frame
    from .trace import Trace

# COCO's skeleton, counted from 0.
SKELETON = (
    (15, 13),
    (13, 11),
    (16, 14),
    (14, 12),
    (11, 12),
    (5, 11),
    (6, 12),
    (5, 6),
    (5, 7),
    (6, 8),
    (7, 9),
    (8, 10),
    (1, 2),
    (0, 1),
    (0, 2),
    (1, 3),
    (2, 4),
    (3, 5),
    (4, 6),
)


def track_color(track_id: int) -> tuple[float, float, float]:
    """A color that stays the same for a person in all frames."""
    hue = (track_id * 0.61803398875) % 1.0
    channel = np.clip(np.abs(((hue + np.array([0.0, 2 / 3, 1 / 3])) % 1.0) * 6 - 3) - 1, 0, 1)
    red, green, blue = (float(v) for v in 0.25 + 0.75 * channel)
    return red, green, blue


def overlay(frame: Frame, *, opacity: float = 0.5) -> NDArray[np.uint8]:
    """(height, width, 3): the image with everybody's mask in their color."""
    picture = frame.image().astype(np.float32)
    annotations = frame.annotations
    for i, track in enumerate(annotations.track_ids):
        mask = annotations.mask(i)
        picture[mask] = (1 - opacity) * picture[mask] + opacity * 255 * np.array(
            track_color(int(track)), dtype=np.float32
        )
    return np.rint(picture).astype(np.uint8)


def show(
    frame: Frame,
    *,
    boxes: bool = True,
    masks: bool = False,
    keypoints: bool = False,
    boxes_3d: bool = False,
    exits: bool = False,
    amodal: bool = False,
    ax: Any = None,
) -> Any:
    """Draws a frame with its annotations and returns the matplotlib Axes."""
    plt = require("matplotlib.pyplot", "show()")
    patches = require("matplotlib.patches", "show()")
    if ax is None:
        _, ax = plt.subplots(figsize=(12, 12 * frame.height / frame.width))
    # Box coordinates: pixel i covers [i, i + 1).
    ax.imshow(overlay(frame) if masks else frame.image(), extent=(0, frame.width, frame.height, 0))
    annotations = frame.annotations
    tracks = annotations.track_ids
    if boxes:
        for (x, y, width, height), track in zip(annotations.boxes_amodal if amodal else annotations.boxes, tracks):
            ax.add_patch(
                patches.Rectangle((x, y), width, height, fill=False, edgecolor=track_color(int(track)), linewidth=1)
            )
    if keypoints:
        _draw_keypoints(ax, frame)
    if boxes_3d:
        for corners, track in zip(frame.camera.project(annotations.corners_3d(), origin="corner"), tracks):
            for a, b in (
                [(i, (i + 1) % 4) for i in range(4)]
                + [(i + 4, (i + 1) % 4 + 4) for i in range(4)]
                + [(i, i + 4) for i in range(4)]
            ):
                ax.plot(*corners[[a, b]].T, color=track_color(int(track)), linewidth=0.8)
    if exits:
        for way_out in frame.exits:
            if len(way_out.get("zone", [])) > 2:
                ax.add_patch(patches.Polygon(way_out["zone"], fill=False, edgecolor="white", linestyle=":"))
            if len(way_out.get("door", [])) > 2:
                ax.add_patch(patches.Polygon(way_out["door"], alpha=0.4, color="lime"))
    ax.set(
        xlim=(0, frame.width),
        ylim=(frame.height, 0),
        title=f"{frame.sequence}  frame {frame.index}  {frame.time_s:g} s  {len(annotations.people)} people",
    )
    ax.set_axis_off()
    return ax


def show_labels(frame: Frame, *, columns: int = 3, width_in: float = 15.0) -> Any:
    """Draws the labels of one frame side by side and returns the matplotlib Figure.

    Color, boxes and masks are always there; semantic classes, depth and the density of people where the dataset has
    them. Depth is drawn from near (bright) to far (dark), the density over a gray image.
    """
    plt = require("matplotlib.pyplot", "show_labels()")
    patches = require("matplotlib.patches", "show_labels()")
    panels: list[tuple[str, NDArray[Any]]] = [
        ("color", frame.image()),
        (f"boxes: {len(frame.people)} people", frame.image()),
        ("masks", overlay(frame, opacity=0.85)),
    ]
    if frame.has("semantic"):
        panels.append(("classes", frame.semantic_colors()))
    if frame.has("depth"):
        panels.append(("depth", _depth_colors(frame, plt)))
    if frame.has("density"):
        panels.append(("density", _density_colors(frame, plt)))
    columns = max(1, min(columns, len(panels)))
    rows = -(-len(panels) // columns)
    panel_in = width_in / columns
    figure, axes = plt.subplots(
        rows,
        columns,
        figsize=(width_in, rows * panel_in * frame.height / frame.width),
        squeeze=False,
        gridspec_kw={"left": 0, "right": 1, "bottom": 0, "top": 1, "wspace": 0.01, "hspace": 0.01},
    )
    for ax in axes.flat:
        ax.set_axis_off()
    for ax, (title, picture) in zip(axes.flat, panels):
        ax.imshow(picture, extent=(0, frame.width, frame.height, 0))
        ax.text(0.015, 0.975, title, transform=ax.transAxes, va="top", fontsize=11, color="white", bbox=_LABEL_BOX)
    for (x, y, width, height), track in zip(frame.people.boxes, frame.people.track_ids):
        color = track_color(int(track))
        axes.flat[1].add_patch(patches.Rectangle((x, y), width, height, fill=False, edgecolor=color, linewidth=0.9))
    return figure


_LABEL_BOX = {"facecolor": "black", "alpha": 0.6, "edgecolor": "none", "boxstyle": "square,pad=0.25"}


def _depth_colors(frame: Frame, plt: Any) -> NDArray[np.uint8]:
    """(height, width, 3): the logarithm of depth; black where there is none."""
    depth_m = frame.depth()
    known = np.isfinite(depth_m)
    shade = np.zeros(depth_m.shape)
    if known.any():
        near, far = np.log(np.quantile(depth_m[known], (0.01, 0.99)))
        shade[known] = 1 - np.clip((np.log(depth_m[known]) - near) / max(far - near, 1e-6), 0, 1)
    colors: NDArray[np.uint8] = (255 * plt.get_cmap("viridis")(shade)[..., :3]).astype(np.uint8)
    colors[~known] = 0
    return colors


def _density_colors(frame: Frame, plt: Any) -> NDArray[np.uint8]:
    """(height, width, 3): the density map over the darkened gray image; the most crowded point is brightest."""
    density = frame.density()
    share = np.sqrt(density / max(float(density.max()), 1e-12))
    gray = 0.45 * frame.image().mean(axis=2, keepdims=True)
    heat = 255 * plt.get_cmap("inferno")(0.15 + 0.85 * share)[..., :3]
    weight = np.clip(2 * share, 0, 1)[..., None]
    mixed: NDArray[np.uint8] = ((1 - weight) * gray + weight * heat).astype(np.uint8)
    return mixed


def _draw_keypoints(ax: Any, frame: Frame) -> None:
    people = frame.people
    for points, track in zip(people.keypoints, people.track_ids):
        seen = points[:, 2] > 0
        for a, b in SKELETON:
            if seen[a] and seen[b]:
                ax.plot(points[[a, b], 0], points[[a, b], 1], color=track_color(int(track)), linewidth=1)
        ax.scatter(points[seen, 0], points[seen, 1], s=4, color=[track_color(int(track))])


def animate(trace: Trace, *, every_s: float = 0.2, speed: float = 1.0, obstacles: Any = (), ax: Any = None) -> Any:
    """A matplotlib FuncAnimation of the positions of all people; in a notebook show it with HTML(animation.to_jshtml()).

    every_s is simulated time from image to image, speed how much faster than real time it plays. obstacles are
    polygons, lists of (x, y).
    """
    if not (every_s > 0 and speed > 0):
        raise ValueError(f"every_s, speed: found {every_s}, {speed}, expected numbers above 0")
    plt = require("matplotlib.pyplot", "animate()")
    animation = require("matplotlib.animation", "animate()")
    collections = require("matplotlib.collections", "animate()")
    if ax is None:
        _, ax = plt.subplots(figsize=(8, 8))
    positions = trace.positions[:, trace.people]
    speeds = np.linalg.norm(trace.velocities[:, trace.people], axis=-1)
    steps = np.arange(0, len(trace.time_s), max(1, round(every_s / trace.dt_s)))
    for polygon in obstacles:
        ax.add_patch(plt.Polygon(np.asarray(polygon, dtype=np.float64), color="0.6"))
    there = positions[np.isfinite(positions).all(axis=-1)]
    low, high = (there.min(axis=0), there.max(axis=0)) if len(there) else (np.zeros(2), np.ones(2))
    ax.set(
        xlim=(low[0] - 2, high[0] + 2), ylim=(low[1] - 2, high[1] + 2), aspect="equal", xlabel="x / m", ylabel="y / m"
    )
    diameters = 2 * trace.radii_m[trace.people]
    people = collections.EllipseCollection(
        diameters,
        diameters,
        np.zeros(len(diameters)),
        units="xy",
        cmap="viridis",
        offsets=np.nan_to_num(positions[0], nan=1e9),
        transOffset=ax.transData,
    )
    people.set_clim(0, 2.0)
    ax.add_collection(people)
    title = ax.set_title("")

    def draw(step: int) -> tuple[Any, Any]:
        people.set_offsets(np.nan_to_num(positions[step], nan=1e9))
        people.set_array(np.nan_to_num(speeds[step]))
        title.set_text(f"{trace.time_s[step]:.1f} s   {int(np.isfinite(positions[step, :, 0]).sum())} people")
        return people, title

    return animation.FuncAnimation(ax.figure, draw, frames=steps, interval=1000 * every_s / speed, blit=False)
