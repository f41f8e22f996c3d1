"""`waterfall`: power of each physical effect, switched on one after another."""

import argparse
import json
from typing import Any

from rotor.analysis.waterfall import PARTS, Waterfall, WaterfallStep, waterfall
from rotor.command.flags import add_command, add_design_arguments, design_from, finite


def add_parser(commands: Any) -> None:
    """Register the command."""
    parser = add_command(commands, "waterfall", "power of tip loss, flapping, reverse flow …, one after another")
    parser.add_argument("--mu", type=finite, metavar="MU", help="advance ratio (default 0.2); 0 is hover")
    add_design_arguments(parser, one_twist=True)
    parser.add_argument("--json", action="store_true", help="machine-readable output")
    parser.set_defaults(run=run)


def run(args: argparse.Namespace) -> int:
    """0 when every step converged, else 1."""
    design = design_from(args, args.twist, args.mu)
    found = waterfall(design)
    print(json.dumps(record(found), indent=2, allow_nan=False) if args.json else report(found))
    return 0 if found.converged else 1


def record(found: Waterfall) -> dict[str, Any]:
    """The JSON; values of a step that did not trim are null."""
    design = found.full.design
    return {
        "status": "converged" if found.converged else "not-converged",
        "mu": design.condition.advance_ratio,
        "preset": design.preset,
        "inflow": design.models.inflow if not design.hovering else design.models.hover_inflow,
        "twist": design.twist.spec(),
        "steps": [_step_record(step) for step in found.steps],
        "each_alone_off": [_step_record(step) for step in found.alone],
    }


def _step_record(step: WaterfallStep) -> dict[str, Any]:
    return {
        "switch": step.switch.flag if step.switch else None,
        "total_w": step.power,
        "change_w": step.change,
        "hub_moment_n_m": step.solution.hub_moment.size if step.solution.converged else None,
        "note": step.note or ("" if step.solution.converged else step.solution.message),
    }


def report(found: Waterfall) -> str:
    """The same as two tables."""
    design = found.full.design
    heading = f"{'kW':<18}{'total':>9}{'change':>9}" + "".join(f"{part:>10}" for part in PARTS)
    return "\n".join(
        [
            f"{design.rotor.name}, preset {design.preset}, twist {design.twist.spec()}, "
            f"µ {design.condition.advance_ratio:.4g}",
            "",
            "Switched on one after another",
            heading,
            *(_line(step) for step in found.steps),
            "",
            "Each effect removed on its own",
            heading,
            *(_line(step) for step in found.alone),
        ]
    )


def _line(step: WaterfallStep) -> str:
    note = f"   {step.note}" if step.note else ""
    if step.power is None:
        return f"{step.title:<18}{step.solution.message}"
    start = f"{step.title:<18}{step.power / 1e3:9.1f}"
    if step.change is None or step.added is None:
        power = step.solution.power
        return f"{start}{'':9}" + "".join(f"{getattr(power, part) / 1e3:10.1f}" for part in PARTS)
    changes = "".join(f"{_kilowatts(step.change[part]):+10.1f}" for part in PARTS)
    return f"{start}{_kilowatts(step.added):+9.1f}{changes}{note}"


def _kilowatts(power: float) -> float:
    """Kilowatts rounded as printed, without negative zero."""
    return round(power / 1e3, 1) + 0.0
