"""What a solve returns: status and sentence, trim, fields over the disk, power by parts.

One file, because they are the parts of one value, and whoever reads a result finds here what each number means.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from typing import Any

import numpy as np

from rotor.aero.bending import BladeFrequencies, blade_frequencies
from rotor.aero.disk import OnDisk
from rotor.aero.display import STALLED, Regions, pitch_of_alpha
from rotor.aero.elements import TrimState, Unsteady
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.momentum import axial_inflow
from rotor.columns.blade import Freedom
from rotor.design.design import Design
from rotor.engine.waves import waves_at
from rotor.support.arrays import Array, Booleans, ShortRepr
from rotor.support.markup import Markup, group, tag
from rotor.support.table import LEFT, Column, table
from rotor.support.units import power_unit
from rotor.support.user_input import shorten
from rotor.trim.newton import Guess
from rotor.trim.power import HubMoment, PowerBudget


class Status(Enum):
    """How a solve ended; its value is the text in JSON and tables."""

    CONVERGED = "converged"
    NOT_CONVERGED = "not-converged"


@dataclass(frozen=True)
class Caveat:
    """A limit of validity that a solution exceeds, as `Solution.caveats` lists them."""

    name: str
    """Short and stable, for scripts, for example low-speed-inflow."""
    sentence: str
    """The sentence for the user."""


@dataclass(frozen=True, eq=False, repr=False)
class DiskFields(OnDisk, ShortRepr):
    """The flow and the loads over the disk; arrays are (elements, azimuths) unless said otherwise.

    On at least the azimuths that the models ask for, also where the trim was solved on fewer.
    """

    r: Array
    """Element centres y/R, (elements,)."""
    dr: Array
    """Element widths over R, (elements,)."""
    psi: Array
    """Azimuth [rad], 0 over the tail, (azimuths,)."""
    theta: Array
    """Pitch with twist [rad]."""
    u_t: Array
    """In-plane velocity normal to the blade, over ΩR."""
    u_p: Array
    """Velocity down through the blade, over ΩR."""
    u_r: Array
    """Velocity outward along the blade, over ΩR."""
    induced: Array
    """λ_i, over ΩR."""
    inflow: Array
    """Total inflow through the disk, µ_z + λ_i, over ΩR."""
    alpha: Array
    """Angle of attack at the blade's reference line [rad], in (−π, π]."""
    mach: Array
    cl: Array
    cd: Array
    cd_mach: Array
    """∂C_d/∂M, whose value 0.1 marks drag divergence."""
    stall_margin: Array
    """Static stall angle less angle of attack [rad]: negative past it, π/2 in reverse flow."""
    dct: Array
    """dC_T/dr of the whole rotor as if smeared."""
    dcq: Array
    """dC_Q/dr over r: in-plane force opposing rotation, of the whole rotor as if smeared; dC_P/dr = r·dcq."""
    dcr: Array
    """Force outward along the blade, of the whole rotor as if smeared."""
    elastic_twist: Array | None = None
    """φ, by which the blade twists under its loads [rad], contained in `theta`; None for a rigid blade."""
    unsteady: Unsteady | None = None
    """State of dynamic stall; None without it."""
    find_apparent: Callable[[], Array] | None = field(default=None, repr=False)
    """The function that `apparent` calls; None in steady flow."""

    @cached_property
    def apparent(self) -> Array | None:
        """What apparent mass adds to C_n and to C_m about the quarter chord, (2, elements, azimuths); None in steady
        flow."""
        return None if self.find_apparent is None else self.find_apparent()

    @property
    def pitch_of_alpha(self) -> Array:
        """Pitch θ plus the part of α from the flow at three-quarter chord [rad], see `display.pitch_of_alpha`."""
        return self.theta if self.find_apparent is None else pitch_of_alpha(self)

    @property
    def stalled(self) -> Booleans:
        """Where the flow is separated: over 30 % of the chord, or in steady flow beyond the stall angle; not in reverse
        flow, (elements, azimuths)."""
        if self.unsteady is None:
            separated = self.stall_margin < 0.0
        else:
            separated = self.unsteady.separation < STALLED
        return separated & (self.u_t >= 0.0)


