"""`solve`: trims one design and prints the result."""

import argparse
import json
import math
from dataclasses import replace
from typing import Any

from rotor.actuator.installation import with_actuator
from rotor.command.common import (
    add_command,
    add_design_arguments,
    add_output_arguments,
    design_from,
    waves_text,
)
from rotor.design.aircraft import in_words
from rotor.design.design import Design
from rotor.support.terminal import wrapped
from rotor.support.units import KNOT, power_unit
from rotor.support.user_input import check_writable
from rotor.trim.distribution import distribution
from rotor.trim.doubt import Doubt, doubt, doubt_table
from rotor.trim.export import solution_record
from rotor.trim.hub_loads import hub_loads
from rotor.trim.no_hub_loads import why_no_hub_loads
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


def add_parser(commands: Any) -> None:
    parser = add_command(commands, "solve", run)
    add_design_arguments(parser, speed=True)
    words = "start from point N of a study's folder or of one of its files; other flags change it"
    parser.add_argument("--row", metavar="DIR:N", help=words)
    words = "fly with an actuator on the blades, such as MFC_P1,drive=77 (drive in %%)"
    parser.add_argument("--carry", metavar="ACTUATOR", help=words)
    output = add_output_arguments(parser)
    output.add_argument("--save", metavar="FILE", help="write a design file, which the page opens")
    output.add_argument(
        "--distribution",
        action="store_true",
        help="also print lift along the blade; with --json lift, coefficients, angle of attack and induced velocity of "
        "one blade by radius and azimuth",
    )
    words = "also print the uncertainty of power, and of what the twist saves compared with the blade as built"
    output.add_argument("--doubt", action="store_true", help=words)


def run(args: argparse.Namespace) -> int:
    """0 converged, 1 not converged."""
    design = design_from(args)
    design = with_actuator(design, args.carry) if args.carry else design
    if args.save is not None:
        check_writable(args.save)
        design.save(args.save)
    solution = solve(design)
    sure = _doubt(solution) if args.doubt and solution.converged else None
    loads = distribution(solution) if args.distribution and solution.converged else None
    if args.json:
        also: dict[str, Any] = (
            {"distribution": loads and loads.to_dict()} if args.distribution else {}
        )
        if args.doubt:
            also["doubt"] = sure and sure.record()
        print(
            json.dumps(
                {**solution_record(solution), **also, **_vibration(solution)},
                indent=2,
                allow_nan=False,
            )
        )
    else:
        print(report(solution))
        if sure is not None:
            sentence = wrapped(sure.in_words("Against the blade as built it"))
            print(f"\n{sentence}\n\n{doubt_table(sure).text()}")
        if loads is not None:
            print(f"\nlift of one blade\n{loads.table()}")
    return 0 if solution.converged else 1


def _doubt(solution: Solution) -> Doubt:
    """Against the blade as built, where that has another twist and trims."""
    design = solution.design
    built = replace(design, twist=design.aircraft.twist_for(design.preset))
    other = None if built == design or design.models.trim == "free-rotor" else solve(built)
    return doubt(solution, other if other is not None and other.converged else None, models=True)


def _vibration(solution: Solution) -> dict[str, Any]:
    """Hub loads and blade frequencies of `--json`, with a note of whose loads they are or why there are none."""
    reason, frequencies = why_no_hub_loads(solution.design), solution.blade_frequencies
    loads = hub_loads(solution) if solution.converged else None
    note = "" if reason is None else reason.sentence
    if reason is None and loads is None and solution.converged:
        note = "No hub loads: the design does not trim with bending blades."
    elif loads is not None and not solution.design.models.bending:
        note = "The hub loads are those of bending blades; switch bending on to trim with them."
    return {
        "hub_loads": loads and loads.record(),
        "hub_loads_note": note,
        "blade_frequencies_per_rev": frequencies
        and {name: list(values) for name, values in vars(frequencies).items()},
    }


def _load(design: Design) -> str:
    """What the rotor carries: weight at an altitude, or the inputs of a test."""
    condition = design.condition
    if condition.stand is None:
        return ", ".join(
            (f"{condition.mass:.1f} kg, {condition.altitude:.0f} m", *in_words(design.unusual))
        )
    height = [f"{condition.altitude:.0f} m"] if condition.altitude else []
    return ", ".join(
        (f"{design.models.trim}: {condition.stand}", *height, *in_words(design.unusual))
    )


