"""The Peters–He dynamic wake as an inflow model: λ_i = (1/F) Σ c_t g_t(r) w_t(ψ) with c = T Q.

Q are the means of the load with the terms, T is the theory's periodic solution for a given wake (see `wake_projection`,
`peters_he`). F is Prandtl's tip factor for the infinite-blade form, 1 otherwise.
"""

from collections.abc import Hashable
from dataclasses import dataclass, replace
from functools import cache, lru_cache

import numpy as np

from rotor.aero.disk import Disk
from rotor.aero.inflow.interface import InflowModel, Wake
from rotor.aero.inflow.peters_he import flow_parameters
from rotor.aero.inflow.wake_projection import Projection, build_projection
from rotor.aero.inflow.wake_terms import WakeTerms
from rotor.aero.losses import tip_factor
from rotor.arrays import Array


@dataclass(frozen=True)
class DynamicWake:
    """The order of a dynamic wake, and the number of blade harmonics."""

    blades: int = 4
    order: int = 8
    """S: all modes with n − 1 ≤ S; 8 gives 25 cosines and 20 sines."""
    harmonics: int = 2
    """k: blade harmonics with the wave numbers N_b, 2N_b, … kN_b around the azimuth.
    0 is the time average: infinitely many blades, with the effect of their number restored by λ_i/F."""
    tip: bool = True
    """Whether F is used; F = 1 otherwise."""

    def __post_init__(self) -> None:
        if self.order < 1:
            raise ValueError(f"a dynamic wake of order {self.order} has no gradient: use 1 or more")
        if self.harmonics not in (0, self.order / self.blades):
            raise ValueError(
                f"{self.harmonics} blade harmonics do not match order {self.order} with {self.blades} blades: "
                "use order/blades, or 0 for infinitely many blades"
            )

    @classmethod
    def of(cls, blades: int, order: int = 8, *, infinite_blades: bool = False, tip: bool = True) -> "DynamicWake":
        """The wake with at most `order` that satisfies the truncation rule k = S/N_b, but not below ¾ of `order`.

        The rule is empirical: with it the optimum twist at µ 0.2 is −12.5, −11.4, −11.2, −11.2° for S = 4, 8, 12, 16;
        without it −9.3° (S 8, k 1).

        Induced power does not settle with the order: it grows with each blade harmonic k, for any number of blades. The
        theory's load is normal to the disk, so it has a part along the relative wind, which leaves a sheet of slowed
        air behind the blade. The more harmonics, the thinner the sheet and the more of it at the blade: each harmonic
        adds (µ_z + λ0) d/(2 r U_T²) to the inflow, 1 to 4 % of induced power. The lift of a real blade is normal to
        its wind and leaves none. Two harmonics agree best with a vortex lattice, for three, four and five blades.
        """
        if infinite_blades:
            return cls(blades, order, 0, tip)
        harmonics = order // blades
        if harmonics * blades < 0.75 * order:
            harmonics += 1
        return cls(blades, blades * harmonics, harmonics)

    @property
    def infinite_blades(self) -> bool:
        return self.harmonics == 0

    def on(self, root: float, elements: int) -> "DynamicWakeTheory":
        """The wake along a blade (cached)."""
        return _theory(self, root, elements)


