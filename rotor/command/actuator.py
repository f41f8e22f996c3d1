"""`actuator`: required and attainable twist over a mission, the net saving, and what would pay."""

import argparse
import json
import math
import sys
from dataclasses import asdict
from typing import Any

import numpy as np

from rotor.actuator.catalogue import find_actuator
from rotor.actuator.optimum import Baseline, TwistOptimum
from rotor.actuator.pay import BreakEven, break_even, break_even_chart, pay_sentence
from rotor.actuator.section import HostBlade, Placement, default_placement
from rotor.actuator.tables import ActuatorTable, pay_table, table_5_1, table_5_2
from rotor.actuator.verdict import (
    Verdict,
    judge,
    part_words,
    reference,
    verdict_details,
    verdict_sentence,
)
from rotor.command import common
from rotor.design.design import Design
from rotor.dynamics.structure import check_blade
from rotor.files.make_design import make_design
from rotor.optimisation.concepts import find_concept
from rotor.optimisation.mission import Mission, mission_at, mission_from, standard_mission
from rotor.optimisation.objective import MISSION_COLUMNS
from rotor.support.assets import SHIPPED_ROTORS
from rotor.support.chart_svg import svg
from rotor.support.terminal import wrapped
from rotor.support.user_input import check_suffix, check_writable, write_whole


def add_parser(commands: Any) -> None:
    parser = common.add_command(commands, "actuator", run)
    words = "actuator (default MFC_P1); --table 5.1 lists all"
    parser.add_argument("--actuator", metavar="ID", default="MFC_P1", help=words)
    parser.add_argument("--plies", type=int, default=2, metavar="N", help=common.PLIES_HELP)
    parser.add_argument(
        "--concept",
        default="linear",
        metavar="NAME",
        help=f"{common.CONCEPT_HELP} (default linear)",
    )
    parser.add_argument("--division", metavar="R,…", help=common.DIVISION_HELP)
    for flag, value, metavar, words in (
        (
            "--stiffness",
            None,
            "G",
            "with --blade new: its GJ relative to the existing blade (default 0.5)",
        ),
        ("--angle-deg", 45.0, "DEG", "fibre angle to the span (default 45)"),
    ):
        parser.add_argument(flag, type=common.finite, default=value, metavar=metavar, help=words)
    columns = ",".join(MISSION_COLUMNS)
    words = (
        f"CSV file with the columns {columns} (default: hover, climb, cruise, fast; assumed hours)"
    )
    parser.add_argument("--mission", metavar="FILE", help=words)
    for flag in _OLD_PAIR:
        parser.add_argument(flag, type=common.finite, help=argparse.SUPPRESS)
    blades = ("retrofit", "new")
    parser.add_argument(
        "--blade", choices=blades, default=blades[0], help="existing blade (default) or a new one"
    )
    parser.add_argument("--span", metavar="A:B", help="active span in r/R (default 0.2433:0.9292)")
    parser.add_argument("--chord", metavar="A:B", help="active chord in x/c (default 0.05:0.80)")
    words = (
        "compare with the same blade without the actuator (default), or with the best fixed twist"
    )
    parser.add_argument(
        "--against", choices=("same-blade", "best-fixed"), default="same-blade", help=words
    )
    words = "print table 5.1 (actuators) or 5.2 (net savings) of the thesis instead"
    parser.add_argument("--table", choices=("5.1", "5.2"), help=words)
    words = "print what an actuator would need to pay on this rotor (all: on each rotor)"
    parser.add_argument(
        "--what-would-pay", nargs="?", choices=("this", "all"), const="this", help=words
    )
    parser.add_argument(
        "--plot", metavar="FILE.svg", help="with --what-would-pay: draw the break-even line"
    )
    common.add_design_arguments(parser)
    common.add_output_arguments(parser)


def run(args: argparse.Namespace) -> int:
    """Exit code 0, or 1 where nothing trims."""
    if args.table == "5.1":
        return _show(args, table_5_1())
    actuator, concept = (
        find_actuator(args.actuator),
        find_concept(args.concept, common.parse_division(args.division)),
    )
    # Bad input is reported before anything is computed.
    mission = _mission(args)
    if args.what_would_pay is None:
        check_blade(mission.design.aircraft)
    stiffness = (
        (1.0 if args.blade == "retrofit" else 0.5) if args.stiffness is None else args.stiffness
    )
    placement, host = _placement(args), HostBlade(args.blade, stiffness)
    if args.plot is not None and args.what_would_pay is None:
        raise ValueError("--plot draws the break-even line: add --what-would-pay")
    if args.plot is not None:
        check_suffix(args.plot, ".svg")
        check_writable(args.plot)
    try:
        if args.what_would_pay is not None:
            return _run_pay(args, mission)
        if args.table == "5.2":
            return _show(args, table_5_2(mission, placement=placement, host=host))
        verdict = judge(actuator, mission, concept, placement, host, against=args.against)
    except RuntimeError as error:
        print(
            json.dumps(failure(args, mission, str(error)), indent=2)
            if args.json
            else f"not converged: {error}"
        )
        return 1
    common.print_result(args, lambda: record(verdict), lambda: report(verdict))
    return 0


