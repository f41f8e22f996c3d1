"""One sentence for every control and every read-out, with its equation or its section of docs/theory.md."""

from dataclasses import dataclass
from html import escape

from rotor.aero.switches import SWITCHES


@dataclass(frozen=True)
class Term:
    """The text of a tooltip."""

    sentence: str
    equations: tuple[str, ...] = ()
    """Of the source document, as numbered in docs/theory.md."""
    section: int = 0
    """Of docs/theory.md, where there is no equation; 0: neither, the entry is about the page."""

    @property
    def text(self) -> str:
        """Sentence and source."""
        if self.equations:
            name = "Eq." if len(self.equations) == 1 else "Eqs."
            return f"{self.sentence} {name} {', '.join(f'({number})' for number in self.equations)}."
        return f"{self.sentence} Theory, section {self.section}." if self.section else self.sentence


_RATE = "Twist rate in degrees per radius; negative: the outboard end is nose-down."
_CHANGE = "Change of twist rate inboard or outboard of the break point, in degrees per radius; 0 is the blade as built."
_DIVISION = "Break point: radius where two twist segments meet, as a fraction of R."
_SOURCES = {
    "flapping": ("2.39", "3.20"),
    "tip_loss": ("3.16",),
    "hub_loss": ("3.17",),
    "reverse_flow": ("3.5", "3.15"),
    "fuselage": ("3.19",),
}

