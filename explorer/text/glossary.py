"""One sentence for every control and every read-out, with the equation or the section of docs/theory.md behind it."""

from dataclasses import dataclass
from html import escape

from rotor.aero.switches import SWITCHES


@dataclass(frozen=True)
class Term:
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

CONTROLS: dict[str, Term] = {
    "view": Term("Fits it into the window: the rotor, its plan, the marked blade, the advancing side."),
    "law": Term("How the pitch changes along the blade; what is common to all of it is the collective's.", section=4),
    "linear": Term(_RATE, section=4),
    "quadratic_curvature": Term("Second-order coefficient of the twist; 0 is the linear law.", section=4),
    "quadratic_difference": Term("Twist at the tip minus twist at the centre.", section=4),
    **{name: Term(_RATE, section=4) for name in ("two_inner", "two_outer", "three_inner", "three_middle")},
    "three_outer": Term(_RATE, section=4),
    **{name: Term(_DIVISION, section=4) for name in ("two_division", "three_first", "three_second")},
    "advance_ratio": Term("Airspeed over tip speed, µ = V/ΩR; 0 is hover.", section=1),
    "mass_t": Term("Gross mass; the rotor carries its weight W = mg.", section=2),
    "altitude_m": Term("Pressure altitude in the standard atmosphere: thinner air, slower sound.", section=2),
    "field": Term("What colours the disk.", section=8),
    "difference": Term("The field of this design minus that of the pinned one."),
    "colours": Term("The range of the colours stays as it is while you drag; fit it to the data here."),
    "outline_reverse_flow": Term("Draws where air meets the blade from behind, U_T < 0.", ("3.5",)),
    "outline_stall": Term("Draws where the angle of attack is beyond the section's stall angle.", section=5),
    "outline_drag_divergence": Term("Draws where drag grows by 0.1 per Mach number.", section=5),
    "azimuth_deg": Term("Place of the marked blade: 0° over the tail, 90° on the advancing side.", section=1),
    "exaggeration": Term("Exaggerates the twist of the drawn blades only."),
    "rotor": Term("Which helicopter's rotor: its blades, sections, speed and weight, as it is built.", section=4),
    "rotor_file": Term(
        "A rotor of your own: a TOML file (docs/rotor_file.md); decks, polars and outlines it names before or after it."
    ),
    "preset": Term("What the source document states, or what we believe; each choice can be changed.", section=15),
    "inflow": Term("How the air through the disk answers to speed and load.", ("3.4",)),
    "infinite": Term("The same wake averaged over time: the rotor that textbooks untwist for speed.", section=9),
    "vortex_check": Term("Solves the same design with rigid helical vortices, the reference of the others.", section=9),
    "play": Term("Walks the marked blade round the disk, flapping and pitching as it does; nothing is solved anew."),
    "play_speed": Term("How fast the marked blade is walked; a real one needs a fraction of a second for a turn."),
    "probe_r": Term("Where along the blade; or click the disk, or press arrow up and down."),
    "probe_psi": Term("Where round the disk, 0° over the tail; arrow left and right.", section=1),
    "probe_follow": Term("The probe sits on the marked blade: where one goes, the other follows."),
    "probe_shown": Term("Ring and ray on the disk where the probe is, and its section on the blade."),
    "probe_opened": Term("Draws angles up to three times wider, to make the triangle of velocities visible."),
    "units": Term("kW, km/h, t and m, or hp, kt, lb and ft."),
    "dark": Term("Light letters on a dark page."),
    "reset": Term("Back to the design the page began with."),
    "paint": Term("Blue: more pitch here saves power; rust: it costs.", section=13),
    "search_concept": Term("Kind of twist law to search, from one rate to a free form.", section=13),
    "objective": Term("What the search makes small: here, in hover and here, or over the mission.", section=13),
    "hover_share": Term("Part of the time spent hovering; the rest is flown as set."),
    "search_division": Term("Where the segments of the search meet, as a fraction of the radius.", section=4),
    "starts": Term("Descents from different twists, so that no valley is missed.", section=13),
    "limit_stall": Term("Holds the stalled part of the disk down while searching.", section=13),
    "stalled_limit": Term("Largest stalled part of the disk that a found blade may have.", section=13),
    "limit_change": Term("Stays within reach of an actuator.", section=13),
    "change_limit": Term("Largest change of twist from the present one, root to tip."),
    "optimise": Term("Searches the twist of least power; the blade shows what is tried.", section=13),
    "stop": Term("Ends the search and keeps the best so far."),
    "replay": Term("The designs on the way to the best."),
    "search_result": Term("Puts the best on the sliders, goes back, or shows the way once more."),
    "map_across": Term("Parameter of the twist along the map's width.", section=13),
    "map_up": Term("Parameter of the twist along the map's height.", section=13),
    "map_draw": Term("Trims a design at every point: power over two parameters of the twist.", section=13),
    "map_point": Term("Click the map, or write x and y: the design goes there."),
    "leg": Term("Advance ratio and hours of one leg of the mission; no hours: not flown.", section=13),
    "schedule": Term("Finds the best twist of every leg, and the best one blade for all.", section=13),
    "schedule_stop": Term("Ends the work and keeps what is known."),
    "schedule_result": Term("Puts the best one blade on the sliders, or saves the table."),
    "cut": Term("Shows one blade, opened, in place of the rotor."),
    "magnified": Term("Exaggerates the movement in the cut blade only."),
    "voltage": Term("Per cent of the positive, or of the smaller negative, end of the voltage range."),
    "fly": Term("Sets the voltages of the verdict at one of its flight conditions, and the advance ratio with them."),
    "actuator": Term("Which piezoelectric ply or torque tube turns the blade."),
    "plies": Term("Active plies on either side of the section; tubes, for the tube."),
    "span": Term("Where along the radius the actuator lies."),
    "chord_range": Term("Where along the chord it lies; the de-ice mat heats the first 0.12 c."),
    "blade_type": Term("The blade that is flown, or one built to be turned."),
    "stiffness": Term("Torsional stiffness of the new blade over the flown one's."),
    "crossed": Term("Fibres laid at −45°: positive voltage turns the tip down."),
    "derating": Term("Share of the nominal twist to count on: 62 % by low-end strain and what a tested blade showed."),
    "actuator_concept": Term("Kind of twist whose best at either speed the actuator should reach.", section=13),
    "pair": Term("The two advance ratios between which the twist would change."),
    "harmonic": Term("How often the twist goes up and down in a revolution; it rests in hover."),
    "amplitude": Term("Of the twist that follows the azimuth, as part of half the voltage range."),
    "phase": Term("Of the twist that follows the azimuth: the tip is most nose-up at phase over harmonic."),
    "keep": Term("Sets the design aside (M), to come back to or to compare with."),
    "take": Term("Clicks on the strip write here which step to take."),
    "link": Term("Copies the page's address, which holds the whole design."),
    "save": Term("Saves the design as a file that people and the command line can read."),
    "load": Term("Takes a design file (JSON); a bad one says why and changes nothing."),
    "export_shape": Term("One blade, or the rotor in trim, as closed surfaces: metres, true scale, no exaggeration."),
    "export_table": Term("Every field over the disk; the blade at the marked azimuth; power over µ. With units."),
    "export_picture": Term("The disk from above, or the rotor as you see it, with flight, power, scale and caveats."),
    "export_size": Term("Width and height of the picture; the letters grow with it."),
    "export_own": Term("Width and height [px], 300 to 4096, the longer at most two and a half times the shorter."),
    "export_clear": Term("Leaves the background out, for slides that have their own."),
    "export_kind": Term("Pixels, or, of the disk, a drawing that is sharp at any size."),
    "export_report": Term("All designs of the session, A and the kept ones too, in one file that needs no server."),
    "export_text": Term("A script or a command that computes this design's power elsewhere, to the last digit."),
    "close": Term("Closes this window."),
    "pin": Term("Back, forth; pin: every change becomes B beside A."),
    "pinned": Term("Swap: A goes on the sliders and B becomes A; back: the sliders of A."),
    "along": Term("On: A at the speed, weight and altitude on the sliders; off: A as it was when it was pinned."),
    "lecture": Term("Eight steps that set the page and say what to watch; keys: Page down, up."),
    "big_type": Term("Larger letters, for those who sit at the back."),
    "lecture_flights": Term("Sets the advance ratio.", section=1),
    "document_case": Term("The document's own designs, in its preset.", section=15),
    "present": Term("Gives a link by which others follow this page without moving it."),
    "study": Term("A result of `python -m rotor study` that this server can read."),
    "study_look": Term("Looks for results that have come since the page was opened."),
    "study_file": Term("Takes one chunk of a result from this computer."),
    "study_chart": Term("One quantity against another, hover against cruise, or all axes side by side."),
    "study_axis": Term("The quantity along this axis."),
    "study_colour": Term("The quantity that colours the points."),
    "study_cruise": Term("The speed that hover is compared with."),
    "study_point": Term("Click a point, or write its number: the design goes on the sliders."),
    "leave": Term("Stops following the presenter; this page goes on from here."),
    "lecture_step": Term("A step back, this step once more, a step on, or the end of the lecture."),
    **{name: Term(f"{s.on} Off: {s.off}", _SOURCES.get(name, ()), 5) for name, s in SWITCHES.items()},
}
"""By the field of `Inputs` or `ViewState`, or a name of the widget's own."""

