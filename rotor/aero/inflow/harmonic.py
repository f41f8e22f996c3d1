"""Inflow that the load does not change: λ_i = λ0 (1 + Σ k_j s_j(r) w_j(ψ)), each w_j one of 1, cos ψ, sin ψ, cos 2ψ, …

A model says its waves, its functions s_j along the blade and their gains k_j at a flow, by a formula or from a table
over the skew of the wake. Slopes of the gains are differences, unless it has them.

The loss at the ends of the blades is one of two (`Models.loss_on`). On the lift, F C_l: induced power then all but does
not depend on twist. On the inflow, as eq. (3.3) has it: an annulus whose air moves by F λ_i on average balances
dC_T = 4 F λ_i √(µ² + λ²) r dr, in hover 4 F λ² r dr. Where √(µ² + λ²) hardly depends on F, which is so beyond µ 0.1,
blades with the same load meet λ_i/F. The λ_i above is then the mean around the azimuth, whose mean over the disk (2.30)
ties to C_T.
"""

from abc import abstractmethod
from collections.abc import Mapping, Sequence

import numpy as np

from rotor.aero.disk import Disk, azimuths_of
from rotor.aero.inflow.interface import Atoms, DiskFlow, FlowTerms, InflowModel, InflowTerms, Losses
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.losses import SMALLEST_TIP_FACTOR, mean_loss_factor
from rotor.aero.section import LOSS, UP
from rotor.engine.terms import Shape, Structure
from rotor.engine.waves import STEADY, harmonic_of, waves_at
from rotor.support.arrays import Array

LOSS_AZIMUTHS = 24
"""Azimuths over which the loss factor is averaged; 24 agree with 360 to 1e-4 in F (tested)."""
_STEP = 1e-5
"""Step of the differences over V: they agree with slopes by hand to 1e-8 (tested)."""


class HarmonicInflow(InflowModel):
    """An inflow model given by its harmonics, which depend on the flow through the disk."""

    load_dependent = False
    columns: Sequence[tuple[int, str]]
    """Of each gain its wave, numbered as in `rotor.engine.waves`, and the name of its function along the blade."""

    @abstractmethod
    def along(self, r: Array) -> Mapping[str, Array]:
        """The functions along the blade by name, at radii (n,): (n,) each."""

    @abstractmethod
    def gains(self, flow: DiskFlow) -> Sequence[float] | Array:
        """k of each column; smooth in the flow, for Newton's method follows its slopes."""

    def strengths(self, flow: DiskFlow) -> Array:
        """λ0 k of each column, and its slopes by (µ_x, µ_z, λ0), (columns, 4)."""
        at, step = np.array([flow.mu_x, flow.mu_z, flow.lambda0]), _STEP * flow.speed

        def of_mean(point: Array) -> Array:
            k: Array = np.array(self.gains(DiskFlow(*point.tolist())), dtype=np.float64)
            return k * float(point[2])

        slopes: list[Array] = [
            (of_mean(at + way) - of_mean(at - way)) / (2.0 * step) for way in step * np.eye(3)
        ]
        return np.stack([of_mean(at), *slopes], axis=1)

    def field(self, r: Array, waves: Array, flow: DiskFlow) -> Array:
        """λ_i at radii (n,) and azimuths of `waves`, (w, m), and its slopes by (µ_x, µ_z, λ0): (4, n, m)."""
        along = self.along(r)
        shapes = np.stack([along[name][:, None] * waves[wave] for wave, name in self.columns])
        out = np.tensordot(self.strengths(flow), shapes, (0, 0))
        out[0] += flow.lambda0
        out[3] += 1.0
        return out

    def on(self, disk: Disk, course: WakeCourse, losses: Losses) -> "HarmonicTerms":
        """The model on a disk."""
        del course
        return HarmonicTerms(self, disk, losses)


class HarmonicTerms(InflowTerms):
    """Harmonics on a disk: columns in U_P, with Prandtl's factors on the section lift, or on the inflow as λ_i/F."""

    def __init__(self, model: HarmonicInflow, disk: Disk, losses: Losses) -> None:
        self._model, self._disk, self._losses, self._over = (
            model,
            disk,
            losses,
            losses.on == "inflow",
        )
        self._along: dict[Shape, Array] = {("inflow", "mean"): np.ones_like(disk.r)}
        self._along |= {
            ("inflow", "along", name): shape for name, shape in model.along(disk.r).items()
        }
        self._waves = [
            (wave, ("inflow", "along", name), f"lambda0 k{j}")
            for j, (wave, name) in enumerate(model.columns)
        ]
        highest = max(harmonic_of(wave) for wave, _ in model.columns)
        self._around = waves_at(1 + 2 * highest, azimuths_of(LOSS_AZIMUTHS))
        self.key = "harmonics", losses.on, tuple(self._waves)
        self.names, self.live = tuple(self._along), ((LOSS, "loss"),)
        if self._over:
            self.live = tuple((UP, name) for name in self._along)
            self.names = (
                *self._along,
                *((name, by) for name in self._along for by in ("tilt", "inflow")),
            )

    def _columns(self, structure: Structure) -> list[tuple[int, Shape, int, int]]:
        harmonics = [(UP, name, wave, structure.quantity(atom)) for wave, name, atom in self._waves]
        return [(UP, ("inflow", "mean"), STEADY, structure.states["lambda0"]), *harmonics]

    def build(self, structure: Structure) -> None:
        """The columns, unless they follow the loss."""
        for channel, name, wave, atom in self._columns(structure):
            if not self._over:
                structure.column(channel, name, wave, 1.0, atom)

    def live_columns(self, structure: Structure) -> list[tuple[int, Shape, int, int]]:
        """F, or all columns over F."""
        return self._columns(structure) if self._over else super().live_columns(structure)

    def shapes(self) -> dict[Shape, Array]:
        """1, and what the model has along the blade; none that stand still over F."""
        return {} if self._over else self._along

    def follow(self, flow: DiskFlow, mu_z: float, sees_tilt: bool) -> FlowTerms:
        """λ0 k of each harmonic, and F; or 1/F and s/F with F ≥ 0.1, for at the very tip λ_i/F would have no bound."""
        rows = zip(self._waves, self._model.strengths(flow).tolist(), strict=True)
        atoms: Atoms = {atom: (row[0], (row[1], row[2], row[3])) for (_, _, atom), row in rows}
        factor, slopes = self.factor(flow, mu_z, sees_tilt)
        if not self._over:
            return FlowTerms(atoms, {(LOSS, "loss"): (factor, slopes)})
        free = factor > SMALLEST_TIP_FACTOR
        over = 1.0 / np.where(free, factor, SMALLEST_TIP_FACTOR)
        by_flow = np.where(free, -slopes * over**2, 0.0)
        return FlowTerms(
            atoms,
            {(UP, name): (over * along, by_flow * along) for name, along in self._along.items()},
        )

    def factor(self, flow: DiskFlow, mu_z: float, sees_tilt: bool) -> tuple[Array, Array]:
        """F, (elements,), averaged over azimuth (thesis p. 24), and its slopes by (µ_x, µ_z, λ0), (3, elements)."""
        disk, (tip, hub, _, spacing) = self._disk, self._losses
        if not (tip or hub):
            return np.ones_like(disk.r), np.zeros((3, len(disk.r)))
        field = self._model.field(disk.r, self._around, flow)
        factors = mean_loss_factor(
            disk.r, mu_z + field[0], field[1:], (spacing * disk.blades, disk.root), tip, hub
        )
        if sees_tilt:
            factors[3] += factors[1]  # λ by µ_z itself.
        return factors[0], factors[2:]
