"""What the disk can show: each field's title, unit, range, and its values on a refined polar grid."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from explorer.colours import Scheme
from explorer.model.inputs import ViewState
from explorer.picture.polar import DrawnSolution, PolarGrid, polar_grid
from rotor import Rotor, Solution
from rotor.files.rotor_file import shipped_aircraft
from rotor.support.arrays import Array
from rotor.support.chart import round_up
from rotor.trim import DiskFields


@dataclass(frozen=True)
class Field:
    """One quantity over the disk."""

    title: str
    unit: str
    low: float
    """Lower end of the fixed colour range, in `unit`."""
    high: float
    colours: Scheme
    sample: Callable[[DrawnSolution, PolarGrid], Array]
    """Values in `unit` on the polar grid, shape (radii, azimuths); finite everywhere."""
    void_in_reverse_flow: bool = False
    """Whether the quantity loses its meaning where the flow comes from the trailing edge."""
    absent: Callable[[DrawnSolution, PolarGrid], NDArray[np.bool_]] | None = None
    """Where else the quantity is not defined, on the polar grid."""
    needs: str = ""
    """Field of `DiskFields` that holds the quantity, where a model may be off; empty: always there."""
    note: str = ""
    speeds: int | None = None
    """Size and range go with chord × tip speed to this power; None: the same for all rotors."""

    @property
    def two_sided(self) -> bool:
        """Centred on zero, with a symmetric range."""
        return self.colours != "sequential"

    @property
    def label(self) -> str:
        return (f"{self.title} [{self.unit}]" if self.unit else self.title) + self.note

    def exists(self, solution: Solution | DrawnSolution) -> bool:
        return not self.needs or getattr(solution.disk, self.needs) is not None

    def void(self, drawn: DrawnSolution, grid: PolarGrid) -> NDArray[np.bool_] | None:
        """Where there is no value on the polar grid, shape (radii, azimuths); None: nowhere."""
        if not self.exists(drawn):
            return np.ones(grid.shape, dtype=bool)
        parts = [] if self.absent is None else [self.absent(drawn, grid)]
        if self.void_in_reverse_flow:
            parts.append(reverse_flow(drawn, grid))
        return np.logical_or.reduce(parts) if parts else None


def reverse_flow(drawn: DrawnSolution, grid: PolarGrid) -> NDArray[np.bool_]:
    """Where U_T < 0 on the polar grid, shape (radii, azimuths)."""
    return drawn.flow(grid).u_t < 0.0


def _refined(name: str, least: float = -math.inf) -> Callable[[DrawnSolution, PolarGrid], Array]:
    """Samples a field of the disk as it is, at least `least`."""
    return lambda drawn, grid: np.maximum(grid.refine(getattr(drawn.disk, name)), least)


def _degrees(name: str) -> Callable[[DrawnSolution, PolarGrid], Array]:
    """Samples an angle that pictures read."""
    return lambda drawn, grid: np.degrees(getattr(drawn.flow(grid), name)).astype(np.float64)


def _cl(drawn: DrawnSolution, grid: PolarGrid) -> Array:
    """Weighted by M²: lift per chord is smooth across the reverse-flow circle, its coefficient is not."""
    disk = drawn.disk
    weight = disk.mach**2
    cl = grid.refine(weight * disk.cl) / np.maximum(grid.refine(weight), 1e-4)
    # Extrapolated over half a wide element at the root, the weight may come near zero.
    return np.clip(cl, disk.cl.min(), disk.cl.max())


def _m2cn(drawn: DrawnSolution, grid: PolarGrid) -> Array:
    disk = drawn.disk
    return grid.refine(disk.mach**2 * (disk.cl * np.cos(disk.alpha) + disk.cd * np.sin(disk.alpha)))


def _per_metre(
    unit: str, of: Callable[[DiskFields], Array]
) -> Callable[[DrawnSolution, PolarGrid], Array]:
    """Samples a force [kN/m] or power [kW/m] per length of one blade; `unit`: field of a design, what 1 stands for."""

    def sample(drawn: DrawnSolution, grid: PolarGrid) -> Array:
        design = drawn.design
        scale: float = getattr(design, unit) / (design.rotor.blades * design.rotor.radius) / 1e3
        return grid.refine(of(drawn.disk)) * scale

    return sample


def _circulation(drawn: DrawnSolution, grid: PolarGrid) -> Array:
    """Lift per length over ρU; weighted by U², which is smooth where the flow stands still."""
    design, disk = drawn.design, drawn.disk
    lift_times_speed = disk.dct * disk.u_t + disk.dcq * disk.u_p
    square = np.maximum(grid.refine(disk.u_t**2 + disk.u_p**2), 1e-3)
    unit = design.thrust_per_metre / (design.condition.density * design.rotor.tip_speed)
    return grid.refine(lift_times_speed) / square * unit


def _dissipation(disk: DiskFields) -> Array:
    """V dD = U_T dF_x − U_P dF_z + U_R dF_r."""
    return disk.u_t * disk.dcq - disk.u_p * disk.dct + disk.u_r * disk.dcr


_thrust = _per_metre("thrust_unit", lambda disk: disk.dct)
_power = _per_metre("power_unit", lambda disk: disk.r[:, None] * disk.dcq)
_induced_power = _per_metre("power_unit", lambda disk: disk.induced * disk.dct)
"""λ_i dF_z, as `rotor.trim.power` sums it; without the swirl of hover."""
_profile_power = _per_metre("power_unit", _dissipation)


def _drag(drawn: DrawnSolution, grid: PolarGrid) -> Array:
    """Section drag per length: profile power over the speed at the section, which is smooth where the flow stands."""
    disk = drawn.disk
    speed = np.sqrt(np.maximum(grid.refine(disk.u_t**2 + disk.u_p**2 + disk.u_r**2), 1e-3))
    force = grid.refine(_dissipation(disk)) / speed
    return np.maximum(force, 0.0) * drawn.design.thrust_per_metre


def _elastic_deg(drawn: DrawnSolution, grid: PolarGrid) -> Array:
    elastic = drawn.disk.elastic_twist
    return np.zeros(grid.shape) if elastic is None else np.degrees(grid.refine(elastic))


def _unsteady(name: str) -> Callable[[DrawnSolution, PolarGrid], Array]:
    """Samples a field of dynamic stall."""

    def sample(drawn: DrawnSolution, grid: PolarGrid) -> Array:
        unsteady = drawn.disk.unsteady
        if unsteady is None:
            return np.zeros(grid.shape)
        return np.clip(
            grid.refine(getattr(unsteady, name)), -2.0, 1.0 if name == "separation" else 2.0
        )

    return sample


FIELDS: dict[str, Field] = {
    field.title: field
    for field in (
        Field(
            "Angle of attack",
            "°",
            -4.0,
            14.0,
            "sequential",
            _degrees("alpha"),
            void_in_reverse_flow=True,
        ),
        Field("Induced inflow λi", "", -0.08, 0.08, "diverging", _refined("induced")),
        Field("Total inflow λ", "", -0.02, 0.12, "sequential", _refined("inflow")),
        Field("Mach number", "", 0.0, 0.9, "sequential", _refined("mach", 0.0)),
        Field("Lift coefficient", "", -0.4, 1.4, "sequential", _cl),
        Field("M²cn", "", -0.05, 0.25, "sequential", _m2cn),
        Field("Thrust dT/dr", "kN/m per blade", -1.0, 7.0, "sequential", _thrust, speeds=2),
        Field(
            "Circulation",
            "m²/s",
            -5.0,
            35.0,
            "sequential",
            _circulation,
            void_in_reverse_flow=True,
            speeds=1,
        ),
        Field("Drag dD/dr", "N/m per blade", 0.0, 400.0, "sequential", _drag, speeds=2),
        Field("Power dP/dr", "kW/m per blade", -20.0, 150.0, "sequential", _power, speeds=3),
        Field(
            "Induced power dP/dr",
            "kW/m per blade",
            -20.0,
            80.0,
            "sequential",
            _induced_power,
            speeds=3,
        ),
        Field(
            "Profile power dP/dr",
            "kW/m per blade",
            0.0,
            100.0,
            "sequential",
            _profile_power,
            speeds=3,
        ),
        Field(
            "Stall margin",
            "°",
            -12.0,
            12.0,
            "margin",
            _degrees("margin"),
            void_in_reverse_flow=True,
        ),
        Field(
            "Separation point",
            "x/c",
            0.0,
            1.0,
            "sequential",
            _unsteady("separation"),
            True,
            needs="unsteady",
        ),
        Field(
            "Stall vortex C_n",
            "",
            0.0,
            0.5,
            "sequential",
            _unsteady("vortex"),
            True,
            needs="unsteady",
        ),
        Field("Elastic twist", "°", -4.0, 4.0, "diverging", _elastic_deg, needs="elastic_twist"),
    )
}
"""By title, in the order of the menu."""


def fields_of(solution: Solution) -> list[str]:
    """Titles of the quantities that the models of a solution have."""
    return [title for title, field in FIELDS.items() if field.exists(solution)]


def fitted_range(field: Field, values: Array, trim: float = 0.005) -> tuple[float, float]:
    """A round range that holds all but the share `trim` of `values` at each end; symmetric for a two-sided field."""
    if not values.size:
        return field.low, field.high
    low, high = (float(end) for end in np.quantile(values, (trim, 1.0 - trim)))
    if field.two_sided:
        high = max(abs(low), abs(high), 1e-3 * field.high)
        step = round_up(high / 5.0)
        high = step * math.ceil(high / step - 1e-9)
        return -high, high
    step = round_up(max(high - low, 1e-6) / 10.0)
    return step * math.floor(low / step + 1e-9), step * math.ceil(high / step - 1e-9)


CLIPPED_SHARE = 0.02
"""Share of the disk at each end that a range the page fits by itself leaves beyond it, for the sake of the rest."""


def keeps_range(field: Field, values: Array, held: tuple[float, float]) -> bool:
    """Whether a held range still fits: hardly anything beyond it, and the fitted one not much smaller."""
    low, high = held
    if not values.size:
        return True
    beyond = np.count_nonzero(values < low) + np.count_nonzero(values > high)
    fitted = fitted_range(field, values, trim=CLIPPED_SHARE)
    return bool(beyond <= 3.0 * CLIPPED_SHARE * values.size) and (fitted[1] - fitted[0]) > 0.5 * (
        high - low
    )


def usual_range(field: Field, rotor: Rotor) -> tuple[float, float]:
    """The range in which a field of this rotor is shown, whatever the design: that of the UH-60A, in proportion."""
    if field.speeds is None:
        return field.low, field.high
    usual = shipped_aircraft("uh60a").rotor_for("flight")
    ratio, of = rotor.reference_chord / usual.reference_chord, rotor.tip_speed / usual.tip_speed
    factor = ratio * of**field.speeds
    step = round_up(factor * (field.high - field.low) / 10.0)
    return step * math.floor(factor * field.low / step + 1e-9), step * math.ceil(
        factor * field.high / step - 1e-9
    )


def over_range(values: Array, held: tuple[float, float]) -> tuple[bool, bool]:
    """Whether a thousandth of the values lies below a range, and above it."""
    least = 1e-3 * values.size
    return bool(np.count_nonzero(values < held[0]) > least), bool(
        np.count_nonzero(values > held[1]) > least
    )


_FIRST_DIFFERENCE = 0.1
"""Part of a field's range, to either side, over which a difference is first shown."""
_NAMES = ("Mach", "M²")
"""What begins a title and stays capital within one."""