@dataclass(frozen=True, eq=False, repr=False)
class ElasticTwist(ShortRepr):
    """The elastic twist of the blade and the load that it puts on the controls."""

    coordinates: Array
    """Amplitude of every torsion mode in the harmonics 1, cos ψ, sin ψ, cos 2ψ, … [rad], (modes, harmonics)."""
    shapes: Array
    """The modes at the elements, 1 at the tip, (modes, elements)."""
    frequencies: Array
    """Frequencies of the modes [per rev], (modes,)."""
    tip: Array
    """φ at the tip [rad], (azimuths,)."""
    along_blade: Array
    """Mean of φ around the disk [rad], (elements,): flown twist less built-in twist."""
    control_moment: Array
    """Moment of the control system on one blade [N m], nose up, (azimuths,)."""
    pitch_link_load: Array
    """Force of one pitch link [N], (azimuths,), positive where it holds the nose up."""
    control_power: float
    """Power [W] that pitch links and actuators put into the pitching blades, in all; not part of `PowerBudget`."""

    @property
    def first_harmonic(self) -> float:
        """Amplitude of the 1/rev part of `tip` [rad]."""
        return float(np.hypot(*self.coordinates[:, 1:3].sum(axis=0)))


@dataclass(frozen=True, eq=False)
class Deflections:
    """Bending of a blade, measured from a straight blade with the coning and first-harmonic flapping of the trim."""

    r: Array
    """Stations over R, (stations,), from the hinge, or where the blade is held, to the tip."""
    up: Array
    """w less flapping [m] in the waves 1, cos ψ, sin ψ, cos 2ψ, …, (stations, waves)."""
    forward: Array
    """v from the steadily lagged blade [m], in the same waves."""

    def at(self, r: Array, psi: float) -> tuple[Array, Array]:
        """Deflection up and forward [m] at stations r/R of a blade at ψ [rad], (stations,) each; 0 inside the root."""
        waves = waves_at(self.up.shape[1], np.array([psi]))[:, 0]
        up = np.interp(r, self.r, self.up @ waves, left=0.0)
        forward = np.interp(r, self.r, self.forward @ waves, left=0.0)
        return up, forward


@dataclass(frozen=True, eq=False)
class Shown:
    """Fields, regions and caveats of a solution, on at least the azimuths that the models ask for."""

    disk: DiskFields
    regions: Regions
    elastic: ElasticTwist | None
    caveats: tuple[Caveat, ...] = ()


_NO_THRUST = 1e-12
"""Ideal power over ρA(ΩR)³ below which there is none but rounding."""


