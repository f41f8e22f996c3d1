"""What a schedule has found so far, on disk: one line of JSON a cell, so that a run broken off goes on where it was."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

from rotor.design.fingerprint import fingerprint
from rotor.optimisation.schedule import Cell, Plan
from rotor.optimisation.search import Ended, Minimum, Optimum

FORMAT = "rotor-explorer schedule"


def read_cells(path: str | Path, plan: Plan) -> list[Cell]:
    """Cells of an earlier run of the same plan; none where the file does not exist yet.

    A last line cut short by a crash is left out. Raises ValueError for a file of another plan, or of something else.
    """
    path = Path(path)
    if not path.exists():
        return []
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
        heading: Any = json.loads(lines[0]) if lines else None
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise ValueError(f"schedule file {str(path)!r} cannot be read ({error}): give another file") from None
    if not isinstance(heading, dict) or cast(dict[str, Any], heading).get("format") != FORMAT:
        raise ValueError(f"{str(path)!r} is no schedule file: give another file, or one that does not exist yet")
    if cast(dict[str, Any], heading).get("plan") != fingerprint(plan):
        raise ValueError(
            f"schedule file {str(path)!r} belongs to other flags: repeat those of its run, or give another file"
        )
    cells: list[Cell] = []
    for line in lines[1:]:
        try:
            entry: Any = json.loads(line)
        except json.JSONDecodeError:
            continue
        cells.append(_cell(entry, plan))
    return cells


def open_cells(path: str | Path, plan: Plan) -> Callable[[Cell], None]:
    """Begin or continue the file; the function returned adds a cell at once."""
    path = Path(path)

    def add(text: str) -> None:
        try:
            with path.open("a", encoding="utf-8") as file:
                file.write(text + "\n")
        except OSError as error:
            raise ValueError(f"cannot write {str(path)!r} ({error.strerror}): give a writable file") from None

    if not path.exists():
        add(json.dumps({"format": FORMAT, "plan": fingerprint(plan)}))
    elif not path.read_text(encoding="utf-8").endswith("\n"):
        add("")
    return lambda cell: add(json.dumps(_record(cell), allow_nan=False))


def _record(cell: Cell) -> dict[str, Any]:
    one = cell.optimum
    return {
        "leg": cell.leg,
        "concept": cell.concept,
        "status": one.status.value,
        "message": one.message,
        "minima": [
            [list(m.parameters), m.power, list(m.starts), list(m.active)]
            for m in (one.minima or ((one.best,) if one.best is not None else ()))
        ],
        "baseline_power": one.baseline_power,
        "evaluations": one.evaluations,
        "starts": one.starts,
        "seed": one.seed,
        "elapsed": one.elapsed,
    }


def _cell(entry: dict[str, Any], plan: Plan) -> Cell:
    concept = next(one for one in plan.concepts if one.name == entry["concept"])
    minima = tuple(
        Minimum(tuple(values), power, concept.twist(values).spec(), tuple(starts), tuple(active))
        for values, power, starts, active in entry["minima"]
    )
    design = plan.design_at(entry["leg"])
    best = minima[0] if minima else None
    optimum = Optimum(
        status=Ended(entry["status"]),
        message=entry["message"],
        concept=concept.name,
        design=design if best is None else concept.apply(design, best.parameters),
        best=best,
        minima=minima,
        band=(),
        baseline_power=entry["baseline_power"],
        evaluations=entry["evaluations"],
        starts=entry["starts"],
        seed=entry["seed"],
        elapsed=entry["elapsed"],
    )
    return Cell(entry["leg"], concept.name, optimum)
