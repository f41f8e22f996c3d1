"""Commands that print a table: `sweep`, `front`, `waterfall` and `airfoil`.

`sweep`: one or more twists over advance ratio. `front`: compromises of power and vibration. `waterfall`: power of each
physical effect, switched on one after another. `airfoil`: the data of a section; how the bundled decks are made:
`tests/tools/sections`.
"""

import argparse
import json
import re
from collections.abc import Sequence
from typing import Any, cast

import numpy as np

from rotor.airfoil.sections import TABLE_NAMES, Section, load_installed
from rotor.command import common
from rotor.design.active_twist import harmonics_text
from rotor.design.design import Design
from rotor.design.quantities import NUMBERS, SWEPT
from rotor.optimisation.vibration import FrontPoint, VibrationFront, vibration_front
from rotor.study.series import (
    PARTS,
    SHARED_COLUMNS,
    SweepTable,
    Waterfall,
    WaterfallStep,
    sweep,
    waterfall,
)
from rotor.support.arrays import Array
from rotor.support.table import LEFT, CellValue, Column, Table, table
from rotor.support.terminal import wrapped
from rotor.support.units import power_unit
from rotor.trim.doubt import doubt, rounded_pair
from rotor.trim.solution import Solution
from rotor.trim.solve import solve


def add_sweep(commands: Any) -> None:
    parser = common.add_command(commands, "sweep", run_sweep)
    words = "one of the twists; a further column then shows power relative to it"
    parser.add_argument("--relative-to", metavar="SPEC", help=words)
    common.add_design_arguments(parser, twists=True, ranges=True)
    common.add_output_arguments(parser, "the table")


def run_sweep(args: argparse.Namespace) -> int:
    """0 when every point converged, else 1."""
    name, steps = _swept(args)
    specs: list[str | None] = list(args.twist) if args.twist else [None]
    designs = [common.design_from(args, spec) for spec in specs]
    for design in designs:
        for step in steps:  # Bad input is reported first.
            design.at(**cast(Any, {name: step}))
    base = common.design_from(args, args.relative_to).twist.spec() if args.relative_to else ""
    if base and base not in (known := [design.twist.spec() for design in designs]):
        raise ValueError(
            f"--relative-to {base} is not a twist of this sweep: use {', '.join(dict.fromkeys(known))}"
        )
    common.check_output(args)
    tables = [sweep(design, **cast(Any, {name: steps})) for design in designs]
    solutions = SweepTable(tuple(solution for each in tables for solution in each), args.over)
    if base:
        solutions = solutions.relative_to(base)
    whole = table((Column(key=name) for name in solutions.columns), solutions.rows)
    if args.csv:
        whole.write(args.csv)
    common.print_result(args, whole.records, lambda: sweep_report(solutions, args.over))
    return 0 if all(solution.converged for solution in solutions) else 1


def sweep_report(solutions: SweepTable, over: str) -> str:
    """The table without columns that are the same in all rows; below it each caveat, in the words of the first row
    that has it: those of another row may have other numbers."""
    level = all(solution.design.vertical_speed == 0.0 for solution in solutions)
    left_out = {
        "status",
        "caveats",
        "message",
        *SHARED_COLUMNS,
        *(("climb_m_s", "power_climb_w") if level else ()),
    }
    kept = [k for k, name in enumerate(solutions.columns) if name == over or name not in left_out]
    symbol, size = power_unit(*(solution.last_power.total for solution in solutions))
    columns = [_sweep_column(solutions.columns[k], symbol) for k in kept]
    failures = ("" if one.converged else f"{one.status.value}: {one.message}" for one in solutions)
    changes = [_with_rounded_change(solutions.columns, row) for row in solutions.rows]
    pairs = zip(changes, failures, strict=True)
    rows = [
        (*(_in_unit(row[k], solutions.columns[k], size) for k in kept), failure)
        for row, failure in pairs
    ]
    sentences: dict[str, str] = {}
    for caveat in (caveat for solution in solutions for caveat in solution.caveats):
        words = re.sub(r"[\d.]+", "", caveat.sentence)
        sentences.setdefault(words, wrapped(f"caveat: {caveat.sentence}", "  "))
    return "\n".join((table((*columns, Column("", LEFT)), rows).text(), *sentences.values()))


