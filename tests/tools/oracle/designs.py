"""Designs of every kind: each rotor, preset, trim, inflow and twist law, each effect left out, slow, fast and bent."""

from collections.abc import Iterable, Mapping
from typing import Any

from .record import Record

DREES = {"inflow": "drees"}
"""A model of few equations: most of what is read of a solution does not depend on the inflow."""
QUICK = {"inflow": "uniform", "elements": 12, "azimuths": 24}
"""A model for what solves many designs."""

FLOWN: Mapping[str, Mapping[str, Any]] = {
    "as built": {"mu": 0.2},
    "hover": {"hover": True},
    "hover, linear": {"hover": True, "twist": "linear:-8"},
    "hover, closed form": {"hover": True, "inflow": "closed-form"},
    "hover, hot and high": {"hover": True, "altitude_m": 2000.0, "isa_offset_c": 20.0},
    "hover, climbing": {"hover": True, "climb_m_s": 4.0},
    "slow": {"mu": 0.03},
    "slow, heavy": {"mu": 0.04, "mass_kg": 9000.0, "twist": "linear:-16"},
    "slow, wake": {"mu": 0.06, "low_speed": "wake"},
    "slower than 0.1": {"mu": 0.08, "twist": "quadratic:6,-14"},
    "fast": {"mu": 0.35},
    "fast and heavy": {"mu": 0.4, "mass_kg": 10500.0, **DREES},
    "beyond its trim": {"mu": 0.5, "mass_kg": 11000.0},
    "knots": {"speed_kt": 120.0, "drag_area_m2": 3.0},
    "bent": {"mu": 0.3, "bending": True},
    "bent, linear": {"mu": 0.25, "bending": True, "twist": "linear:-12"},
    "bent, 3/rev": {"mu": 0.3, "bending": True, "twist_per_rev": "3:1:180"},
    "2/rev twist": {"mu": 0.2, "twist_per_rev": "2:1.5:90", **DREES},
    "2 and 3/rev pitch": {"mu": 0.25, "pitch_per_rev": "2:1:30,3:0.4:-60", **DREES},
    "climbing": {"mu": 0.1, "climb_m_s": 3.0},
    "descending": {"mu": 0.12, "climb_m_s": -3.0, **DREES},
    "fast rotor": {"mu": 0.2, "rotor_speed_percent": 105.0, **DREES},
    "turning": {"mu": 0.2, "load_factor": 1.2, **DREES},
    "few stations": {"mu": 0.2, **QUICK},
    "thesis": {"mu": 0.2, "preset": "thesis"},
    "thesis, hover": {"hover": True, "preset": "thesis"},
    "thesis, linear": {"mu": 0.3, "preset": "thesis", "twist": "linear:-10"},
    "loss on inflow": {"mu": 0.2, "loss_on": "inflow", **DREES},
    "thrust trim": {"mu": 0.25, "trim": "thrust", **DREES},
    "other sections": {"mu": 0.2, "airfoils": "sc1094r8,sc1095@0.5", **DREES},
}
"""The UH-60A in flight, by what is told of it."""

TWISTS = (
    "linear:-8", "linear:8", "linear:-30", "quadratic:6,-14", "segments:-14,-8@0.5", "segments:-4,-16,-8@0.4,0.8",
    "segments:-12,-10,-8,-6@0.3,0.5,0.7", "spline:6,0,-4,-6@0.2,0.5,0.8,1", "points:8,2,-6@0.2,0.6,1", "ideal:2",
    "ideal", "builtin", "uh60a",
)  # fmt: skip
"""SPECs of twist laws."""

INFLOWS = (
    "uniform", "coleman", "drees", "white-blake", "pitt-peters", "pitt-peters-15pi/23", "local-momentum",
    "lifting-line",
)  # fmt: skip
SWITCHES = (
    "flapping", "tip-loss", "hub-loss", "reverse-flow", "compressibility", "surface-drag", "swept-tip",
    "radial-friction", "elastic-twist", "unsteady", "dynamic-stall", "swirl", "fuselage", "download", "stall",
)  # fmt: skip
ROTORS = ("r22", "s61", "gazelle", "bo105")
"""Helicopters beside the UH-60A."""