CONTROLS: dict[str, Term] = {
    "view": Term("Fits into the window: the rotor, its plan view, the reference blade, or the advancing side."),
    "law": Term("How jig twist, that of the blade as built, varies along it; uniform pitch is collective.", section=4),
    "linear": Term(_RATE, section=4),
    "quadratic_curvature": Term("Second-order coefficient of the twist; 0 gives linear twist.", section=4),
    "quadratic_difference": Term("Twist at the tip minus twist at the centre of rotation.", section=4),
    **{name: Term(_CHANGE, section=4) for name in ("built_inner", "built_outer")},
    "built_division": Term(_DIVISION, section=4),
    **{name: Term(_RATE, section=4) for name in ("two_inner", "two_outer", "three_inner", "three_middle")},
    "three_outer": Term(_RATE, section=4),
    **{name: Term(_DIVISION, section=4) for name in ("two_division", "three_first", "three_second")},
    "advance_ratio": Term("Airspeed over tip speed, µ = V/ΩR; 0 is hover.", section=1),
    "mass_t": Term("Gross mass; the rotor carries its weight W = mg.", section=2),
    "altitude_m": Term(
        "Pressure altitude in the standard atmosphere: it sets air density and speed of sound.", section=2
    ),
    "climb_m_s": Term("Rate of climb, negative in descent; µ is of the horizontal speed.", section=2),
    "trim": Term(
        "Flight: weight and drag are carried. Test stand: wind tunnel, rotor without torque, or given controls; with "
        "the conditions of its tests, where a rotor was measured."
    ),
    "measured_test": Term("Tests and flights in which this rotor was measured; choose one to set its conditions."),
    "measured_point": Term("The measured points of this test or flight; choose one to set its conditions."),
    "stand_load": Term("What is given: thrust over ρA(ΩR)²σ, thrust, or the pitch at 0.75 R."),
    "stand_flapping": Term(
        "First-harmonic flapping: zero by cyclic, free at given cyclic, or free with cyclic that gives the hub moments."
    ),
    "shaft_tilt_deg": Term("Tilt of the shaft, positive forward."),
    "ct_over_sigma": Term("Blade loading CT/σ: thrust over ρA(ΩR)²σ."),
    "thrust_n": Term("Thrust along the shaft."),
    "collective_deg": Term("Pitch at 0.75 R."),
    "cyclic_1c_deg": Term("Given cyclic θ1c, cosine part; the blades flap freely."),
    "cyclic_1s_deg": Term("Given cyclic θ1s, sine part; the blades flap freely."),
    "tip_mach": Term("Tip speed over the speed of sound of the test."),
    "density": Term("Air density of the test."),
    "field": Term("Quantity on the disk.", section=8),
    "difference": Term("The quantity of this design minus that of the pinned design A."),
    "colours": Term("The colour range is held while you drag; fit it to the data here."),
    "azimuth_deg": Term(
        "Azimuth of the reference blade (red): 0° over the tail, 90° on the advancing side.", section=1
    ),
    "exaggeration": Term(
        "Exaggerates the twist of the drawn blades relative to 0.75 R; numbers stay true. Blades are drawn as flown."
    ),
    "rotor": Term("The helicopter: its blades, sections, rotor speed and mass, as built.", section=4),
    "rotor_file": Term(
        "Your own rotor: a TOML file (docs/rotor_file.md), with the decks, polars and outlines that it names."
    ),
    "preset": Term("Model choices of the source document, or the best available; each can be changed.", section=15),
    "inflow": Term("How the inflow through the disk depends on speed and load distribution.", ("3.4",)),
    "hover_inflow": Term("Hover: momentum balance of each annulus, or one equation.", ("3.3",)),
    "low_speed": Term(
        "Whether the forward wake passes over to the hover model as the speed falls to zero, or holds at any speed.",
        section=9,
    ),
    "play": Term("Turns the rotor, flapping and pitching; the solution stays the same."),
    "probe_r": Term("Radius of the probe; or click the disk, or press arrow up or down."),
    "probe_psi": Term("Azimuth of the probe, 0° over the tail; or press arrow left or right.", section=1),
    "probe_follow": Term("Keeps the probe on the reference blade."),
    "probe_shown": Term("Shows the radius and azimuth of the probe on the disk, and its section on the blade."),
    "probe_opened": Term("Draws angles up to three times larger, so that the velocity triangle can be seen."),
    "units": Term("kW, km/h, t and m, or hp, kt, lb and ft."),
    "dark": Term("Light text on a dark page."),
    "reset": Term("Returns to the design that the page opened with."),
    "paint": Term("Blue: more pitch here saves power; rust: it costs power.", section=13),
    "search_concept": Term("Family of jig-twist laws to search, from a single rate to a free form.", section=13),
    "objective": Term("Power to minimise: at this condition, in hover and cruise, or over the mission.", section=13),
    "hover_share": Term("Share of the time in hover; the rest is flown at the present condition."),
    "search_division": Term("Radius where the segments of the concept meet, as a fraction of R.", section=4),
    "starts": Term("Starting points, so that no local minimum is missed.", section=13),
    "limit_stall": Term("Limits the stalled part of the disk during the search.", section=13),
    "stalled_limit": Term("Largest permitted stalled part of the disk.", section=13),
    "limit_change": Term("Limits the change of twist, for example to the reach of an actuator.", section=13),
    "change_limit": Term("Largest permitted change from the present twist, root to tip."),
    "optimise": Term("Finds the jig twist of least power; the blade previews the best so far.", section=13),
    "stop": Term("Stops the search and keeps the best so far."),
    "replay": Term("The successive best designs of the search."),
    "search_result": Term("Puts the optimum on the sliders, discards it, or replays the search."),
    "map_across": Term("Twist parameter along the horizontal axis of the map.", section=13),
    "map_up": Term("Twist parameter along the vertical axis of the map.", section=13),
    "map_draw": Term("Power over two parameters of jig twist; every point is a trimmed design.", section=13),
    "map_point": Term("Click the map, or type x and y, to move the design there."),
    "leg": Term("Advance ratio and hours of one mission leg; 0 hours: not flown.", section=13),
    "schedule": Term("Finds the best jig twist of each leg, and the best fixed blade for all of them.", section=13),
    "schedule_stop": Term("Stops and keeps the results so far."),
    "schedule_result": Term("Puts the best fixed blade on the sliders, flies the schedule, or saves the table."),
    "cut": Term("Shows one blade cut open in place of the rotor, as flown; the ghost is the blade without voltage."),
    "magnified": Term("Exaggerates the deformation of the cut blade; the numbers stay true."),
    "voltage": Term("Per cent of the positive or, below zero, of the negative end of the voltage range."),
    "fly": Term("Flies one of the two conditions of the verdict, with its voltages and advance ratio."),
    "actuator": Term("The piezoelectric ply or torque tube that twists the blade."),
    "plies": Term("Active plies per side of the section, or number of torque tubes."),
    "span": Term("Radial extent of the actuator."),
    "chord_range": Term("Chordwise extent of the actuator; the de-icing mat covers the first 0.12 c."),
    "blade_type": Term("Retrofit of the existing blade, or a new blade designed for active twist."),
    "stiffness": Term("Torsional stiffness of the new blade, relative to the existing one."),
    "crossed": Term("Fibres at −45°: positive voltage twists the tip nose-down."),
    "derating": Term("Usable share of the nominal twist: 62 % from low-end strain and a tested blade."),
    "actuator_concept": Term("Twist concept whose optimum at each speed the actuator should reach.", section=13),
    "pair": Term("The two advance ratios between which the twist changes."),
    "harmonic": Term("Cycles of active twist per revolution; none in hover."),
    "amplitude": Term("Amplitude of the harmonic voltage, as a share of half the voltage range."),
    "phase": Term("Phase of the harmonic voltage, highest at ψ = phase/harmonic. An elastic blade follows later."),
    "pitch_per_rev": Term(
        "Harmonic of root pitch that the two sliders below set; higher-harmonic control.", section=10
    ),
    "twist_per_rev": Term("Harmonic of twist, tip relative to root, that the two sliders below set.", section=10),
    "wave_amplitude": Term("Of this harmonic, on a blade at rest; zero takes it away. Off in hover."),
    "wave_phase": Term("Of this harmonic: most nose-up at ψ = phase/n."),
    "keep": Term("Bookmarks this design (M), to return to it or to compare with it."),
    "take": Term("Step of the history to return to; a click on the strip sets it."),
    "link": Term("Copies the address of the page, which contains the whole design."),
    "save": Term("Saves the design as a file for the command line and for people."),
    "load": Term("Loads a design file (JSON); an invalid one is rejected with the reason."),
    "export_shape": Term(
        "One blade in jig shape, for manufacture, or as flown at its azimuth, or the trimmed rotor: closed surfaces in "
        "metres, without exaggeration."
    ),
    "export_table": Term(
        "Every quantity over the disk, the blade at the present azimuth, or power over µ, with units."
    ),
    "export_picture": Term("The disk from above as a vector drawing, or the scene as the page shows it, as pixels."),
    "export_scene": Term("The 3D scene as one HTML file that opens without a server and can be turned."),
    "export_report": Term("This design, A and all bookmarks in one file that opens without a server."),
    "close": Term("Closes this window."),
    "pin": Term("Undo, redo; pin: this design becomes A, and every change is B beside it."),
    "pinned": Term("Swap A and B, or return the sliders to A."),
    "along": Term("On: A flies at the speed, mass, altitude and climb of the sliders. Off: A stays as it was pinned."),
    "lecture": Term("Seven steps that set the page and say what to watch. Keys: Page Down, Page Up."),
    "big_type": Term("Larger text, for a lecture room."),
    "lecture_flights": Term("Sets the advance ratio.", section=1),
    "document_case": Term("Designs that the source document states, and examples in its preset.", section=15),
    "present": Term("Copies a link with which others follow this page without changing it."),
    "study": Term("A result of `python -m rotor study` on this server."),
    "study_look": Term("Looks for new results."),
    "study_file": Term("Opens one result file from this computer."),
    "study_chart": Term("One quantity over another, hover over cruise, or all axes side by side."),
    "study_axis": Term("The quantity along this axis."),
    "study_colour": Term("The quantity that colours the points."),
    "study_cruise": Term("The cruise speed that is compared with hover."),
    "study_point": Term("Click a point, or type its number, to put its design on the sliders."),
    "leave": Term("Stops following the presenter; the page is yours from here."),
    "lecture_step": Term("Previous step, reset this step, next step, or end the lecture and return to your design."),
    **{name: Term(f"{s.on} Off: {s.off}", _SOURCES.get(name, ()), 5) for name, s in SWITCHES.items()},
}
"""By the field of `Inputs` or `ViewState`, or a name of the widget's own."""