def shown_field(view: ViewState, pinned: Solution | None) -> Field:
    """The field that the disk shows: as it is, or B − A where wanted and a design is pinned, but not while that is
    wiped over B."""
    field = FIELDS[view.field]
    return (
        difference(field, pinned)
        if view.difference and not view.wipe and pinned is not None
        else field
    )


def difference(field: Field, pinned: Solution) -> Field:
    """`field` of a solution minus that of the pinned one, centred on zero."""
    a = DrawnSolution(pinned)

    def sample(drawn: DrawnSolution, grid: PolarGrid) -> Array:
        if not pinned.converged:
            return np.zeros(grid.shape)
        return field.sample(drawn, grid) - field.sample(a, _over(pinned, grid))

    def absent(drawn: DrawnSolution, grid: PolarGrid) -> NDArray[np.bool_]:
        del drawn
        return _absent(field, a, grid)

    name = (
        field.title if field.title.startswith(_NAMES) else field.title[0].lower() + field.title[1:]
    )
    half = round_up(_FIRST_DIFFERENCE * (field.high - field.low))
    return replace(
        field,
        title=f"Δ {name}",
        low=-half,
        high=half,
        colours="margin" if field.colours == "margin" else "diverging",
        sample=sample,
        absent=absent,
        note=", B − A",
    )


def _absent(field: Field, a: DrawnSolution, grid: PolarGrid) -> NDArray[np.bool_]:
    """Where A has no such quantity, on B's grid: beyond its blade, in its reverse flow, everywhere without a trim."""
    if not a.solution.converged:
        return np.ones(grid.shape, dtype=bool)
    disk = a.disk
    beyond = (grid.r < disk.edges[0] - 1e-9) | (grid.r > disk.edges[-1] + 1e-9)
    void = field.void(a, _over(a.solution, grid))
    beyond = np.repeat(beyond[:, None], len(grid.psi), axis=1)
    return beyond if void is None else beyond | void


def _over(pinned: Solution, grid: PolarGrid) -> PolarGrid:
    """B's points, interpolated from A's elements and azimuths, which may be others."""
    return polar_grid(
        pinned.disk, len(grid.r), len(grid.psi), (float(grid.r[0]), float(grid.r[-1]))
    )
