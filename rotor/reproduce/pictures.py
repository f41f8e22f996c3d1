"""Reports as pictures, SVG and PNG, where matplotlib is installed."""

import importlib
import importlib.util
import math
from pathlib import Path
from typing import Any

import numpy as np

from rotor.arrays import Array
from rotor.reproduce.report import AnyPanel, DiskPanel, FieldPanel, PlotPanel, Report, typographic

PALETTE = ("#0b5fa5", "#d1495b", "#2a9d5c", "#e08e00", "#7a4fb3", "#1aa6b7", "#8c5a3c", "#555555")
NO_PICTURES = (
    "matplotlib is not installed, so there are no pictures; tables are complete. "
    "For pictures: pip install 'rotor-explorer[plots]'"
)
_STYLE = {
    "font.size": 9.0,
    "font.family": "sans-serif",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#dddddd",
    "grid.linewidth": 0.6,
    "axes.edgecolor": "#888888",
    "axes.titlesize": 9.0,
    "legend.fontsize": 8.0,
    "legend.framealpha": 0.8,  # Above the lines, where no corner is free.
    "legend.edgecolor": "none",
    "lines.linewidth": 1.6,
    "svg.fonttype": "none",
    "svg.hashsalt": "rotor",
}
_WIDTH, _HEIGHT = 4.2, 3.2
"""Inches of one panel."""
FEW = 3
"""Curves for whose names there is room in a panel."""
MOST = 5
"""Names on one line of a legend below."""
MANY = 14
"""Curves, bands included, from which the legend stands beside the panel."""


def can_draw() -> bool:
    """Whether matplotlib is there."""
    return importlib.util.find_spec("matplotlib") is not None


def draw(report: Report, folder: Path) -> None:
    """Write `stem.svg` and `stem.png` for each picture of the report; nothing for a report without panels."""
    for stem, panels in pictures_of(report):
        _draw_picture(stem, panels, folder, legend_below=panels is report.companion or same_key(panels))


def pictures_of(report: Report) -> tuple[tuple[str, tuple[AnyPanel, ...]], ...]:
    """Stem and panels of each picture."""
    both = ((report.stem, report.panels), (f"{report.stem}-inflow", report.companion))
    return tuple((stem, panels) for stem, panels in both if panels)


def same_key(panels: tuple[AnyPanel, ...]) -> bool:
    """Whether several panels name the same curves, too many to lie over them: one legend below serves all."""
    keys = [tuple(one.label for one in panel.curves) for panel in panels if isinstance(panel, PlotPanel)]
    return len(keys) == len(panels) > 1 and len(set(keys)) == 1 and len(keys[0]) > FEW