STANDS: Mapping[str, Mapping[str, Any]] = {
    "free rotor": {"rotor": "pca2", "trim": "free-rotor"},
    "free rotor, tilted": {"rotor": "pca2", "trim": "free-rotor", "mu": 0.3, "stand": {"collective_deg": 2.0}},
    "free rotor, loaded": {"rotor": "pca2", "trim": "free-rotor", "mu": 0.25, "stand": {"ct_over_sigma": 0.05}},
    "free uh60a": {"trim": "free-rotor", "mu": 0.3, "stand": {"collective_deg": 2.0}},
    "tunnel": {"rotor": "pca2", "mu": 0.2, "trim": "wind-tunnel", "stand": {"ct_over_sigma": 0.06}},
    "tunnel, tilted": {"rotor": "xv15", "mu": 0.17, "stand": {"ct_over_sigma": 0.08, "shaft_tilt_deg": 15.0}},
    "tunnel, newtons": {"mu": 0.2, "trim": "wind-tunnel", "stand": {"thrust_n": 60000.0, "shaft_tilt_deg": -5.0}},
    "tunnel, Mach": {
        "mu": 0.25, "trim": "wind-tunnel",
        "stand": {
            "ct_over_sigma": 0.075, "tip_mach": 0.6, "density_kg_m3": 1.1, "flapping": "free", "cyclic_1s_deg": -4.0,
        },
    },
    "tunnel, hub moments": {
        "mu": 0.2, "trim": "wind-tunnel", "bending": True,
        "stand": {"ct_over_sigma": 0.07, "flapping": "hub-moments", "hub_roll_nm": 500.0, "hub_pitch_nm": 300.0},
    },
    "controls": {"mu": 0.2, "trim": "controls", "stand": {"collective_deg": 7.0, "cyclic_1s_deg": -4.0}},
    "controls, down": {"mu": 0.2, "trim": "controls", "stand": {"collective_deg": -4.0}},
    "stand, hover": {"rotor": "knight-hefner-3", "hover": True, "trim": "controls", "stand": {"collective_deg": 8.0}},
    "stand, four blades": {"rotor": "knight-hefner-4", "hover": True},
    "stand, twisted": {"rotor": "castles-gray-twisted", "hover": True, "climb_m_s": -3.0},
    "stand, tapered": {"rotor": "castles-gray-tapered", "hover": True},
    "stand, lift": {"rotor": "caradonna-tung", "hover": True},
    "2mrts": {"rotor": "2mrts", "mu": 0.15},
    "hart2": {"rotor": "hart2", "mu": 0.15},
}  # fmt: skip
"""Rotors alone, on a test stand."""


def all_designs() -> dict[str, Mapping[str, Any]]:
    """Arguments of `make_design` by name."""
    found = dict(FLOWN)
    found |= {f"twist {spec}": {"mu": 0.25, "twist": spec, **DREES} for spec in TWISTS}
    found |= {f"inflow {name}": {"mu": 0.2, "inflow": name} for name in INFLOWS}
    found |= {f"slow {name}": {"mu": 0.05, "inflow": name} for name in INFLOWS}
    found |= {f"without {name}": {"mu": 0.3, "off": name} for name in SWITCHES}
    found |= {f"hover without {name}": {"hover": True, "off": name} for name in SWITCHES}
    for rotor in ROTORS:
        found[rotor] = {"rotor": rotor, "mu": 0.2}
        found[f"{rotor}, hover"] = {"rotor": rotor, "hover": True}
        found[f"{rotor}, linear"] = {"rotor": rotor, "mu": 0.25, "twist": "linear:-8", **DREES}
    return found | dict(STANDS)


def solve_named(record: Record, names: Iterable[str], prefix: str = "") -> dict[str, Any]:
    """Solutions of designs by name, which `prefix` begins; those that do not trim are left out."""
    found = dict[str, Any]()
    arguments = all_designs()
    for name in names:
        design = record.make(f"{prefix}{name}/design", "rotor.make_design", **arguments[name])
        solution = record.make(f"{prefix}{name}/solution", "rotor.solve", design)
        if solution is not None and solution.converged:
            found[prefix + name] = solution
    return found
