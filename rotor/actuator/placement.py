"""Placement of an actuator on the blade, and the blade that carries it."""

import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

from rotor.dynamics.structure import structure_data

BladeKind = Literal["retrofit", "new"]


@dataclass(frozen=True)
class Placement:
    """Active part of span and chord, both skins, and its plies."""

    span: tuple[float, float] = (0.2433, 0.9292)
    """r/R, inner and outer end."""
    chord: tuple[float, float] = (0.05, 0.80)
    """x/c, front and rear end."""
    plies: int = 2
    """Per skin; for a torque tube the number of tubes."""
    angle: float = math.pi / 4.0
    """Of the fibres from the span [rad]."""
    divisions: tuple[float, ...] = ()
    """r/R where one electrical segment ends and the next begins; each segment has a voltage of its own."""

    def __post_init__(self) -> None:
        low, high = self.span
        front, rear = self.chord
        if not 0.05 <= low < high <= 1.0:
            raise ValueError(f"active span {low:g}…{high:g} is not inside 0.05…1 R: give inner < outer as r/R")
        if not 0.0 <= front < rear <= 0.95:
            raise ValueError(f"active chord {front:g}…{rear:g} is not inside 0…0.95 c: give front < rear as x/c")
        if not 1 <= self.plies <= 12:
            raise ValueError(
                f"{self.plies} plies are outside 1…12: choose a number inside (six weigh as much as half a blade)"
            )
        if any(a >= b for a, b in pairwise((0.0, *self.divisions, 1.0))):
            raise ValueError(f"segment divisions {list(self.divisions)} must ascend between 0 and 1")

    @property
    def segments(self) -> tuple[tuple[float, float], ...]:
        """Active spans of the segments, root to tip, r/R; a segment without active span is (a, a)."""
        edges = (0.0, *self.divisions, 1.0)
        low, high = self.span
        return tuple((min(max(a, low), high), min(max(b, low), high)) for a, b in pairwise(edges))


@dataclass(frozen=True)
class Host:
    """The blade that carries the actuator."""

    kind: BladeKind = "retrofit"
    """`retrofit`: outside the skins of the existing blade; `new`: in the torsion skin of a new blade."""
    stiffness: float = 1.0
    """GJ relative to the existing blade; 1 for a retrofit."""

    def __post_init__(self) -> None:
        if not 0.1 <= self.stiffness <= 2.0:
            raise ValueError(
                f"blade stiffness {self.stiffness:g} is outside 0.1…2: give GJ relative to the existing blade"
            )
        if self.kind == "retrofit" and self.stiffness != 1.0:
            raise ValueError(
                f"a retrofit keeps the blade, so its stiffness cannot be {self.stiffness:g}: use 1, or a new blade"
            )

    @property
    def label(self) -> str:
        if self.kind == "retrofit":
            return "retrofit"
        return "new blade" if self.stiffness == 1.0 else f"new blade, GJ × {self.stiffness:g}"


def default_placement(plies: int = 2, divisions: tuple[float, ...] = ()) -> Placement:
    """The placement of the worked example: full section to swept tip, 5–80 % chord, ±45°."""
    data = structure_data()["placement"]
    low, high = data["span_r"]
    front, rear = data["chord_c"]
    return Placement((low, high), (front, rear), plies, math.pi / 4.0, divisions)
