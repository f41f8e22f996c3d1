"""Where a file comes from: the design, the models, the versions; and a name for it that says what is in it."""

import platform
import re
from functools import cache
from importlib.metadata import PackageNotFoundError, version

from explorer.text.design_words import inflow_words, physics_words
from rotor.assets import commit
from rotor.design.design import Design
from rotor.trim.solution import Solution

PROGRAM = "rotor explorer"
_SHOWN = {"rotor-explorer": PROGRAM, "viser": "viser", "numpy": "NumPy", "scipy": "SciPy", "numba": "Numba"}


@cache
def versions() -> dict[str, str]:
    """Version of the program (with the commit, where it runs from a checkout) and of what it computes with."""
    found: dict[str, str] = {}
    for package, shown in _SHOWN.items():
        try:
            found[shown] = version(package)
        except PackageNotFoundError:
            found[shown] = "unknown"
    at = commit()
    if at:
        found[PROGRAM] += f" (commit {at.removesuffix('+')}{', changed' if at.endswith('+') else ''})"
    found["Python"] = platform.python_version()
    return found


def condition_line(design: Design) -> str:
    """Advance ratio, mass and altitude in one line."""
    condition = design.condition
    speed = "hover" if design.hovering else f"advance ratio {condition.advance_ratio:g}"
    return f"{speed}, {condition.mass:.0f} kg, {condition.altitude:.0f} m"


def provenance_lines(solution: Solution) -> list[str]:
    """What stands above a table of data: design, condition, models, how it converged, caveats, versions."""
    design = solution.design
    models = design.models
    lines = [
        f"{design.rotor.name}, twist {design.twist.spec()}",
        condition_line(design),
        f"preset {design.preset}; inflow {inflow_words(design)}; {physics_words(design)}; "
        f"{models.elements} x {models.azimuths} elements and azimuths",
        f"{solution.status.value}: {solution.message} Residual {solution.residual:.1e} of weight.",
        f"total power {solution.power.total / 1e3:.6f} kW, main rotor {solution.power.main_rotor / 1e3:.6f} kW",
    ]
    if design.active_twist is not None:
        waves = ", ".join(f"{one.per_rev}/rev {one.amplitude:g} rad" for one in design.active_twist.harmonics)
        lines.insert(1, f"added active twist: {waves}" + (" (at rest in hover)" if design.hovering else ""))
    lines += [f"caveat: {caveat.sentence}" for caveat in solution.caveats]
    lines.append(", ".join(f"{name} {number}" for name, number in versions().items()))
    lines.append("A model, not a measurement.")
    return lines


def file_stem(design: Design, *parts: str) -> str:
    """A file name without ending: rotor, twist, speed and what else tells files apart; safe on every system."""
    speed = "hover" if design.hovering else f"mu{design.condition.advance_ratio:.3f}"
    words = [design.rotor.name, design.twist.spec(), speed, *parts]
    safe = (re.sub(r"[^a-z0-9.+-]+", "_", word.lower()).strip("_.") for word in words)
    return "-".join(word[:60] for word in safe if word)