READOUTS: dict[str, Term] = {
    "total_power": Term("Power of the main rotor and of the tail rotor that balances its torque.", section=12),
    "change": Term("Total power of this design against that of the design it is compared with."),
    "induced": Term("Σ λi dFz: power that goes into pushing air down.", section=12),
    "profile": Term("Σ U dD: power that friction and pressure drag of the blades dissipate.", ("3.15",)),
    "parasite": Term("D·V: power that drags the fuselage through the air.", ("3.19",)),
    "tail": Term("Power of the tail rotor, which balances the torque.", section=12),
    "kappa": Term(
        "κ: induced power over that of an even load, C_T λ0. "
        "Ideal: the least of any circulation with this lift and C_l ≤ 1.2.",
        ("2.30",),
    ),
    "vortex_check": Term("The same design with rigid helical vortices, and how far the answer is from it.", section=9),
    "collective": Term("θ0: pitch at 0.75 R, common to all azimuths.", section=1),
    "cyclic_1c": Term("θ1c: pitch that goes with cos ψ; it tilts the disk to the side.", section=1),
    "cyclic_1s": Term("θ1s: pitch that goes with sin ψ; negative takes lift from the advancing side.", section=1),
    "shaft_tilt": Term("α: how far the shaft leans forward, so that the thrust overcomes the drag.", section=11),
    "coning": Term("β0: how far the blades bend up about their hinges under lift and centrifugal force.", ("2.41",)),
    "flapping_1": Term("β1c, β1s: tilt of the disk of blade tips; β1c < 0 leans back.", ("2.41",)),
    "flap_1c": Term("β1c: flapping that goes with cos ψ; negative when the disk tilts back.", ("2.41",)),
    "flap_1s": Term("β1s: flapping that goes with sin ψ; the disk tilts to the side.", ("2.41",)),
    "ct_over_sigma": Term("Blade loading: thrust coefficient over solidity.", ("2.11", "2.19")),
    "figure_of_merit": Term("Ideal over actual power in hover; 1 is momentum theory.", ("2.10",)),
    "lift_to_drag": Term("Weight times speed over induced and profile power.", section=12),
    "reverse_flow_area": Term("Part of the disk where the blade meets the air from behind, U_T < 0.", ("3.5",)),
    "stalled_area": Term("Part of the disk beyond the stall angle, reverse flow not counted.", section=5),
    "speed": Term("Airspeed V = µΩR.", section=1),
    "status": Term("How the trim ended, reasons to read it with care, and how it was computed.", section=11),
    "chart_power": Term("Total power over speed; hover stands alone, because it is another model.", section=12),
    "chart_apart": Term("Total power of B minus that of A over speed.", section=12),
    "chart_twist": Term("Twist along the blade; zero at 0.75 R.", section=4),
    "chart_alpha": Term("Angle of attack along the marked blade, and its stall angles; gaps: reverse flow.", section=8),
    "chart_lift": Term("Section lift coefficient along the marked blade.", ("3.8",)),
    "probe_alpha": Term("α = θ − φ: pitch less inflow angle, about the blade's reference line.", section=8),
    "probe_region": Term("Attached, beyond the stall angle, beyond drag divergence, or met from behind.", section=5),
    "probe_u_t": Term("Velocity in the plane of the disk and normal to the blade; negative: from behind.", ("3.5",)),
    "probe_u_p": Term("Velocity down through the blade: inflow, flapping and coning.", ("3.6",)),
    "probe_induced": Term("Velocity down that the rotor's own wake induces here.", section=9),
    "probe_theta": Term("Pitch here: collective, cyclic and twist.", section=1),
    "probe_phi": Term(
        "How steeply the air comes down, φ = atan2(U_P, U_T); near 180° it comes from behind.", section=8
    ),
    "probe_margin": Term("Angle of attack left before the section stalls at this Mach number.", section=5),
    "probe_section": Term("Whose measured or computed coefficients hold here.", section=5),
    "probe_mach": Term("Resultant velocity over the speed of sound.", section=8),
    "probe_cl": Term("Section lift coefficient at this α and Mach number.", section=5),
    "probe_cd": Term("Section drag coefficient at this α and Mach number.", section=5),
    "probe_ratio": Term("Lift over drag of the section.", section=5),
    "probe_m2cn": Term("Normal force over chord and γp/2: what vibration and stall are read from.", section=8),
    "probe_drag": Term("Force along the flow, of one blade and a metre of it.", ("3.8",)),
    "probe_thrust": Term("Force along the shaft, of one blade and a metre of it; losses taken off.", ("2.17", "3.8")),
    "probe_torque": Term("About the shaft, against the rotation, of one blade and a metre of it.", ("2.18", "3.10")),
    "probe_power": Term("Torque times rotor speed; negative where the air drives the blade.", section=12),
    "chart_lift_curve": Term("The section's own curve at this Mach number, and where the element is on it.", section=5),
    "chart_sensitivity": Term("What a degree more pitch costs at each place along the blade, trim kept.", section=13),
}


def hint(name: str) -> str:
    """What a control says when it is pointed at; KeyError for one without an entry."""
    return CONTROLS[name].text


def tip(name: str) -> str:
    """The HTML attribute by which a read-out explains itself; KeyError for one without an entry."""
    return f' title="{escape(READOUTS[name].text, quote=True)}"'