def _with_rounded_change(names: Sequence[str], row: tuple[CellValue, ...]) -> tuple[CellValue, ...]:
    """The row with its change and the band of that as texts, rounded as `rounded_pair`."""
    cells = dict(zip(names, row, strict=True))
    change = cells.get("change_percent")
    band = cells.get("change_band_percent")
    if not isinstance(change, float) or not isinstance(band, float):
        return row
    pair = rounded_pair(change, band)
    cells["change_percent"] = f"{pair.change:+.{pair.decimals}f}"
    cells["change_band_percent"] = f"{pair.band:.{pair.decimals}f}"
    return tuple(cells.values())


def _in_unit(cell: CellValue, name: str, size: float) -> CellValue:
    return cell / size if isinstance(cell, float) and _is_power(name) else cell


def _is_power(name: str) -> bool:
    return name.startswith("power_")


def _sweep_column(name: str, symbol: str) -> Column:
    """`symbol`: unit of the powers."""
    if name in ("twist", "sureness"):
        return Column(name, LEFT)
    if name.startswith("change"):
        return Column("change %", "+.2f") if name == "change_percent" else Column("± %", ".2f")
    if _is_power(name):
        return Column(f"{name[6:-2].replace('_', ' ')} {symbol}", "z.1f")
    return Column(name, ".4g" if name in NUMBERS else ".1f" if name == "speed_kt" else ".2f")


def _swept(args: argparse.Namespace) -> tuple[str, list[float]]:
    """Name and values of what is swept; of the others `args` has the one value afterwards."""
    given: dict[str, list[float]] = {
        name: getattr(args, name) for name in SWEPT if getattr(args, name) is not None
    }
    if args.hover:
        if slower := [f"--{SWEPT[name].flag}" for name in ("mu", "speed_kt") if name in given]:
            raise ValueError(f"--hover and {slower[0]} both give the speed: leave one of them out")
        given["mu"], args.hover = [0.0], False
    speeds = [name for name in ("mu", "speed_kt") if name in given]
    several = [name for name in given if len(given[name]) > 1] or speeds
    if len(speeds) > 1 or len(several) != 1:
        asked = (
            " and ".join(f"--{SWEPT[name].flag}" for name in dict.fromkeys((*speeds, *several)))
            or "nothing"
        )
        raise ValueError(
            f"a sweep over {asked} is not possible: give one range, for example --mu 0.05:0.40:0.05, where 0 is hover"
        )
    args.over = several[0]
    for name, values in given.items():
        setattr(args, name, values[0])
    return args.over, given[args.over]


FRONT_COLUMNS = (
    Column(key="twist_per_rev"),
    Column(key="twist"),
    Column("power kW", ".1f", "power_kw", ".2f"),
    Column(key="power_change_percent", stored=".2f"),
    Column(key="power_change_band_percent", stored=".2f"),
    Column(key="sureness"),
    Column("power", LEFT),
    Column("index %", ".2f", "index_percent", ".2f"),
    Column("over models %"),
    Column("change %", "+.0f", "index_change_percent", ".2f"),
    Column("over models %"),
    Column("twist", LEFT),
    Column(key="least_index_percent", stored=".2f"),
    Column(key="largest_index_percent", stored=".2f"),
    Column(key="least_change_percent", stored=".2f"),
    Column(key="largest_change_percent", stored=".2f"),
    Column(key="preview_power_kw", stored=".2f"),
    Column(key="preview_index_percent", stored=".2f"),
)
"""The least and the largest are those over inflow models."""