@dataclass(frozen=True, eq=False, repr=False)
class Solution:
    """A trimmed rotor, or the last iterate of one that did not trim.

    Numbers are in SI units and radians, fields over the disk (elements, azimuths): `disk`. What needs a trim, as
    `power`, raises RuntimeError with `message` where `converged` is false.
    """

    design: Design
    status: Status
    message: str
    controls: TrimState
    last_power: PowerBudget
    """Power by parts of the last iterate, converged or not; `power` is the same for a converged solution only."""
    hub_moment: HubMoment
    ct: float
    """Thrust over ρA(ΩR)², eq. (2.11)."""
    lift_and_drag: tuple[float, float]
    """Force of the rotor up and aft [N]: in level flight and on a stand normal to the wind and along it."""
    cp: float
    """Main-rotor power over ρA(ΩR)³, eq. (2.12)."""
    residual: float
    """Largest trim residual, as a fraction of the weight (moments: of weight × radius)."""
    passes: int
    """Blade-element passes used."""
    elapsed: float
    """[s]"""
    find_shown: Callable[["Solution"], Shown]
    """The function that `shown` calls."""
    evaluated: Any = None
    """`Problem` and `BladeElements` on the azimuths of the trim; None: they are made once more for `shown`."""
    start: Guess = field(default_factory=lambda: Guess(TrimState()))
    """The guess from which the next trim may start."""
    before: tuple[Design, Guess] | None = None
    """The design and trim that it was itself started from: a next step in the same direction starts ahead of both."""
    wake_course: WakeCourse | None = None
    """Where the wake of a lifting line lies; None with other inflow models, and in hover."""
    freedoms: tuple[Freedom, ...] = ()
    """Freedoms of the blade that `solve` was given beside the design's."""
    freedom_states: dict[str, float] = field(default_factory=dict[str, float])
    """States of the further freedoms by name."""
    deflections: Deflections | None = None
    """How blades bend; None where they flap as rigid blades."""

    def __getstate__(self) -> dict[str, Any]:
        small = {
            "start": replace(self.start, box=None, structure=None),
            "before": None,
            "evaluated": None,
        }
        return self.__dict__ | small

    def light(self) -> "Solution":
        """This solution in at most 50 kB, for those who keep many.

        Its fields are computed again when they are read; trims that start from it take more steps.
        """
        return replace(self, start=replace(self.start, box=None), before=None, evaluated=None)

    @cached_property
    def shown(self) -> Shown:
        """Fields, regions and caveats, worked out when first read: that takes a fifth of the time of a trim."""
        return self.find_shown(self)

    @property
    def disk(self) -> DiskFields:
        """The flow and the loads over the disk."""
        return self.shown.disk

    @property
    def regions(self) -> Regions:
        """Areas of the disk and parts of the thrust: reverse flow, separated flow, past the static stall angle, beyond
        drag divergence."""
        return self.shown.regions

    @property
    def reverse_flow_area(self) -> float:
        """Part of the disk πR² with U_T < 0 on the blade (0…1)."""
        return self.regions.reverse_flow

    @property
    def stalled_area(self) -> float:
        """Part of the disk πR² where the flow is separated: over 30 % of the chord, or in steady flow beyond the stall
        angle; reverse flow not counted (0…1)."""
        return self.regions.separated

    @property
    def past_static_area(self) -> float:
        """Part of the disk πR² past the static stall angle with the flow still attached; reverse flow not counted
        (0…1). 0 for steady sections."""
        return self.regions.past_static

    @property
    def stalled_thrust(self) -> float:
        """Part of the thrust that separated sections carry [-]; negative if their lift is downward."""
        return self.regions.separated_thrust

    @property
    def stalled_moment(self) -> float:
        """Part of the lift moment about the hub, Σ r dT, that separated sections carry [-]."""
        return self.regions.separated_moment

    @property
    def least_margin(self) -> float:
        """Least distance to separation outside reverse flow, negative where `stalled_area` is not 0: of the angle of
        attack [rad], or with dynamic stall of the separation point [chords]."""
        return self.regions.least_margin

    @property
    def elastic(self) -> ElasticTwist | None:
        """Elastic twist and control loads; None for a blade that is rigid in torsion."""
        return self.shown.elastic

    @property
    def caveats(self) -> tuple[Caveat, ...]:
        """Limits of validity that the solution exceeds; none where it is not in trim."""
        return self.shown.caveats if self.converged else ()

    def __repr__(self) -> str:
        state = f"{self.status.value}: {self.message}"
        if self.caveats:
            state += f" Caveats: {', '.join(caveat.name for caveat in self.caveats)}."
        return f"{self.design}\n{state}\n{self._power_text()}"

    def _power_text(self) -> str:
        """Power and its parts, as `power 903.2 kW: induced 385.0, profile 308.7, …`."""
        if not self.converged:
            return "power: none, the rotor is not in trim"
        seldom = [name for name in ("climb", "damping") if getattr(self.power, name)]
        parts = ("induced", "profile", "parasite", *seldom, "tail")
        powers = {part: getattr(self.power, part) for part in parts}
        total = self.power.total
        symbol, size = power_unit(total, *powers.values())
        listed = ", ".join(f"{part} {power / size:z.1f}" for part, power in powers.items())
        return f"power {total / size:z.1f} {symbol}: {listed}"

    def _repr_html_(self) -> str:
        state = [f"{self.status.value}: {self.message}"]
        state += [f"Caveat: {caveat.sentence}" for caveat in self.caveats]
        powers = self._power_table() if self.converged else None
        return group(tag("p", str(self.design)), powers, *(tag("p", words) for words in state))

    def _power_table(self) -> Markup:
        """The total power and its parts that are not zero."""
        total = self.last_power.total
        powers = {"total": total}
        for name, value in vars(self.last_power).items():
            if value and name != "shaft":
                powers[name] = value
        symbol, size = power_unit(total)
        rows = [(name, value / size) for name, value in powers.items()]
        return table((Column("power", LEFT), Column(symbol, "z.1f")), rows).html()

    @property
    def converged(self) -> bool:
        """Whether the rotor is in trim."""
        return self.status is Status.CONVERGED

    @property
    def power(self) -> PowerBudget:
        """Power by parts. Raises RuntimeError when the solution did not converge: it has no power then."""
        if not self.converged:
            raise RuntimeError(
                f"This solution has no power because it did not converge. {self.message} "
                "The power of the last iterate is in last_power."
            )
        return self.last_power

    @cached_property
    def blade_frequencies(self) -> BladeFrequencies | None:
        """Frequencies of the blade at its pitch in the trim; None where its stiffness in bending is not known."""
        return blade_frequencies(self.design.rotor, self.design.twist, self.controls.collective)

    @property
    def ct_over_sigma(self) -> float:
        """C_T/σ, the blade loading."""
        return self.ct / self.design.rotor.solidity

    @property
    def cq(self) -> float:
        """C_Q: torque of the shaft over ρA(ΩR)²R."""
        return self.last_power.shaft / self.design.power_unit

    @property
    def torque(self) -> float:
        """Torque of the shaft [N m]."""
        return self.last_power.shaft / self.design.rotor.angular_speed

    @property
    def figure_of_merit(self) -> float | None:
        """Ideal induced power over induced and profile power [-], in hover and axial flight only.

        The power of the climb is not counted: it would make any rotor look better the faster it climbs.
        """
        power = (self.last_power.induced + self.last_power.profile) / self.design.power_unit
        if not self.design.hovering or power <= 0.0:
            return None
        ideal = abs(self.ct) ** 1.5 / np.sqrt(2.0).item()
        if self.design.vertical_ratio:
            ideal = self.ct * axial_inflow(self.ct, self.design.vertical_ratio)
        return ideal / power

    @property
    def induced_power_factor(self) -> float | None:
        """κ = C_Pi/(C_T λ0): induced power over that of uniform loading by momentum theory; None without thrust."""
        ideal = self.ct * self.controls.lambda0
        if abs(ideal) > _NO_THRUST:
            return self.last_power.induced / (ideal * self.design.power_unit)
        return None

    @property
    def lift_to_drag(self) -> float | None:
        """Rotor L/D_e = W V/(P_induced + P_profile) [-], with the lift for W on a test stand; forward flight only."""
        rotor_power = self.last_power.induced + self.last_power.profile
        if self.design.hovering or rotor_power <= 0.0:
            return None
        lift = self.design.condition.load
        if self.design.condition.stand is not None:
            lift = self.lift_and_drag[0]
        return lift * self.design.airspeed / rotor_power

    def require(self) -> "Solution":
        """This solution, or RuntimeError with its sentence when it did not converge."""
        if not self.converged:
            raise RuntimeError(self.message)
        return self


def require_solution(given: object) -> Solution:
    """The argument, if it is a solution; TypeError with one sentence otherwise."""
    if not isinstance(given, Solution):
        raise TypeError(f"solution is {shorten(repr(given), 80)}: give what rotor.solve returns")
    return given