def record(verdict: Verdict) -> dict[str, Any]:
    """The JSON of `actuator --json`. Savings are means over the mission [W]."""
    return {
        "status": "converged",
        "message": verdict_sentence(verdict),
        "actuator": verdict.installed.actuator.id,
        "plies": verdict.installed.placement.plies,
        "concept": verdict.baseline.concept.name,
        "mission": mission_record(verdict.baseline.mission),
        "required_twist_deg": math.degrees(verdict.required),
        "attainable_twist_deg": math.degrees(verdict.attainable),
        "feasible": verdict.feasible,
        "voltages_v": [list(segment) for segment in verdict.voltages],
        "added_mass_kg": verdict.installed.masses.aircraft,
        "torsion_frequency_per_rev": verdict.installed.frequency,
        "against": verdict.against,
        "ideal_saving_w": verdict.ideal_saving,
        "gross_saving_w": verdict.gross_saving,
        "stiffness_cost_w": verdict.stiffness_cost,
        "mass_cost_w": verdict.mass_cost,
        "drive_cost_w": verdict.drive_cost,
        "part_bands_w": {
            name: doubt and doubt.change_band for name, doubt in verdict.parts_doubt.items()
        },
        "net_saving_w": verdict.net_saving,
        "net_saving_band_w": verdict.net_band,
        "fuel_saving_kg_h": None if verdict.fuel_saving is None else 3600.0 * verdict.fuel_saving,
        "fuel_band_kg_h": None if verdict.fuel_band is None else 3600.0 * verdict.fuel_band,
        "limits": [asdict(limit) for limit in verdict.limits],
        "caveats": list(verdict.caveats),
    }


def failure(args: argparse.Namespace, mission: Mission, message: str) -> dict[str, Any]:
    """The keys of `record` where nothing trims; unknown values are null."""
    return {
        "status": "not-converged",
        "message": message,
        "actuator": args.actuator,
        "plies": args.plies,
        "concept": args.concept,
        "mission": mission_record(mission),
        **dict.fromkeys(("required_twist_deg", "attainable_twist_deg", "feasible")),
        "voltages_v": [],
        **dict.fromkeys(("added_mass_kg", "torsion_frequency_per_rev")),
        "against": args.against,
        **dict.fromkeys(
            ("ideal_saving_w", "gross_saving_w", "stiffness_cost_w", "mass_cost_w", "drive_cost_w")
        ),
        "part_bands_w": None,
        **dict.fromkeys(
            ("net_saving_w", "net_saving_band_w", "fuel_saving_kg_h", "fuel_band_kg_h")
        ),
        "limits": [],
        "caveats": [],
    }


def report(verdict: Verdict) -> str:
    installed, base = verdict.installed, verdict.baseline
    masses = installed.masses
    legs = zip(base.mission.legs, base.mission.shares, base.best, strict=True)
    optima = [
        f"{leg.name} ({100.0 * share:.3g} % of the time)  {_twist_text(base, best)} ({best.power / 1e3:.1f} kW)"
        for leg, share, best in legs
    ]
    gross = dict(verdict.savings)["gross"]
    lines = [
        verdict_sentence(verdict),
        wrapped(verdict_details(verdict)),
        "",
        "optimum on each leg",
        *(f"  {line}" for line in optima),
        f"best fixed blade              {_twist_text(base, base.fixed)} (mean {base.fixed.power / 1e3:.1f} kW)",
        "",
        f"savings against {reference(verdict)}",
        f"  gross, by its twist         {part_words(verdict, 'gross', gross)}  "
        f"(unlimited twist {part_words(verdict, 'ideal', verdict.ideal_saving)})",
        *(
            f"  {name:<28}{part_words(verdict, name, part)}"
            for name, part in verdict.savings
            if name != "gross"
        ),
        f"  net                         {part_words(verdict, 'net', verdict.net_saving)}",
        "",
        f"twist required    {math.degrees(verdict.required):8.2f} °  (sum of segments)",
        f"twist attainable  {math.degrees(verdict.attainable):8.2f} °",
        f"twist used        {math.degrees(verdict.attained):8.2f} °",
        f"moment            {installed.moment:8.0f} N·m on GJ {installed.section_stiffness:.0f} N·m²",
        f"torsion           {installed.frequency:8.2f} /rev",
        f"added mass        {masses.aircraft:8.1f} kg  ({masses.blade:.1f} per blade, "
        f"{masses.balance:.1f} of it nose weight)",
        f"drive             {verdict.drive.slew_power / 1e3:8.2f} kW during a change of "
        f"{verdict.drive.slew_time:.0f} s, {verdict.drive.hold_power / 1e3:.2f} kW to hold",
    ]
    edges = (base.mission.design.rotor.blade.root_cutout, *installed.placement.divisions, 1.0)
    for k, segment in enumerate(verdict.voltages):
        volts = ", ".join(f"{volts:.0f} V" for volts in segment)
        lines.append(f"segment {k + 1}         {edges[k]:.2f}…{edges[k + 1]:.2f} R: {volts}")
    met = (f"{'met     ' if limit.ok else 'EXCEEDED'} {limit.sentence}" for limit in verdict.limits)
    lines += ["", *(wrapped(limit, " " * 9) for limit in met)]
    return "\n".join([*lines, *(wrapped(f"caveat: {caveat}", "  ") for caveat in verdict.caveats)])


