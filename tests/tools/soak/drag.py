"""One visitor's work: drag a slider to and fro, stop, and see whether the last answer is the right one."""

import asyncio
import math
import random
import time
from dataclasses import dataclass, field, replace
from functools import cache

import numpy as np

from explorer.model.inputs import OPENING, ViewState
from explorer.picture.blade_mesh import blade_shape, blade_vertices
from explorer.picture.picture import flown_twist
from rotor.arrays import Array
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from tests.tools.soak.visitor import Visitor

SLIDER, NAME = "Δ inboard [°/R]", "built_inner"
"""The slider that is dragged, and the field of `Inputs` behind it."""
_LOW, _HIGH, _STEP = -10.0, 10.0, 0.1
_DRAG = 3.0
"""[s] from taking the slider to letting it go."""
_PATIENCE = 30.0
"""[s] after which an answer that has not come is lost."""
_AGREE = 1.0
"""[kW]: the page shows whole kilowatts, and where a solve starts from moves the last digits."""
_FEW = 40
"""One coordinate of so many tells which blade is nearest; all of them then tell whether it is the one."""
_SAME = 1e-4
"""[m] by which a drawn blade may miss the expected one: the elastic twist is solved to a tolerance. One step of the
slider moves its edges by some millimetres."""


@dataclass
class Visit:
    """What one browser saw."""

    edits: int = 0
    """Moves of the slider."""
    delays_ms: list[float] = field(default_factory=list[float])
    """From an edit leaving the page to the frame that shows it, or a later one; of each that was answered, in order."""
    rounds: int = 0
    """Times it stopped dragging and waited for the last answer."""
    lost: list[str] = field(default_factory=list[str])
    """Sentences: last edits whose answer did not come or was not the right one."""
    frames: int = 0
    megabytes: float = 0.0
    complaints: list[str] = field(default_factory=list[str])


class Dragger:
    """Drives a visitor and keeps the book: which twist a frame shows, and when it was asked for."""

    def __init__(self, name: str, seed: int) -> None:
        self.visitor = Visitor(self._seen)
        self._name = name
        self._random = random.Random(seed)
        self._value = OPENING.built_inner
        self._asked: dict[float, list[int]] = {self._value: []}
        """Numbers of the edits that asked for a value of the slider."""
        self._times: list[float] = []
        """When each edit was sent [s]."""
        self._answered = 0
        """All edits before this one have been answered."""
        self._visit = Visit()
        self._measuring = False

    async def run(self, address: str, begin: float, end: float, rate: float) -> Visit:
        """Come, drag from `begin` to `end` (`time.monotonic`) with short rests, leave."""
        visitor, visit = self.visitor, self._visit
        try:
            await visitor.open(address)
            await visitor.until(lambda: visitor.text("status") == "converged", _PATIENCE)
            await visitor.idle()  # So that what a page keeps for its charts is there before memory is judged.
            await asyncio.sleep(max(begin - time.monotonic(), 0.0))
            end += time.monotonic() - begin  # Who comes late drags as long as the others.
            self._measuring, bytes_before = True, visitor.bytes
            while time.monotonic() < end:
                await self._drag(min(time.monotonic() + _DRAG, end), 1.0 / rate)
                await self._check()
            visit.megabytes = (visitor.bytes - bytes_before) / 1e6
        except (ConnectionError, TimeoutError, LookupError, OSError) as error:
            visit.complaints.append(f"{self._name}: {error or type(error).__name__}")
        await visitor.close()
        visit.edits = len(self._times)
        visit.complaints += [f"{self._name}: {notice}" for notice in visitor.notices]
        return visit

    async def _drag(self, until: float, period: float) -> None:
        """To and fro as a hand does, in steps of the slider, one edit a period."""
        swing = self._random.uniform(2.0, 6.0)
        middle = self._random.uniform(_LOW + swing, _HIGH - swing)
        pace, begin = self._random.uniform(0.2, 0.6), time.monotonic()
        due = begin
        while (now := time.monotonic()) < until:
            wanted = middle + swing * math.sin(2.0 * math.pi * pace * (now - begin))
            value = round(round(wanted / _STEP) * _STEP, 1)
            if value != self._value:
                await self._edit(value)
            due += period
            await asyncio.sleep(max(due - time.monotonic(), 0.0))

    async def _edit(self, value: float) -> None:
        self._value = value
        self._asked.setdefault(value, []).append(len(self._times))
        self._times.append(time.monotonic())
        await self.visitor.move(SLIDER, value)

    def _seen(self, vertices: bytes) -> None:
        """A frame: it answers the last edit that asked for its blade, and all before that one."""
        if not self._measuring:
            return
        self._visit.frames += 1
        asked = self._asked.get(expected().value_of(vertices))
        if asked is None:
            self._visit.lost.append(f"{self._name}: a frame showed a blade that nobody asked for")
            return
        now = time.monotonic()
        while asked and self._answered <= asked[-1]:
            self._visit.delays_ms.append(1e3 * (now - self._times[self._answered]))
            self._answered += 1

    async def _check(self) -> None:
        """The slider rests: blade and power must become those of its value."""
        self._visit.rounds += 1
        visitor, power = self.visitor, expected().power_kw[self._value]

        def right() -> bool:
            shown = _kilowatts(visitor.text("total-power"))
            return expected().value_of(visitor.blade) == self._value and abs(shown - power) <= _AGREE

        try:
            await visitor.until(right, _PATIENCE)
        except TimeoutError:
            shown = visitor.text("total-power")
            self._visit.lost.append(
                f"{self._name}: {SLIDER} {self._value:g} means {power:.1f} kW, the page shows {shown!r}"
            )


class Expected:
    """What the page must show at every value of the slider: the blade as flown, and the power."""

    def __init__(self) -> None:
        steps = round((_HIGH - _LOW) / _STEP)
        self._values = [round(_LOW + k * _STEP, 1) for k in range(steps + 1)]
        solution: Solution | None = None
        self.power_kw: dict[float, float] = {}
        blades: list[Array] = []
        for value in self._values:
            solution = solve(replace(OPENING, **{NAME: value}).design(), solution)
            self.power_kw[value] = solution.power.total / 1e3
            view = ViewState()
            twist = flown_twist(solution, math.radians(view.azimuth_deg))
            blades.append(blade_vertices(blade_shape(solution.design.rotor), twist, view.exaggeration).ravel())
        self._blades = np.array(blades, np.float32)
        self._few = np.ascontiguousarray(self._blades[:, ::_FEW])

    def value_of(self, vertices: bytes) -> float:
        """The value whose blade this is; NaN where it is none of them."""
        blade = np.frombuffer(vertices, np.float32)
        if blade.size != self._blades.shape[1]:
            return math.nan
        nearest = int(np.abs(self._few - blade[::_FEW]).max(axis=1).argmin())
        return self._values[nearest] if np.abs(self._blades[nearest] - blade).max() <= _SAME else math.nan


@cache
def expected() -> Expected:
    """Made once, before anything is timed."""
    return Expected()


def _kilowatts(text: str) -> float:
    digits = "".join(c for c in text if c.isdigit() or c == ".")
    return float(digits) if digits else math.nan
