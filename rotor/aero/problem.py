"""A design on its grid: the arrays and coefficients that no iteration changes."""

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from rotor.aero.air import AirMotion, air_motion
from rotor.aero.bending import HARMONICS as BENDING_HARMONICS
from rotor.aero.bending import MODES, REFERENCE_COLLECTIVE, BladeBending, build_bending, can_bend
from rotor.aero.bent_section import BentData, bending_interface
from rotor.aero.disk import Disk, azimuths_of, build_disk, build_onset
from rotor.aero.dynamic_stall import StallData
from rotor.aero.elastic import HARMONICS as TORSION_HARMONICS
from rotor.aero.elastic import MODES as TORSION_MODES
from rotor.aero.elastic import BladeTorsion, build_torsion
from rotor.aero.inflow import DiskFlow, InflowModel, inflow_model
from rotor.aero.inflow.interface import InflowTerms, Losses, SectionInterface
from rotor.aero.lifting_line import WakeCourse, tip_core
from rotor.aero.momentum import glauert_inflow
from rotor.aero.section import LOSS, NO_INCREMENTS, NO_MOMENT, NO_SCATTER, SectionData
from rotor.aero.stalling_section import StallingData, stalling_interface
from rotor.aero.unsteady_section import UnsteadyData, unsteady_interface
from rotor.design.design import Design
from rotor.dynamics.flapping import FlapDynamics, flap_dynamics
from rotor.support.arrays import Array, Booleans
from rotor.support.compiled import compiled

LOW_MACH = 0.3
"""Mach number of the section data when compressibility is switched off: that of the document's polar (Re 3.68 million).
Lift is within 5 % of incompressible there (Prandtl–Glauert), and far from drag rise."""

FREE_ROTOR_DRAG = 0.011
"""Mean section drag coefficient for a first estimate of a free rotor's shaft tilt."""

_ALL_LOADED = np.zeros((0, 0), np.bool_)