ROTORS = (*SHIPPED_ROTORS, "hart2")
"""Rotors of `--what-would-pay all`."""


def _run_pay(args: argparse.Namespace, mission: Mission) -> int:
    missions = [mission]
    if args.what_would_pay == "all":
        missions = [_mission(args, make_design(rotor=key)) for key in ROTORS]
    lines = [break_even(each) for each in missions]
    if args.plot is not None:
        write_whole(args.plot, svg(break_even_chart(lines[0])))
    if args.json:
        records = [pay_record(line) for line in lines]
        print(
            json.dumps(
                records if args.what_would_pay == "all" else records[0], indent=2, allow_nan=False
            )
        )
        return 0
    print(pay_table(lines).text())
    if args.what_would_pay == "this":
        print(f"\n{wrapped(pay_sentence(lines[0]))}")
    return 0


def pay_record(even: BreakEven) -> dict[str, Any]:
    """The JSON of `actuator --what-would-pay --json`; masses are of all blades."""
    needed = even.requirement
    pays = {
        "twist_deg": math.degrees(needed.twist),
        "mass_kg": needed.mass,
        "drive_w": needed.drive,
    }
    return {
        "rotor": even.mission.design.aircraft.name,
        "mission": mission_record(even.mission),
        "message": pay_sentence(even),
        "ideal_saving_w": even.ideal_saving,
        "ideal_band_w": even.ideal_band,
        "optima_apart_deg": math.degrees(abs(even.change)),
        "pays_from": pays if even.worthwhile else None,
        "line": {
            "twist_deg": np.degrees(even.twists).tolist(),
            "gross_saving_w": even.gross.tolist(),
            "mass_kg": even.masses.tolist(),
        },
    }


def mission_record(mission: Mission) -> dict[str, Any]:
    """The JSON of a mission: its legs, and whether its hours are assumed."""
    designs = mission.designs()
    legs = [
        {"name": leg.name, "hours": leg.hours, **design.condition.numbers}
        for leg, design in zip(mission.legs, designs, strict=True)
    ]
    return {"legs": legs, "assumed": mission.assumed}


_OLD_PAIR = ("--from-mu", "--to-mu", "--share")
"""Options for a mission of two legs; they are read for one release more, with a warning."""


_TABLE_SPEEDS = (0.0, 0.3)
"""Advance ratios of table 5.2, for equal hours."""


def _mission(args: argparse.Namespace, design: Design | None = None) -> Mission:
    """The mission that is asked for, of the design of the options or of another one."""
    old = (args.from_mu, args.to_mu, args.share)
    flown = design or common.design_from(args, mu=0.0)
    if old == (None, None, None) and args.mission is not None:
        return mission_from(args.mission, flown)
    if old == (None, None, None) and args.table == "5.2":
        return mission_at(flown, _TABLE_SPEEDS)
    if old == (None, None, None):
        return standard_mission(flown)
    if args.mission is not None:
        raise ValueError("--mission has all legs: leave --from-mu, --to-mu and --share out")
    start = 0.0 if args.from_mu is None else args.from_mu
    end = 0.3 if args.to_mu is None else args.to_mu
    share = 0.5 if args.share is None else args.share
    mission = mission_at(flown, (start, end), (1.0 - share, share))
    if design is None:
        print(
            "warning: --from-mu, --to-mu and --share end with the next release: use --mission",
            file=sys.stderr,
        )
    return mission


def _twist_text(base: Baseline, optimum: TwistOptimum) -> str:
    return common.short_spec(base.concept.twist(optimum.values).spec())


def _show(args: argparse.Namespace, table: ActuatorTable) -> int:
    common.print_result(
        args,
        lambda: {key: value for key, value in asdict(table).items() if key != "keys"},
        table.text,
    )
    return 0


def _placement(args: argparse.Namespace) -> Placement:
    base = default_placement(args.plies)
    span = (
        common.parse_pair(args.span, f"active span {args.span!r}", "0.25:0.9", ":")
        if args.span
        else base.span
    )
    chord = (
        common.parse_pair(args.chord, f"active chord {args.chord!r}", "0.05:0.8", ":")
        if args.chord
        else base.chord
    )
    if not 0.0 < args.angle_deg < 90.0:
        raise ValueError(
            f"fibre angle {args.angle_deg:g}° is not between 0 and 90°: choose a value inside; 45 gives the most twist"
        )
    return Placement(span, chord, args.plies, math.radians(args.angle_deg))
