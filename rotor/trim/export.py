"""A solution as the record of `solve --json`, as a file and as a picture."""

import json
import math
from pathlib import Path
from typing import Any, cast

import numpy as np

from rotor.aero.switches import switched_off
from rotor.design.active_twist import active_twist_record, harmonics_record
from rotor.design.aircraft import reported_names
from rotor.design.quantities import UNUSUAL
from rotor.support.arrays import Array
from rotor.support.assets import package_version
from rotor.support.plots import new_axes
from rotor.support.user_input import check_known, check_suffix, write_whole
from rotor.trim.solution import ElasticTwist, Solution, require_solution

SCHEMA = "rotor-explorer solution 1"
"""Of `solution_record`: another number where a key goes or changes its meaning. The keys: docs/formats.md."""
_RIGID = (
    "elastic_twist_deg",
    "torsion_frequencies_per_rev",
    "pitch_link_load_n",
    "control_power_w",
)
_DEGREES = math.degrees(1.0)
DISK_LABELS: dict[str, tuple[str, float]] = {
    "alpha": ("Angle of attack [°]", _DEGREES),
    "theta": ("Pitch [°]", _DEGREES),
    "stall_margin": ("Stall margin [°]", _DEGREES),
    "induced": ("Induced inflow λi", 1.0),
    "inflow": ("Total inflow λ", 1.0),
    "u_t": ("Tangential velocity U_T/ΩR", 1.0),
    "u_p": ("Perpendicular velocity U_P/ΩR", 1.0),
    "mach": ("Mach number", 1.0),
    "cl": ("Lift coefficient", 1.0),
    "cd": ("Drag coefficient", 1.0),
    "dct": ("Thrust loading dC_T/dr", 1.0),
    "dcq": ("In-plane loading dC_H/dr", 1.0),
    "elastic_twist": ("Elastic twist [°]", _DEGREES),
}
"""Fields that `plot_field` draws: label, and factor from SI to the unit of the label."""

_POWERS = ("total", "main_rotor", "induced", "profile", "parasite", "climb", "damping", "tail")
_ANGLES = ("collective", "cyclic_1c", "cyclic_1s", "coning", "flap_1c", "flap_1s", "shaft_tilt")


def solution_record(solution: Solution) -> dict[str, Any]:
    """The record that `rotor solve --json` prints: numbers and texts only, None for what did not converge.

    Keys end in their unit: docs/formats.md. Raises TypeError for anything but a solution.
    """
    design, controls, power = (
        require_solution(solution).design,
        solution.controls,
        solution.last_power,
    )
    stand, carried = design.condition.stand, design.rotor.blade.carried
    values: dict[str, Any] = {
        "power_w": {
            name: getattr(power, name) for name in _POWERS if name != "damping" or solution.freedoms
        },
        **({"freedoms": solution.freedom_states} if solution.freedoms else {}),
        "ct": solution.ct,
        "cp": solution.cp,
        "ct_over_sigma": solution.ct_over_sigma,
        "cq": solution.cq,
        "cq_over_sigma": solution.cq / design.rotor.solidity,
        "shaft_torque_nm": solution.torque,
        "rotor_lift_n": solution.lift_and_drag[0],
        "rotor_drag_n": solution.lift_and_drag[1],
        **{f"{name}_deg": math.degrees(getattr(controls, name)) for name in _ANGLES},
        "lambda0": controls.lambda0,
        "reverse_flow_area_percent": 100.0 * solution.reverse_flow_area,
        "stalled_area_percent": 100.0 * solution.stalled_area,
        "dynamic_stall": solution.disk.unsteady is not None,
        "stalled_percent": {
            "area": 100.0 * solution.stalled_area,
            "thrust": 100.0 * solution.stalled_thrust,
            "moment": 100.0 * solution.stalled_moment,
        },
        "past_static_percent": {
            "area": 100.0 * solution.past_static_area,
            "thrust": 100.0 * solution.regions.past_static_thrust,
        },
        **(_elastic_record(solution.elastic) if solution.elastic else dict.fromkeys(_RIGID)),
    }
    return {
        "schema": SCHEMA,
        "version": package_version(),
        "rotor": design.rotor.name,
        "status": solution.status.value,
        "message": solution.message,
        "caveats": [caveat.sentence for caveat in solution.caveats],
        "mu": design.condition.advance_ratio,
        "speed_m_s": design.airspeed,
        "mass_kg": design.condition.mass,
        "altitude_m": design.condition.altitude,
        **{
            name: design.numbers[name]
            for name in reported_names([design.unusual])
            if name in UNUSUAL
        },
        "preset": design.preset,
        "inflow": design.models.inflow if not design.hovering else design.models.hover_inflow,
        "twist": design.twist.spec(),
        **({} if stand is None else {"trim": design.models.trim, "stand": stand.record()}),
        **({} if carried is None else {"actuator": carried.spec}),
        **(
            {}
            if design.active_twist is None
            else {"active_twist": active_twist_record(design.active_twist)}
        ),
        **(
            {"pitch_per_rev": harmonics_record(design.pitch_per_rev)}
            if design.pitch_per_rev
            else {}
        ),
        **_switches(solution),
        **(values if solution.converged else _emptied(values)),
        "elapsed_ms": 1e3 * solution.elapsed,
    }