@dataclass(frozen=True, eq=False)
class Problem:
    """A design on its grid: the arrays and coefficients that no iteration changes."""

    design: Design
    disk: Disk
    air: AirMotion
    """How the air moves at the elements, but for what the load there induces."""
    twist: Array
    """θ_tw at the elements [rad]."""
    waves: Array
    """Active twist and n/rev root pitch [rad], (elements, azimuths), or (1, 1) where neither is given."""
    flap: FlapDynamics
    tip_mach: float
    weight: float
    """C_W with the download and the vertical part of the drag, which the rotor carries; on a test stand the C_T given,
    or an estimate where the collective is given."""
    scale: float
    """What residuals are measured by: C_W, and on a test stand C_T, at least 0.02 σ."""
    drag: float
    """Horizontal part of the fuselage drag over ρA(ΩR)²."""
    inflow: InflowModel
    unloaded: Booleans | None
    """Elements that carry no load, (elements, azimuths): the reverse-flow region r < −µ sin ψ, where it is switched
    off. Its border is drawn with µ, not µ cos α, so that it stays fixed during the trim and derivatives stay exact."""
    torsion: BladeTorsion | None
    """The blade in torsion; None for a rigid blade."""
    bending: BladeBending | None
    """The blade in flap and lag; None for one that flaps as a rigid blade."""
    stall: StallData | None
    """For dynamic stall; None without it."""
    unsteady: bool
    """Whether attached flow is unsteady, see `rotor.aero.unsteady_section`."""
    wave_rates: tuple[Array, Array]
    """First and second derivative of `waves` by ψ, shaped alike."""
    given_torsion: Array
    """Residual of the torsion equations by the twist of the blade as built and by `waves` alone, scaled to radians,
    (modes, functions)."""
    expected: DiskFlow
    """The flow of momentum theory when the disk is normal to the resultant of weight and drag."""
    course: WakeCourse
    """Along which a wake of vortices lies; see `rotor.trim.forward`."""
    freedoms: tuple[Any, ...] = ()
    """Further degrees of freedom of the blade, each a `rotor.columns.blade.Freedom`."""
    scatter: Array = field(default_factory=lambda: NO_SCATTER)
    """By how much the section data are changed, see `rotor.aero.section`."""
    tip_spacing: float = 1.0
    """Factor on f of Prandtl's tip loss."""

    @cached_property
    def arm(self) -> Array:
        """r − e, from the hinge, (elements,)."""
        return self.disk.r - self.flap.hinge

    @cached_property
    def inflow_terms(self) -> InflowTerms:
        """The inflow model on this disk."""
        models = self.design.models
        losses = Losses(
            tip=models.tip_loss, hub=models.hub_loss, on=models.loss_on, spacing=self.tip_spacing
        )
        terms = self.inflow.on(self.disk, self.course, losses)
        return terms.unsteady(self.half_chord) if self.unsteady else terms

    @cached_property
    def interface(self) -> SectionInterface:
        """The section of the inflow model: unsteady or not, on a blade that bends or does not."""
        return self.with_effects(self.inflow_terms.interface)

    def with_effects(self, section: SectionInterface) -> SectionInterface:
        """A section with dynamic stall, unsteady flow and bending, as far as the problem has them."""
        section = section if self.stall is None else stalling_interface(section)
        section = unsteady_interface(section) if self.unsteady else section
        return section if self.bending is None else bending_interface(section)

    def grid_data(self, step: int) -> SectionData | StallingData | UnsteadyData | BentData:
        """What `interface` needs beside the channels, on every `step`-th azimuth."""
        plain, bending = self.section_data(step), self.bending
        data = plain if self.stall is None else StallingData(plain, self.stall)
        data = self.unsteady_data(plain, data) if self.unsteady else data
        if bending is None:
            return data
        return BentData(
            data, coupling=bending.coupling, reference=bending.reference, share=bending.share
        )

    def unsteady_data(
        self, section: SectionData, within: SectionData | StallingData
    ) -> UnsteadyData:
        """What a section in unsteady flow needs beside the channels; within: data of the section in it."""
        arm = 0.5 * self.half_chord + (0.0 if self.torsion is None else self.torsion.lag)
        mass = math.pi * section.half_solidity * self.half_chord
        return UnsteadyData(section, within, half_chord=self.half_chord, arm=arm, mass=mass)

    @cached_property
    def half_chord(self) -> Array:
        """b/R, (elements,)."""
        rotor = self.design.rotor
        return 0.5 * rotor.blade.chord(self.disk.r) / rotor.radius

    def section_data(self, step: int = 1) -> SectionData:
        """What forces need beside the channels, on every `step`-th azimuth."""
        disk, torsion, unloaded = self.disk, self.torsion, self.unloaded
        return SectionData(
            half_solidity=disk.half_solidity,
            section=disk.section,
            weight=disk.weight,
            offset=disk.offset,
            tables=disk.tables,
            held=disk.held,
            delay=disk.delay,
            missing=disk.missing,
            held_missing=disk.held_missing,
            cos_sweep=disk.cos_sweep,
            sin_sweep=disk.sin_sweep,
            tip_mach=self.tip_mach,
            yawed=self.design.models.has("radial_friction"),
            lossy=(LOSS, "loss") in self.inflow_terms.live and not self.design.hovering,
            unloaded=_ALL_LOADED if unloaded is None else np.ascontiguousarray(unloaded[:, ::step]),
            added=NO_INCREMENTS,
            scatter=self.scatter,
            **(
                NO_MOMENT
                if torsion is None
                else {name: getattr(torsion, name) for name in NO_MOMENT}
            ),
        )