def _decimals(value: float) -> int:
    """Three digits at least, as for a model rotor."""
    return 1 if abs(value) >= 10.0 else 2 if abs(value) >= 1.0 else 3


def report(solution: Solution) -> str:
    """What `solve` prints: flight, power, controls, coefficients, and caveats."""
    design = solution.design
    inflow = design.models.hover_inflow if design.hovering else design.models.inflow
    carried = (
        "" if design.rotor.blade.carried is None else f", with {design.rotor.blade.carried.name}"
    )
    lines = [
        f"{design.rotor.name}, preset {design.preset}, twist {design.jig.spec()}{carried}, inflow {inflow}",
        f"µ {design.condition.advance_ratio:.4f} ({design.airspeed / KNOT:.1f} kt), {_load(design)}",
        wrapped(f"{solution.status.value}: {solution.message}"),
    ]
    if design.pitch_per_rev:
        lines.insert(1, f"root pitch {waves_text(design.pitch_per_rev)}")
    if design.active_twist is not None:
        lines.insert(1, f"active twist {waves_text(design.active_twist.harmonics)}")
    if solution.converged:
        lines += ["", *_powers(solution), "", *_coefficients(solution)]
    if design.models.bending and solution.converged and (loads := hub_loads(solution)) is not None:
        low, high = loads.band or (loads.index, loads.index)
        lines += [
            f"hub loads at {loads.per_rev}/rev: "
            + ", ".join(
                f"{name} {value:.0f} {'N' if name[0] == 'f' else 'N m'}"
                for name, value in loads.amplitudes.items()
            ),
            f"index {loads.index:.1f} % of the weight, {low:.1f} … {high:.1f} % over inflow models: for comparison, "
            "not an absolute level",
        ]
    lines += [wrapped(f"caveat: {caveat.sentence}", "  ") for caveat in solution.caveats]
    return "\n".join(lines)


def _powers(solution: Solution) -> list[str]:
    power, controls, stand = solution.power, solution.controls, solution.design.condition.stand
    powers = (
        {"shaft": power.shaft} if stand else {"total": power.total, "main rotor": power.main_rotor}
    )
    powers |= {"induced": power.induced, "profile": power.profile}
    powers |= {"propulsive" if stand else "parasite": power.parasite}
    powers |= {"climb": power.climb} if solution.design.vertical_speed else {}
    powers |= {} if stand else {"tail rotor": power.tail}
    degrees = {
        "collective": controls.collective,
        "cyclic 1c": controls.cyclic_1c,
        "cyclic 1s": controls.cyclic_1s,
        "shaft tilt": controls.shaft_tilt,
        "coning": controls.coning,
        "flap 1c": controls.flap_1c,
        "flap 1s": controls.flap_1s,
    }
    symbol, size = power_unit(*powers.values())
    digits = 2 if size <= max(map(abs, powers.values())) < 10.0 * size else 1
    lines = [f"{name:<12}{value / size:z10.{digits}f} {symbol}" for name, value in powers.items()]
    return [
        *lines,
        "",
        *(f"{name:<12}{math.degrees(value) + 0.0:10.2f} °" for name, value in degrees.items()),
    ]


def _coefficients(solution: Solution) -> list[str]:
    design, merit, factor = solution.design, solution.figure_of_merit, solution.induced_power_factor
    lines = [
        f"κ = P_i/(C_T λ0) {'none: there is no thrust' if factor is None else f'{factor:.3f}'}"
    ]
    lines += [f"C_T/σ {solution.ct_over_sigma:z.4f} (σ {design.rotor.solidity:.4f})"]
    if design.condition.stand is not None:
        lift, drag = solution.lift_and_drag
        twisting = f"{solution.torque:z.{_decimals(solution.torque)}f} N m"
        fine = _decimals(math.hypot(lift, drag))
        lines += [f"C_Q/σ {solution.cq / design.rotor.solidity:.6f}, torque {twisting}"]
        lines += [f"lift {lift:z.{fine}f} N, drag {drag:z.{fine}f} N (wind axes)"]
    lines += (
        [f"figure of merit {merit:.3f}"]
        if merit is not None
        else [f"L/D_e {solution.lift_to_drag or 0.0:.2f}"]
    )
    return [
        *lines,
        f"of the disk: reverse flow {100 * solution.reverse_flow_area:.1f} %, "
        f"separated {100 * solution.stalled_area:.1f} % with {100 * solution.stalled_thrust:z.1f} % of the thrust, "
        f"past the static stall angle but attached {100 * solution.past_static_area:.1f} %",
    ]