def add_front(commands: Any) -> None:
    parser = common.add_command(commands, "front", run_front)
    varied = f"vary static twist, not active twist; {common.CONCEPT_HELP}"
    parser.add_argument("--concept", metavar="NAME", help=varied)
    words = "harmonics per revolution of the active twist (default 2,3)"
    parser.add_argument("--harmonics", default="2,3", metavar="N,…", help=words)
    reach = "largest amplitude of each harmonic (default 1)"
    parser.add_argument("--reach-deg", type=common.finite, default=1.0, metavar="DEG", help=reach)
    parser.add_argument(
        "--points",
        type=int,
        default=5,
        metavar="N",
        help="points on the trade-off curve (default 5)",
    )
    common.add_design_arguments(parser, speed=True)
    common.add_output_arguments(parser, "the table")


def run_front(args: argparse.Namespace) -> int:
    """0 when start and points trim, 1 when a point does not."""
    try:
        harmonics = [int(item) for item in args.harmonics.split(",")]
    except ValueError:
        raise ValueError(
            f"harmonics {args.harmonics!r} are not understood: write for example 2,3"
        ) from None
    design = common.design_from(args)
    common.check_output(args)
    try:
        front = vibration_front(
            design, args.concept, harmonics=harmonics, reach_deg=args.reach_deg, points=args.points
        )
    except RuntimeError as error:
        print(
            json.dumps({"status": "not-converged", "message": str(error)}, indent=2)
            if args.json
            else str(error)
        )
        return 1
    start = solve(front.start.design)
    found = table(
        FRONT_COLUMNS,
        (front_row(point, front.start, start) for point in (front.start, *front.points)),
    )
    if args.csv:
        found.write(args.csv)
    common.print_result(
        args, lambda: front_record(design, front, found.records()), lambda: _front(front, found)
    )
    return 0 if len(front.points) == args.points else 1


def front_row(point: FrontPoint, start: FrontPoint, trimmed: Solution) -> tuple[CellValue, ...]:
    """A point by `FRONT_COLUMNS`; None for what it does not have. trimmed: the solution of the start."""
    sure = None if point is start else doubt(solve(point.design, trimmed), trimmed)
    active, none = point.design.active_twist, (None, None)
    harmonics = () if active is None else active.harmonics
    twist = point.design.twist.spec()
    return (
        None if active is None else harmonics_text(harmonics),
        twist,
        point.power / 1e3,
        100.0 * (point.power / start.power - 1.0),
        sure and sure.change_band_percent,
        sure and sure.sureness,
        sure and sure.saving_words,
        point.index,
        point.band and "{:.1f} … {:.1f}".format(*point.band),
        100.0 * (point.index / start.index - 1.0),
        point.over_inflows and "{:+.0f} … {:+.0f}".format(*point.over_inflows),
        common.waves_text(harmonics) or common.short_spec(twist),
        *(point.band or none),
        *(point.over_inflows or none),
        point.preview and point.preview[0] / 1e3,
        point.preview and point.preview[1],
    )


def front_record(
    design: Design, front: VibrationFront, rows: list[dict[str, CellValue]]
) -> dict[str, Any]:
    return {
        "status": "converged",
        "message": front.message,
        "mu": design.condition.advance_ratio,
        "preset": design.preset,
        "inflow": design.models.inflow,
        "start": rows[0],
        "points": rows[1:],
        "preview_error_percent": front.preview_error and list(front.preview_error),
    }


def _front(front: VibrationFront, found: Table) -> str:
    lines = [front.message, found.text()]
    if any(
        one.over_inflows is not None and one.over_inflows[0] * one.over_inflows[1] < 0.0
        for one in front.points
    ):
        lines.append("Where the changes over inflow models differ in sign, no phase is best.")
    if front.preview_error is not None:
        lines.append(
            "largest error of the preview: power {:.2f} %, index {:.1f} %".format(
                *front.preview_error
            )
        )
    lines.append(
        wrapped(
            "index: per cent of the weight, on a stand of the thrust; force weights 0.5, 0.67 and 1 (aft, side, up): "
            "for comparison, not an absolute level"
        )
    )
    return "\n".join(lines)