def build_problem(design: Design) -> Problem:
    """The design on its grid."""
    rotor, condition, models = design.rotor, design.condition, design.models
    check_azimuths(design)
    drag, down = design.drag_parts
    inflow = inflow_model(models.inflow)
    only_mach, swept = None if models.compressibility else LOW_MACH, models.has("swept_tip")
    elements, azimuths = grid_of(design)
    shown = {"swept": swept, "surface": models.has("surface_drag"), "fine_tip": inflow.fine_tip}
    shown["stalls"] = models.stall
    shown["delays"] = models.has("stall_delay")
    reynolds = design.reynolds_per_metre if rotor.blade.follows_reynolds else 0.0
    disk = build_disk(
        rotor, elements=elements, azimuths=azimuths, only_mach=only_mach, reynolds=reynolds, **shown
    )
    flow = expected_flow(design)
    download = (
        design.fuselage.hover_download
        if models.has("download") and condition.stand is None
        else 0.0
    )
    weight = design.weight_coefficient
    if download:
        weight *= 1.0 + download * (max(flow.axial, 0.0) / flow.speed) ** 2
    weight += down
    twist, flap = (
        design.twist(disk.r),
        flap_dynamics(rotor, condition.density, blade_weight=models.blade_weight),
    )
    waves, *rates = _pitch_waves(design, disk)
    torsion = bending = None
    if models.bending and design.flaps and not design.hovering and can_bend(rotor):
        bending = build_bending(
            rotor,
            disk,
            condition.density,
            modes=MODES,
            harmonics=BENDING_HARMONICS,
            reference=REFERENCE_COLLECTIVE,
        )
    highest = TORSION_HARMONICS if bending is None else BENDING_HARMONICS
    if models.has("elastic_twist") and rotor.blade.structure is not None:
        torsion = build_torsion(
            rotor,
            disk,
            condition.density,
            only_mach=only_mach,
            swept=swept,
            highest=highest,
            count=TORSION_MODES,
        )
    stall = _stall_data(design, disk, inflow)
    return Problem(
        design=design,
        disk=disk,
        air=air_motion(design, disk),
        twist=twist,
        waves=waves,
        flap=flap,
        tip_mach=design.tip_mach,
        weight=weight,
        scale=weight if condition.stand is None else max(weight, 0.02 * rotor.solidity),
        drag=drag,
        inflow=inflow,
        expected=flow,
        course=expected_course(design, flow, flap),
        unloaded=_unloaded(design, disk),
        torsion=torsion,
        bending=bending,
        stall=stall,
        unsteady=models.has("unsteady") and not design.hovering,
        wave_rates=(rates[0], rates[1]),
        given_torsion=np.zeros(0)
        if torsion is None
        else given_torsion(torsion, twist, waves, rates[1]),
    )


def _stall_data(design: Design, disk: Disk, inflow: InflowModel) -> StallData | None:
    """What dynamic stall needs, where the models have it."""
    rotor, models = design.rotor, design.models
    if not models.has("dynamic_stall") or design.hovering or not inflow.pointwise:
        return None
    numbers, tables = build_onset(disk, None if models.compressibility else LOW_MACH)
    own = {
        "numbers": numbers,
        "tables": tables,
        "half_chord": 0.5 * (rotor.blade.chord(disk.r) / rotor.radius),
    }
    return StallData(
        **own,
        section=disk.section,
        weight=disk.weight,
        tip_mach=design.tip_mach,
        delay=disk.delay,
    )


def grid_of(design: Design) -> tuple[int, int]:
    """Elements and azimuths on which a design is solved."""
    return inflow_model(design.models.inflow).grid(design.models, design.rotor.blades)


def check_azimuths(design: Design) -> None:
    """Raise ValueError, with one sentence, where the azimuths are too few for the pitch at n/rev."""
    active = () if design.active_twist is None else design.active_twist.harmonics
    highest = max((harmonic.per_rev for harmonic in (*active, *design.pitch_per_rev)), default=0)
    if 2 * highest >= (azimuths := grid_of(design)[1]):
        raise ValueError(
            f"{highest}/rev needs more than {2 * highest} azimuths, not {azimuths}: ask for more"
        )


def on_azimuths(problem: Problem, azimuths: int) -> Problem:
    """The problem on the same elements and another number of azimuths."""
    psi = azimuths_of(azimuths)
    disk = replace(problem.disk, psi=psi, cos=np.cos(psi), sin=np.sin(psi))
    waves, *rates = _pitch_waves(problem.design, disk)
    air = replace(air_motion(problem.design, disk), joined=problem.air.joined)
    unloaded = _unloaded(problem.design, disk)
    return replace(
        problem, disk=disk, air=air, waves=waves, wave_rates=(rates[0], rates[1]), unloaded=unloaded
    )