def _draw_picture(stem: str, panels: tuple[AnyPanel, ...], folder: Path, *, legend_below: bool) -> None:
    matplotlib: Any = importlib.import_module("matplotlib")
    figure_module: Any = importlib.import_module("matplotlib.figure")
    count = len(panels)
    across = count if count <= 3 else 2
    down = math.ceil(count / across)
    with matplotlib.rc_context(_STYLE):
        figure: Any = figure_module.Figure(figsize=(_WIDTH * across, _HEIGHT * down), layout="constrained")
        axes: Any = figure.subplots(down, across, squeeze=False)
        for k, panel in enumerate(panels):
            place = axes[k // across][k % across]
            if isinstance(panel, DiskPanel):
                _draw_disk(figure, place, panel)
            elif isinstance(panel, FieldPanel):
                _draw_field(figure, place, panel)
            else:
                _draw_panel(place, panel, legend=not legend_below)
        if legend_below:
            pairs = [pair for place in axes.flat for pair in zip(*place.get_legend_handles_labels(), strict=True)]
            key = {label: handle for handle, label in pairs}
            figure.legend(
                key.values(), key.keys(), loc="outside lower center", ncols=3 if len(key) > MOST else len(key)
            )
        for k in range(count, down * across):
            axes[k // across][k % across].axis("off")
        figure.savefig(folder / f"{stem}.svg", metadata={"Date": None})
        figure.savefig(folder / f"{stem}.png", dpi=130)


def _draw_panel(axes: Any, panel: PlotPanel, *, legend: bool) -> None:
    turn = 0
    for one in panel.curves:
        place = one.colour if one.colour is not None else turn
        turn += one.colour is None
        colour = PALETTE[place % len(PALETTE)]
        if one.style == "band":
            if len(one.x) == 1:  # One condition alone has no area.
                axes.plot(one.x * 2, (one.y[0], one.upper[0]), color=colour, alpha=0.3, linewidth=5)
                continue
            axes.fill_between(one.x, one.y, one.upper, color=colour, alpha=0.15, linewidth=0)
            continue
        if one.style == "fill":
            label = typographic(one.label) or None
            axes.fill(one.x, one.y, facecolor=colour, edgecolor=colour, alpha=0.55, linewidth=0.8, label=label)
            continue
        look: dict[str, Any] = {
            "line": {},
            "thin": {"linewidth": 0.8},
            "points": {"linestyle": "none", "marker": "o", "markersize": 4},
            "dashed": {"linestyle": "--"},
            "both": {"marker": "o", "markersize": 3},
        }[one.style]
        axes.plot(one.x, one.y, color=colour, label=typographic(one.label) or None, **look)
    axes.set_xlabel(panel.x_label)
    axes.set_ylabel(panel.y_label)
    if panel.title:
        axes.set_title(panel.title)
    if "x" in panel.log:
        axes.set_xscale("log")
    if "y" in panel.log:
        axes.set_yscale("log")
    if panel.invert_y:
        axes.invert_yaxis()
    if panel.equal:
        axes.set_aspect("equal", adjustable="datalim")
    if panel.y_limits:
        axes.set_ylim(*panel.y_limits)
    if legend and sum(bool(one.label) for one in panel.curves) > 1:
        many = len(panel.curves) > MANY
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5)) if many else axes.legend()


def _draw_field(figure: Any, axes: Any, panel: FieldPanel) -> None:
    low, high = panel.limits or (None, None)
    shade = axes.pcolormesh(
        panel.x, panel.y, panel.values, cmap="viridis", vmin=low, vmax=high, shading="gouraud", rasterized=True
    )
    figure.colorbar(shade, ax=axes, label=panel.label, shrink=0.85)
    if panel.lines:
        axes.contour(panel.x, panel.y, panel.lines, levels=9, colors="white", linewidths=0.7)
    for one in panel.marks:
        axes.plot(one.x, one.y, color="#c0392b", linewidth=5, solid_capstyle="butt", clip_on=False)
    axes.set_xlabel(panel.x_label)
    axes.set_ylabel(panel.y_label)
    axes.set_title(panel.title)
    axes.grid(False)


def _draw_disk(figure: Any, axes: Any, panel: DiskPanel) -> None:
    """Seen from above, nose up: x = r sin ψ, y = −r cos ψ; the circle closes because cells have edges of their own."""
    values = np.array(panel.values)
    n, m = values.shape
    edges: Array = panel.r[0] - 0.5 * panel.dr + panel.dr * np.arange(n + 1, dtype=np.float64)
    around: Array = 2.0 * np.pi * (np.arange(m + 1, dtype=np.float64) - 0.5) / m
    x: Array = edges[:, None] * np.sin(around)
    y: Array = -edges[:, None] * np.cos(around)
    mesh = axes.pcolormesh(x, y, values, cmap="viridis", rasterized=True)
    figure.colorbar(mesh, ax=axes, label=panel.label, shrink=0.85)
    if panel.zero_line:
        psi = np.append(panel.psi, 2.0 * np.pi)
        closed = np.hstack((values, values[:, :1]))
        r = np.array(panel.r)[:, None]
        axes.contour(r * np.sin(psi), -r * np.cos(psi), closed, levels=[0.0], colors="white", linewidths=1.2)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.grid(False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    for words, across, up in (("ψ = 0°, tail", 0.0, -1.1), ("90°, advancing", 1.08, 0.0), ("180°", 0.0, 1.06)):
        turn = 90 if across else 0
        axes.text(across, up, words, ha="center", va="center", fontsize=7, rotation=turn, color="#555555")
    axes.set_title(panel.title, pad=14)