class DynamicWakeTheory:
    """The answer of a dynamic wake in the terms of its projection, see `WakeTheory`."""

    def __init__(self, wake: DynamicWake, projection: Projection) -> None:
        self.key: Hashable = wake.blades, wake.order, wake.harmonics, wake.tip
        self.wake, self.projection = wake, projection
        self.shapes: list[Array] = list(projection.radial)
        self.gathering = self.shapes
        self.names: tuple[tuple[int, int], ...] = tuple(
            zip(projection.order.tolist(), projection.waves.tolist(), strict=True)
        )
        self.factor = wake.infinite_blades and wake.tip
        self.least_azimuths = 2 * int(projection.wave.max()) + 1

    def over_factor(self, wake: Wake) -> tuple[Array, Array]:
        """1/F and its slope by µ_z + λ0, (elements,)."""
        if not self.factor:
            return np.ones_like(self.projection.r), np.zeros_like(self.projection.r)
        factor, slope = tip_factor(self.projection.r, wake.axial, self.wake.blades)
        return 1.0 / factor, -slope / factor**2

    def answer(self, means: Array, wake: Wake) -> Array:
        """Coefficients of the inflow, (terms,)."""
        return self.projection.answer(means, flow_parameters(wake))

    def linear(self, means: Array, wake: Wake) -> tuple[Array, Array]:
        """T, and ∂ of `answer` by (µ_x, µ_z, λ0)."""
        flow = flow_parameters(wake)
        made = self.projection.blocks(flow)
        by_flow = self.projection.answer_slopes(means, flow, made)
        return self.projection.transfer(made), by_flow.T @ flow.slopes

    def nearest(self, field: Array) -> Array:
        """Coefficients of a field, (terms,)."""
        return self.projection.nearest(field)

    def induced(self, load: Array, wake: Wake) -> Array:
        """λ_i of a load d = dC_T/dr, both (elements, azimuths)."""
        azimuths: int = load.shape[1]
        terms = self.projection.at(2.0 * np.pi * np.arange(azimuths) / azimuths)
        means = np.tensordot(terms, load, 2) * (self.projection.dr / azimuths)
        return np.tensordot(self.answer(means, wake), terms, 1) * self.over_factor(wake)[0][:, None]


@lru_cache(maxsize=32)
def _theory(wake: DynamicWake, root: float, elements: int) -> DynamicWakeTheory:
    return DynamicWakeTheory(wake, build_projection(wake.order, wake.blades, wake.harmonics, root, elements))


@dataclass(frozen=True)
class DynamicWakeInflow:
    """Peters–He with the rotor's own blade number, or with infinitely many blades."""

    name: str
    title: str
    explanation: str
    order: int
    infinite_blades: bool = False
    tip: bool = True

    load_dependent = True

    def without_tip_loss(self) -> InflowModel:
        """Infinitely many blades with F = 1: the tip loss of a few blades is in the harmonics of their wake."""
        return self.spread()

    def spread(self) -> "DynamicWakeInflow":
        """The same load spread over infinitely many blades: its inflow is the time mean at each point of the disk."""
        return replace(self, infinite_blades=True, tip=False)

    def on(self, disk: Disk, expected: Wake, losses: tuple[bool, bool]) -> WakeTerms:
        """The model on a disk, whose azimuths must resolve its waves."""
        del expected, losses
        terms = WakeTerms(self.theory(disk), len(disk.r), disk.dr)
        if len(disk.psi) < terms.least_azimuths:
            waves = terms.least_azimuths // 2
            raise ValueError(
                f"{len(disk.psi)} azimuths cannot resolve the wake's {waves} waves per revolution: use more than "
                f"{2 * waves}"
            )
        return terms

    def theory(self, disk: Disk) -> DynamicWakeTheory:
        """The wake of the rotor's blades."""
        wake = _of(disk.blades, self.order, self.infinite_blades, self.tip)
        return wake.on(disk.root, len(disk.r))


@cache
def _of(blades: int, order: int, infinite_blades: bool, tip: bool) -> DynamicWake:
    return DynamicWake.of(blades, order, infinite_blades=infinite_blades, tip=tip)


DYNAMIC_WAKES = (
    DynamicWakeInflow(
        "dynamic-wake",
        "Dynamic wake (Peters–He)",
        "Responds to the load distribution, with this rotor's own blades: the disk shows the inflow at the blade at ψ.",
        order=8,
    ),
    DynamicWakeInflow(
        "dynamic-wake-quick",
        "Dynamic wake, few states",
        "The same theory with fewer shapes: faster and coarser.",
        order=4,
    ),
    DynamicWakeInflow(
        "dynamic-wake-infinite-blades",
        "Dynamic wake, infinite blades",
        "The time-averaged wake of infinitely many blades with Prandtl's tip factor, to compare with real blades.",
        order=8,
        infinite_blades=True,
    ),
)