def _pitch_waves(design: Design, disk: Disk) -> list[Array]:
    """`Problem.waves` and its first two derivatives by ψ."""
    given, none = design.pitch_waves, np.zeros((1, 1))
    return [
        sum((wave(disk.r, disk.psi, order) for wave in given), start=none) for order in range(3)
    ]


def _unloaded(design: Design, disk: Disk) -> Booleans | None:
    """Elements that carry no load, see `Problem`."""
    if design.models.reverse_flow:
        return None
    return disk.r[:, None] + design.condition.advance_ratio * disk.sin < 0.0


def given_torsion(torsion: BladeTorsion, twist: Array, waves: Array, acceleration: Array) -> Array:
    """Tension on the built-in and the active twist, and the inertia of what follows the azimuth, (modes, functions)."""
    forcing = np.zeros((len(torsion.gain), torsion.functions))
    forcing[:, 0] = torsion.tension @ twist
    if waves.size > 1:
        forcing += torsion.harmonics(torsion.tension @ waves)
        forcing += torsion.harmonics(torsion.modal(torsion.inertia[:, None] * acceleration))
    return torsion.gain[:, None] * forcing


def expected_flow(design: Design) -> DiskFlow:
    """The flow of momentum theory when the disk is normal to the resultant of weight and drag.

    On a test stand: at the shaft tilt given. A free rotor's that is not given follows from its drag-to-lift ratio,
    µ tan α = −C_P/C_T with C_P = σ C_d0/8 (1 + 4.65 µ²) + C_T²/2µ.
    """
    drag, down = design.drag_parts
    weight, mu = design.weight_coefficient + down, design.condition.advance_ratio
    tilt = math.atan2(drag, weight)
    stand = design.condition.stand
    if stand is not None:
        tilt = stand.tilt
        if stand.shaft_tilt is None and design.models.trim == "free-rotor":
            profile = design.rotor.solidity * FREE_ROTOR_DRAG / 8.0 * (1.0 + 4.65 * mu**2)
            tilt = -math.atan2(profile + weight**2 / (2.0 * mu), mu * weight)
    mu_x, mu_z = design.in_disk_axes(tilt)
    return DiskFlow(mu_x, mu_z, glauert_inflow(math.hypot(weight, drag), mu_x, mu_z)[0])


def expected_course(design: Design, flow: DiskFlow, flap: FlapDynamics) -> WakeCourse:
    """Course of the wake by momentum theory under blades that cone with its thrust and flap as given."""
    condition, rotor = design.condition, design.rotor
    thrust = 2.0 * flow.lambda0 * flow.speed
    coning = flap.load_gain * 0.7 * thrust - flap.droop if rotor.precone is None else rotor.precone
    chord = float(rotor.blade.chord(0.9)) / rotor.radius
    reynolds = condition.density * rotor.tip_speed * rotor.radius / condition.viscosity
    core = tip_core(chord, thrust, rotor.blades, reynolds)
    flapping = {"coning": coning, "flap_1c": condition.flap_1c, "flap_1s": condition.flap_1s}
    return WakeCourse(flow.mu_x, flow.mu_z, flow.lambda0, **flapping, core=core)


@compiled(error_model="numpy")
def swirl_of(r: Any, product: Any) -> Any:
    """Swirl in the disk over ΩR and its slope by `product` = λ_i λ, the induced times the total axial flow; shape of r.

    The air leaves turning with the rotor: torque and thrust of an annulus give u = λ_i λ/r at the disk, half of what is
    far below (Johnson, Helicopter Theory, §2-3; Glauert 1935). u = q r/(r² + q) with q = λ_i λ is the same for r² ≫ q
    and stays below r at the centre. In forward flight λ_i is the mean inflow λ0 and λ is µ_z + λ0, and the swirl all
    but disappears.
    """
    below = r * r + product
    return product * r / below, r * r * r / (below * below)
