"""`solve`: trim one design and print it."""

import argparse
import json
import math
from typing import Any, cast

from rotor.aero.switches import switched_off
from rotor.command.flags import add_command, add_design_arguments, design_from, finite
from rotor.design.active_twist import active_twist_record
from rotor.trim.solution import Solution
from rotor.trim.solve import solve
from rotor.units import KNOT


def add_parser(commands: Any) -> None:
    """Register the command."""
    parser = add_command(commands, "solve", "trim one design; power, trim and caveats")
    speed = parser.add_mutually_exclusive_group()
    speed.add_argument("--mu", type=finite, metavar="MU", help="advance ratio (default 0.2)")
    speed.add_argument("--speed-kt", type=finite, metavar="KT", help="airspeed in knots")
    speed.add_argument("--hover", action="store_true", help="hover")
    add_design_arguments(parser, one_twist=True)
    parser.add_argument("--json", action="store_true", help="machine-readable output")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """0 converged, 1 not converged."""
    advance_ratio = 0.0 if args.hover else args.mu
    design = design_from(args, args.twist, advance_ratio if args.speed_kt is None else 0.0)
    if args.speed_kt is not None:
        design = design_from(args, args.twist, args.speed_kt * KNOT / design.rotor.tip_speed)
    solution = solve(design)
    print(json.dumps(record(solution), indent=2, allow_nan=False) if args.json else report(solution))
    return 0 if solution.converged else 1


def record(solution: Solution) -> dict[str, Any]:
    """The JSON of `solve --json`. What a rotor that is not trimmed cannot know is null."""
    design, controls, power = solution.design, solution.controls, solution.power
    values: dict[str, Any] = {
        "power_w": {
            "total": power.total,
            "main_rotor": power.main_rotor,
            "induced": power.induced,
            "profile": power.profile,
            "parasite": power.parasite,
            "tail": power.tail,
        },
        "ct": solution.ct,
        "cp": solution.cp,
        "ct_over_sigma": solution.ct_over_sigma,
        "collective_deg": math.degrees(controls.collective),
        "cyclic_1c_deg": math.degrees(controls.cyclic_1c),
        "cyclic_1s_deg": math.degrees(controls.cyclic_1s),
        "coning_deg": math.degrees(controls.coning),
        "flap_1c_deg": math.degrees(controls.flap_1c),
        "flap_1s_deg": math.degrees(controls.flap_1s),
        "shaft_tilt_deg": math.degrees(controls.shaft_tilt),
        "lambda0": controls.lambda0,
        "reverse_flow_area_percent": 100.0 * solution.reverse_flow_area,
        "stalled_area_percent": 100.0 * solution.stalled_area,
    }
    return {
        "status": solution.status.value,
        "message": solution.message,
        "caveats": [caveat.sentence for caveat in solution.caveats],
        "mu": design.condition.advance_ratio,
        "speed_m_s": design.airspeed,
        "preset": design.preset,
        "inflow": design.models.inflow if not design.hovering else design.models.hover_inflow,
        "twist": design.twist.spec(),
        **({} if design.active_twist is None else {"active_twist": active_twist_record(design.active_twist)}),
        **_switches_record(solution),
        **(values if solution.converged else _emptied(values)),
        "elapsed_ms": 1e3 * solution.elapsed,
    }


def _switches_record(solution: Solution) -> dict[str, Any]:
    """What is switched off, and the hub moment that is then worth a look; nothing for the full model."""
    off = switched_off(solution.design.models)
    if not off:
        return {}
    moment = solution.hub_moment
    known = solution.converged
    return {
        "switched_off": [switch.flag for switch in off],
        "hub_moment_n_m": {"roll": moment.roll if known else None, "pitch": moment.pitch if known else None},
    }


def _emptied(values: dict[str, Any]) -> dict[str, Any]:
    return {
        key: _emptied(cast(dict[str, Any], value)) if isinstance(value, dict) else None for key, value in values.items()
    }


def report(solution: Solution) -> str:
    """The same for a reader."""
    design, controls, power = solution.design, solution.controls, solution.power
    inflow = design.models.hover_inflow if design.hovering else design.models.inflow
    lines = [
        f"{design.rotor.name}, preset {design.preset}, twist {design.twist.spec()}, inflow {inflow}",
        f"µ {design.condition.advance_ratio:.4f} ({design.airspeed / KNOT:.1f} kt), {design.condition.mass:.1f} kg, "
        f"{design.condition.altitude:.0f} m",
        f"{solution.status.value}: {solution.message}",
    ]
    if design.active_twist is not None:
        waves = (
            f"{wave.per_rev}/rev ±{math.degrees(wave.amplitude):.2f}°, phase {math.degrees(wave.phase):.0f}°"
            for wave in design.active_twist.harmonics
        )
        lines.insert(1, f"active twist {'; '.join(waves)}")
    if solution.converged:
        degrees = {
            "collective": controls.collective, "cyclic 1c": controls.cyclic_1c, "cyclic 1s": controls.cyclic_1s,
            "shaft tilt": controls.shaft_tilt, "coning": controls.coning, "flap 1c": controls.flap_1c,
            "flap 1s": controls.flap_1s,
        }  # fmt: skip
        kw = {
            "total": power.total, "main rotor": power.main_rotor, "induced": power.induced,
            "profile": power.profile, "parasite": power.parasite, "tail rotor": power.tail,
        }  # fmt: skip
        lines += ["", *(f"{name:<12}{value / 1e3:10.1f} kW" for name, value in kw.items())]
        lines += ["", *(f"{name:<12}{math.degrees(value) + 0.0:10.2f} °" for name, value in degrees.items())]
        merit = solution.figure_of_merit
        lines += ["", f"κ = P_i/(C_T λ0) {solution.induced_power_factor:.3f}"]
        lines += [f"C_T/σ {solution.ct_over_sigma:.4f} (σ {design.rotor.solidity:.4f})"]
        lines += (
            [f"figure of merit {merit:.3f}"] if merit is not None else [f"L/D_e {solution.lift_to_drag or 0.0:.2f}"]
        )
        lines += [
            f"of the disk: reverse flow {100 * solution.reverse_flow_area:.1f} %, "
            f"stalled {100 * solution.stalled_area:.1f} %"
        ]
    lines += [f"caveat: {caveat.sentence}" for caveat in solution.caveats]
    return "\n".join(lines)