READOUTS: dict[str, Term] = {
    "total_power": Term("Power of the main rotor and of the tail rotor that balances its torque.", section=12),
    "change": Term("Total power relative to the reference design."),
    "induced": Term("Σ λi dFz: power to make lift.", section=12),
    "profile": Term("Σ U dD: power dissipated by the drag of the blade sections.", ("3.15",)),
    "parasite": Term("D·V: power to overcome fuselage drag.", ("3.19",)),
    "climb": Term("W·V_c: gain of potential energy in a second; negative in descent.", section=12),
    "propulsive": Term("Propulsive force times airspeed; negative where the stream drives the rotor.", section=12),
    "tail": Term("Power of the tail rotor, which balances the torque.", section=12),
    "kappa": Term(
        "κ: induced power relative to uniform loading, C_T λ0. Ideal: the least of any circulation of the same lifting "
        "lines with the same lift, C_l ≤ 1.2, none in reverse flow; in hover momentum theory.",
        ("2.30",),
    ),
    "collective": Term("θ0: pitch at 0.75 R, mean over azimuth.", section=1),
    "cyclic_1c": Term("θ1c: lateral cyclic, the cos ψ part of pitch.", section=1),
    "cyclic_1s": Term(
        "θ1s: longitudinal cyclic, the sin ψ part of pitch; negative reduces pitch on the advancing side.", section=1
    ),
    "shaft_tilt": Term("α: forward tilt of the shaft, so that thrust overcomes drag.", section=11),
    "coning": Term("β0: mean flap angle, the balance of lift and centrifugal force.", ("2.41",)),
    "flapping_1": Term("β1c, β1s: tilt of the tip-path plane; β1c < 0 tilts it back.", ("2.41",)),
    "flap_1c": Term("β1c: longitudinal flapping; negative tilts the disk back.", ("2.41",)),
    "flap_1s": Term("β1s: lateral flapping.", ("2.41",)),
    "ct_over_sigma": Term("Blade loading: thrust coefficient over solidity.", ("2.11", "2.19")),
    "figure_of_merit": Term("Ideal over actual power in hover; 1 is ideal momentum theory.", ("2.10",)),
    "lift_to_drag": Term("Weight times speed, over the sum of induced and profile power.", section=12),
    "reverse_flow_area": Term("Part of the disk in reverse flow, U_T < 0.", ("3.5",)),
    "stalled_area": Term("Part of the disk that is stalled, reverse flow excluded.", section=5),
    "speed": Term("Airspeed V = µΩR.", section=1),
    "status": Term("Convergence of the trim, caveats, and the models used.", section=11),
    "elastic_tip": Term(
        "Elastic twist of the tip, mean over azimuth. Flown twist = jig twist + elastic twist.",
        section=10,
    ),
    "elastic_wave": Term("Elastic twist of the tip: amplitude of its 1/rev part.", section=10),
    "pitch_link": Term("Force of one pitch link, mean over azimuth; positive where it holds the nose up.", section=10),
    "pitch_link_wave": Term("Force of one pitch link: half of peak to peak.", section=10),
    "probe_alpha": Term("α = θ − φ: pitch minus inflow angle.", section=8),
    "probe_region": Term("Attached, stalled, beyond drag divergence, or in reverse flow.", section=5),
    "probe_u_t": Term(
        "Tangential velocity, in the plane of the disk and normal to the blade; negative: reverse flow.", ("3.5",)
    ),
    "probe_u_p": Term("Perpendicular velocity, down through the disk: inflow, flapping and coning.", ("3.6",)),
    "probe_induced": Term("Downward velocity induced by the wake.", section=9),
    "probe_theta": Term("Local pitch: collective, cyclic and twist.", section=1),
    "probe_jig": Term("Twist as built, zero at 0.75 R: what the sliders set.", section=4),
    "probe_elastic": Term("By how much the blade twists here under its loads; part of the pitch.", section=10),
    "probe_phi": Term("Inflow angle φ = atan2(U_P, U_T); near 180° in reverse flow.", section=8),
    "probe_margin": Term("Margin to the stall angle of the section at this Mach number.", section=5),
    "probe_section": Term("Source of the section coefficients.", section=5),
    "probe_mach": Term("Resultant velocity over the speed of sound.", section=8),
    "probe_cl": Term("Section lift coefficient at this α and Mach number.", section=5),
    "probe_cd": Term("Section drag coefficient at this α and Mach number.", section=5),
    "probe_cm": Term("Section moment coefficient about the quarter chord, nose-up positive.", section=5),
    "probe_moment": Term(
        "Moment of one blade about its quarter chord, per metre of span; nose-up positive.", section=5
    ),
    "probe_public": Term(
        "Published coefficients of this section nearest to this Mach number and α, and the section data at the same "
        "point.",
        section=5,
    ),
    "probe_ratio": Term("Lift over drag of the section.", section=5),
    "probe_m2cn": Term("M²c_n: normal force per unit span over ½γp c, the usual measure of airloads.", section=8),
    "probe_drag": Term("Drag of one blade per metre of span, along the local flow.", ("3.8",)),
    "probe_thrust": Term(
        "Thrust of one blade per metre of span, along the shaft, with tip and root losses.", ("2.17", "3.8")
    ),
    "probe_torque": Term("Torque of one blade per metre of span, about the shaft.", ("2.18", "3.10")),
    "probe_power": Term("Torque times rotor speed; negative where the flow drives the blade.", section=12),
    "fly_measured": Term("Sets the condition in which this was measured; the blade stays as it is."),
    "probe_measured": Term(
        "Airloads measured over a revolution at the radius and in the condition nearest to the probe's, as points, and "
        "ours as a line.",
        section=5,
    ),
    "drag_band": Term(
        "Total power of this flight trimmed with the lowest and the highest drag area that the sources of the "
        "airframe allow."
    ),
    "chart_lift_curve": Term(
        "Lift curve of the section at this Mach number, the present point on it, and public data within 0.05 of Mach.",
        section=5,
    ),
    "chart_sensitivity": Term("Power sensitivity to local pitch along the blade, retrimmed.", section=13),
}


def hint(name: str) -> str:
    """What a control says when it is pointed at; KeyError for one without an entry."""
    return CONTROLS[name].text


def tip(name: str) -> str:
    """The HTML attribute by which a read-out explains itself; KeyError for one without an entry."""
    return f' title="{escape(READOUTS[name].text, quote=True)}"'