def add_waterfall(commands: Any) -> None:
    parser = common.add_command(commands, "waterfall", run_waterfall)
    common.add_design_arguments(parser, speed=True)
    common.add_output_arguments(parser)


def run_waterfall(args: argparse.Namespace) -> int:
    """0 when every step converged, else 1."""
    design = common.design_from(args)
    result = waterfall(design)
    common.print_result(args, lambda: waterfall_record(result), lambda: waterfall_report(result))
    return 0 if result.converged else 1


def waterfall_record(result: Waterfall) -> dict[str, Any]:
    """The JSON; values of a step that did not trim are null."""
    design = result.full.design
    return {
        "status": "converged" if result.converged else "not-converged",
        "mu": design.condition.advance_ratio,
        "preset": design.preset,
        "inflow": design.models.inflow if not design.hovering else design.models.hover_inflow,
        "twist": design.twist.spec(),
        "steps": [_step_record(step) for step in result.steps],
        "each_alone_off": [_step_record(step) for step in result.alone],
    }


def _step_record(step: WaterfallStep) -> dict[str, Any]:
    return {
        "switch": step.switch.flag if step.switch else None,
        "total_w": step.power,
        "change_w": step.change,
        "hub_moment_n_m": None if step.budget is None else step.hub_moment,
        "note": step.note or (step.message if step.budget is None else ""),
    }


def waterfall_report(result: Waterfall) -> str:
    design = result.full.design
    return "\n".join(
        [
            f"{design.rotor.name}, preset {design.preset}, twist {design.twist.spec()}, "
            f"µ {design.condition.advance_ratio:.4g}",
            "",
            "Switched on one after another",
            _steps_text(result.steps, design),
            "",
            "Each effect removed on its own",
            _steps_text(result.alone, design),
        ]
    )


def _steps_text(steps: Sequence[WaterfallStep], design: Design) -> str:
    """The first step has its parts of the power, the others what they change; the climb's where there is one."""
    parts = [part for part in PARTS if part != "climb" or design.vertical_speed]
    symbol, size = power_unit(*(step.power or 0.0 for step in steps))
    total = Column(symbol, LEFT), Column("total", ".1f"), Column("change", "+.1f")
    columns = (*total, *map(Column, parts), Column("", LEFT))
    return table(columns, (_step_row(step, parts, size) for step in steps)).text()


def _step_row(step: WaterfallStep, parts: Sequence[str], size: float) -> tuple[CellValue, ...]:
    if step.power is None:
        return step.title, None, None, *(None for _ in parts), step.message
    if step.change is None or step.added is None:
        shares = (f"{getattr(step.budget, part) / size:z.1f}" for part in parts)
        return step.title, step.power / size, None, *shares, None
    shares = (f"{step.change[part] / size:+z.1f}" for part in parts)
    return step.title, step.power / size, round(step.added / size, 1) + 0.0, *shares, step.note


def add_airfoil(commands: Any) -> None:
    parser = common.add_command(commands, "airfoil", run_airfoil)
    parser.add_argument("action", choices=("show",), help="show the data")
    parser.add_argument("name", metavar="NAME", help=f"section: {', '.join(TABLE_NAMES)}")
    parser.add_argument(
        "--mach", type=float, metavar="M", help="Mach number of one point, with --alpha"
    )
    parser.add_argument("--alpha", type=float, metavar="DEG", help="angle of attack of that point")
    common.add_output_arguments(parser)