def save_solution(solution: Solution, path: str | Path) -> None:
    """Write the design and, under `solution`, its results as JSON; `load_design` reads the design back.

    ValueError for the suffix of another format, and with freedoms, which no file holds.
    """
    check_suffix(path, ".json")
    if require_solution(solution).freedoms:
        raise ValueError(
            "a design file holds no freedoms of the blade: write rotor.solution_record(solution) instead"
        )
    record = {**solution.design.to_dict(), "solution": solution_record(solution)}
    write_whole(path, json.dumps(record, indent=2, allow_nan=False) + "\n")


def plot_field(solution: Solution, field: str = "alpha", ax: Any = None) -> Any:
    """Draw a field of `solution.disk` over the disk seen from above: tail (ψ = 0) down, advancing side to the right.

    `ax`: polar axes of matplotlib to draw into; by default new ones. Returns the axes.

    Raises ValueError for a field that does not exist, and RuntimeError when the solution did not converge.
    """
    check_known("field", field, DISK_LABELS)
    disk = require_solution(solution).require().disk
    label, scale = DISK_LABELS[field]
    values: Array | None = getattr(disk, field)
    if values is None:
        raise ValueError(f"this blade is rigid, so it has no field {field!r}: choose another field")
    if ax is None:
        ax = new_axes(subplot_kw={"projection": "polar"})
    ax.set_theta_zero_location("S")
    ax.set_theta_direction(1)
    closed = scale * np.concatenate((values, values[:, :1]), axis=1)
    drawn = ax.contourf(np.append(disk.psi, disk.psi[0] + 2.0 * np.pi), disk.r, closed, levels=40)
    ax.set_rlim(0.0, 1.0)
    ax.set_title(label)
    ax.figure.colorbar(drawn, ax=ax, shrink=0.8)
    return ax


def _elastic_record(elastic: ElasticTwist) -> dict[str, Any]:
    """For `solve --json`; the amplitude of the pitch-link load is half of peak to peak."""
    load = elastic.pitch_link_load
    return {
        "elastic_twist_deg": {
            "mean_tip": math.degrees(float(elastic.tip.mean())),
            "amplitude_1_tip": math.degrees(elastic.first_harmonic),
            "min_tip": math.degrees(float(elastic.tip.min())),
            "max_tip": math.degrees(float(elastic.tip.max())),
        },
        "torsion_frequencies_per_rev": elastic.frequencies.tolist(),
        "pitch_link_load_n": {"mean": float(load.mean()), "amplitude": 0.5 * float(np.ptp(load))},
        "control_power_w": elastic.control_power,
    }


def _switches(solution: Solution) -> dict[str, Any]:
    """What is switched off, and the hub moment, which is then not zero; nothing for the full model."""
    off = switched_off(solution.design.models)
    if not off:
        return {}
    moment = solution.hub_moment if solution.converged else None
    return {
        "switched_off": [switch.flag for switch in off],
        "hub_moment_n_m": {"roll": moment and moment.roll, "pitch": moment and moment.pitch},
    }


def _emptied(values: dict[str, Any]) -> dict[str, Any]:
    """Keys of a record without their values."""
    return {
        key: _emptied(cast(dict[str, Any], one)) if isinstance(one, dict) else None
        for key, one in values.items()
    }
