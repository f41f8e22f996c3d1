"""One sentence for every control and every read-out, with the equation or the section of docs/theory.md behind it."""

from dataclasses import dataclass
from html import escape

from rotor.switches import SWITCHES


@dataclass(frozen=True)
class Entry:
    """What people read when they point at something."""

    sentence: str
    equations: tuple[str, ...] = ()
    """Of the source document, as numbered in docs/theory.md."""
    section: int = 0
    """Of docs/theory.md, where no equation says it; 0: neither, a matter of the page."""

    @property
    def text(self) -> str:
        """Sentence and source."""
        if self.equations:
            name = "Eq." if len(self.equations) == 1 else "Eqs."
            return f"{self.sentence} {name} {', '.join(f'({number})' for number in self.equations)}."
        return f"{self.sentence} Theory, section {self.section}." if self.section else self.sentence


_RATE = "Slope of the twist in degrees per radius; negative: the outer end is nose-down."
_DIVISION = "Where two segments of twist meet, as a fraction of the radius."
_SOURCES = {
    "flapping": ("2.39", "3.20"),
    "tip_loss": ("3.16",),
    "hub_loss": ("3.17",),
    "reverse_flow": ("3.5", "3.15"),
    "fuselage": ("3.19",),
}

CONTROLS: dict[str, Entry] = {
    "view": Entry("Fits it into the window: the rotor, its plan, the marked blade, the advancing side."),
    "law": Entry("How the pitch changes along the blade; what is common to all of it is the collective's.", section=4),
    "linear": Entry(_RATE, section=4),
    "quadratic_curvature": Entry("Second-order coefficient of the twist; 0 is the linear law.", section=4),
    "quadratic_difference": Entry("Twist at the tip minus twist at the centre.", section=4),
    **{name: Entry(_RATE, section=4) for name in ("two_inner", "two_outer", "three_inner", "three_middle")},
    "three_outer": Entry(_RATE, section=4),
    **{name: Entry(_DIVISION, section=4) for name in ("two_division", "three_first", "three_second")},
    "advance_ratio": Entry("Airspeed over tip speed, µ = V/ΩR; 0 is hover.", section=1),
    "mass_t": Entry("Gross mass; the rotor carries its weight W = mg.", section=2),
    "altitude_m": Entry("Pressure altitude in the standard atmosphere: thinner air, slower sound.", section=2),
    "field": Entry("What colours the disk.", section=8),
    "difference": Entry("The field of this design minus that of the pinned one."),
    "colours": Entry("The range of the colours stays as it is while you drag; fit it to the data here."),
    "outline_reverse_flow": Entry("Draws where air meets the blade from behind, U_T < 0.", ("3.5",)),
    "outline_stall": Entry("Draws where the angle of attack is beyond the section's stall angle.", section=5),
    "outline_drag_divergence": Entry("Draws where drag grows by 0.1 per Mach number.", section=5),
    "azimuth_deg": Entry("Place of the marked blade: 0° over the tail, 90° on the advancing side.", section=1),
    "exaggeration": Entry("Exaggerates the twist of the drawn blades only."),
    "preset": Entry("What the source document states, or what we believe; each choice can be changed.", section=15),
    "inflow": Entry("How the air through the disk answers to speed and load.", ("3.4",)),
    "infinite": Entry("The same wake averaged over time: the rotor that textbooks untwist for speed.", section=9),
    "vortex_check": Entry(
        "Solves the same design with rigid helical vortices, the reference of the others.", section=9
    ),
    "play": Entry("Walks the marked blade round the disk, flapping and pitching as it does; nothing is solved anew."),
    "play_speed": Entry("How fast the marked blade is walked; a real one needs a fraction of a second for a turn."),
    "probe_r": Entry("Where along the blade; or click the disk, or press arrow up and down."),
    "probe_psi": Entry("Where round the disk, 0° over the tail; arrow left and right.", section=1),
    "probe_follow": Entry("The probe sits on the marked blade: where one goes, the other follows."),
    "probe_shown": Entry("Ring and ray on the disk where the probe is, and its section on the blade."),
    "probe_opened": Entry("Draws angles up to three times wider, to make the triangle of velocities visible."),
    "units": Entry("kW, km/h, t and m, or hp, kt, lb and ft."),
    "dark": Entry("Light letters on a dark page."),
    "reset": Entry("Back to the design the page began with."),
    "waterfall": Entry("Computes thirteen trims after each change, when the page rests.", section=16),
    "paint": Entry("Blue: more pitch here saves power; rust: it costs.", section=13),
    **{name: Entry(f"{s.on} Off: {s.off}", _SOURCES.get(name, ()), 5) for name, s in SWITCHES.items()},
}
"""By the field of `Inputs` or `ViewState`, or a name of the widget's own."""