def run_airfoil(args: argparse.Namespace) -> int:
    """0; ValueError on bad input."""
    if args.mach is None and args.alpha is None:
        _show_section(load_installed(args.name), args.json)
    elif args.mach is None or args.alpha is None:
        raise ValueError("a point needs both --mach and --alpha: give the missing one")
    else:
        _show_point(args.name, args.mach, args.alpha, args.json)
    return 0


def _show_point(name: str, mach: float, alpha: float, as_json: bool) -> None:
    """Lift, drag and moment at one Mach number and angle of attack [°] about the section's own chord line."""
    table = load_installed(name).table
    if not 0.0 <= mach <= table.mach_limit:
        raise ValueError(
            f"--mach {mach:g} is outside the data of {name}, 0…{table.mach_limit:g}: choose one inside"
        )
    if not -180.0 <= alpha <= 180.0:
        raise ValueError(f"--alpha {alpha:g} is outside −180…180 deg: choose a value inside")
    here, moment = table(np.deg2rad(alpha), mach), table.moment(np.deg2rad(alpha), mach)
    cl, cd = round(float(here.cl), 5), round(float(here.cd), 6)
    cm = None if moment is None else round(float(moment), 5)
    if as_json:
        print(json.dumps({"cl": cl, "cd": cd, "cm": cm}))
        return
    words = "no moment in its source" if cm is None else f"cm {cm:+.4f}"
    print(f"{name}, Mach {mach:g}, {alpha:g} deg: cl {cl:.4f}, cd {cd:.5f}, {words}")


def _show_section(section: Section, as_json: bool) -> None:
    data = section.table
    mach = np.array([0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9])
    negative, positive = data.stall_alpha(mach)
    sweep, four, moment = (
        np.deg2rad(np.arange(0.0, 20.0, 0.1)),
        np.deg2rad(4.0),
        data.moment(0.0, mach),
    )
    values: dict[Column, Array] = {
        Column("Mach", ".2f", "mach"): mach,
        Column("slope/deg", ".4f", "cl_alpha_per_deg"): np.deg2rad(data.lift_slope(mach)),
        Column("alpha0 deg", ".2f", "zero_lift_deg"): np.rad2deg(data.zero_lift_alpha(mach)),
        Column("stall- deg", ".1f", "stall_negative_deg"): np.rad2deg(negative),
        Column("stall+ deg", ".1f", "stall_positive_deg"): np.rad2deg(positive),
        Column("cl max", ".3f", "cl_max"): data(sweep[:, None], mach).cl.max(axis=0),
        Column("cl(4)", ".3f", "cl_at_4_deg"): data(four, mach).cl,
        Column("cd(0)", ".4f", "cd_at_0_deg"): data(0.0, mach).cd,
        Column("cd(4)", ".4f", "cd_at_4_deg"): data(four, mach).cd,
    }
    if moment is not None:
        values[Column("cm(0)", ".4f", "cm_at_0_deg")] = moment
    divergence = {
        f"{a:g}": round(float(data.drag_divergence_mach(np.deg2rad(a))), 3) for a in (0.0, 2.0, 4.0)
    }
    offset = float(np.rad2deg(section.incidence_offset))
    if as_json:
        answer = {
            "name": section.name,
            "source": data.source,
            "mach_limit": data.mach_limit,
            "incidence_offset_deg": round(offset, 6),
            "chord_ratio": section.chord_ratio,
            "drag_divergence_mach": divergence,
            **{column.key: [round(float(v), 5) for v in cells] for column, cells in values.items()},
        }
        print(json.dumps(answer))
        return
    print(wrapped(f"{section.name}: {data.source}", "  "))
    print(
        f"data to Mach {data.mach_limit:g}; chord line {offset:g} deg nose-down of, "
        f"and chord {section.chord_ratio:g} times, those of SC1095"
    )
    print(table(values, zip(*values.values(), strict=True)).text())
    print(
        "drag divergence (dcd/dM = 0.1) at Mach "
        + ", ".join(f"{m:g} at {a} deg" for a, m in divergence.items())
    )
