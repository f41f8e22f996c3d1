"""Plots of arrays with matplotlib, which is imported only when something is drawn."""

import importlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from rotor.arrays import Array


def new_axes(**options: Any) -> Any:
    """Axes in a new pyplot figure."""
    pyplot: Any = importlib.import_module("matplotlib.pyplot")
    return pyplot.subplots(**options)[1]


def plot_disk(r: Array, psi: Array, values: Array, label: str, ax: Any = None) -> Any:
    """A field over the disk, seen from above: tail (ψ = 0) down, advancing side (ψ = 90°) right.

    r: element centres y/R, (elements,). psi: azimuths [rad], (azimuths,). values: (elements, azimuths).
    `ax`: polar axes to draw into; by default new ones. Returns the axes.
    """
    if ax is None:
        ax = new_axes(subplot_kw={"projection": "polar"})
    ax.set_theta_zero_location("S")
    ax.set_theta_direction(1)
    closed = np.concatenate((values, values[:, :1]), axis=1)
    drawn = ax.contourf(np.append(psi, psi[0] + 2.0 * np.pi), r, closed, levels=40)
    ax.set_rlim(0.0, 1.0)
    ax.set_title(label)
    ax.figure.colorbar(drawn, ax=ax, shrink=0.8)
    return ax


def plot_lines(x: Sequence[float], lines: Mapping[str, Sequence[float]], labels: tuple[str, str], ax: Any) -> Any:
    """Named lines over one abscissa, into `ax` or new axes; NaN leaves a gap. `labels`: of x and of y."""
    if ax is None:
        ax = new_axes()
    for name, y in lines.items():
        ax.plot(x, y, marker=".", label=name)
    ax.set_xlabel(labels[0])
    ax.set_ylabel(labels[1])
    ax.legend()
    return ax