READOUTS: dict[str, Entry] = {
    "total_power": Entry("Power of the main rotor and of the tail rotor that balances its torque.", section=12),
    "change": Entry("Total power of this design against that of the design it is compared with."),
    "induced": Entry("Σ λi dFz: power that goes into pushing air down.", section=12),
    "profile": Entry("Σ U dD: power that friction and pressure drag of the blades dissipate.", ("3.15",)),
    "parasite": Entry("D·V: power that drags the fuselage through the air.", ("3.19",)),
    "tail": Entry("Power of the tail rotor, which balances the torque.", section=12),
    "kappa": Entry(
        "κ: induced power over that of an even load, C_T λ0. "
        "Ideal: the least of any circulation with this lift and C_l ≤ 1.2.",
        ("2.30",),
    ),
    "vortex_check": Entry("The same design with rigid helical vortices, and how far the answer is from it.", section=9),
    "collective": Entry("θ0: pitch at 0.75 R, common to all azimuths.", section=1),
    "cyclic_1c": Entry("θ1c: pitch that goes with cos ψ; it tilts the disk to the side.", section=1),
    "cyclic_1s": Entry("θ1s: pitch that goes with sin ψ; negative takes lift from the advancing side.", section=1),
    "shaft_tilt": Entry("α: how far the shaft leans forward, so that the thrust overcomes the drag.", section=11),
    "coning": Entry("β0: how far the blades bend up about their hinges under lift and centrifugal force.", ("2.41",)),
    "flapping_1": Entry("β1c, β1s: tilt of the disk of blade tips; β1c < 0 leans back.", ("2.41",)),
    "flap_1c": Entry("β1c: flapping that goes with cos ψ; negative when the disk tilts back.", ("2.41",)),
    "flap_1s": Entry("β1s: flapping that goes with sin ψ; the disk tilts to the side.", ("2.41",)),
    "ct_over_sigma": Entry("Blade loading: thrust coefficient over solidity.", ("2.11", "2.19")),
    "figure_of_merit": Entry("Ideal over actual power in hover; 1 is momentum theory.", ("2.10",)),
    "lift_to_drag": Entry("Weight times speed over induced and profile power.", section=12),
    "reverse_flow_area": Entry("Part of the disk where the blade meets the air from behind, U_T < 0.", ("3.5",)),
    "stalled_area": Entry("Part of the disk beyond the stall angle, reverse flow not counted.", section=5),
    "speed": Entry("Airspeed V = µΩR.", section=1),
    "status": Entry("How the trim ended, reasons to read it with care, and how it was computed.", section=11),
    "chart_power": Entry("Total power over speed; hover stands alone, because it is another model.", section=12),
    "chart_apart": Entry("Total power of B minus that of A over speed.", section=12),
    "chart_twist": Entry("Twist along the blade; zero at 0.75 R.", section=4),
    "chart_alpha": Entry(
        "Angle of attack along the marked blade, and its stall angles; gaps: reverse flow.", section=8
    ),
    "chart_lift": Entry("Section lift coefficient along the marked blade.", ("3.8",)),
    "probe_alpha": Entry("α = θ − φ: pitch less inflow angle, about the blade's reference line.", section=8),
    "probe_region": Entry("Attached, beyond the stall angle, beyond drag divergence, or met from behind.", section=5),
    "probe_u_t": Entry("Velocity in the plane of the disk and normal to the blade; negative: from behind.", ("3.5",)),
    "probe_u_p": Entry("Velocity down through the blade: inflow, flapping and coning.", ("3.6",)),
    "probe_induced": Entry("Velocity down that the rotor's own wake induces here.", section=9),
    "probe_theta": Entry("Pitch here: collective, cyclic and twist.", section=1),
    "probe_phi": Entry(
        "How steeply the air comes down, φ = atan2(U_P, U_T); near 180° it comes from behind.", section=8
    ),
    "probe_margin": Entry("Angle of attack left before the section stalls at this Mach number.", section=5),
    "probe_section": Entry("Whose measured or computed coefficients hold here.", section=5),
    "probe_mach": Entry("Resultant velocity over the speed of sound.", section=8),
    "probe_cl": Entry("Section lift coefficient at this α and Mach number.", section=5),
    "probe_cd": Entry("Section drag coefficient at this α and Mach number.", section=5),
    "probe_ratio": Entry("Lift over drag of the section.", section=5),
    "probe_m2cn": Entry("Normal force over chord and γp/2: what vibration and stall are read from.", section=8),
    "probe_drag": Entry("Force along the flow, of one blade and a metre of it.", ("3.8",)),
    "probe_thrust": Entry("Force along the shaft, of one blade and a metre of it; losses taken off.", ("2.17", "3.8")),
    "probe_torque": Entry("About the shaft, against the rotation, of one blade and a metre of it.", ("2.18", "3.10")),
    "probe_power": Entry("Torque times rotor speed; negative where the air drives the blade.", section=12),
    "chart_lift_curve": Entry(
        "The section's own curve at this Mach number, and where the element is on it.", section=5
    ),
    "chart_sensitivity": Entry("What a degree more pitch costs at each place along the blade, trim kept.", section=13),
}


def hint(name: str) -> str:
    """What a control says when it is pointed at; KeyError for one without an entry."""
    return CONTROLS[name].text


def tip(name: str) -> str:
    """The HTML attribute by which a read-out explains itself; KeyError for one without an entry."""
    return f' title="{escape(READOUTS[name].text, quote=True)}"'
