"""What `study show` says of a result: the best, the robust best, what matters, what failed."""

import math
from collections import Counter
from typing import Any

from rotor.study.findings import Effect, RobustDesign, best_row, effects, robust_best
from rotor.study.results import Results
from rotor.study.study import check_uncertain

_SENTENCES = 3
"""Different sentences of failed points that are printed."""


def record(results: Results, least: str | None = None, uncertain: tuple[str, ...] | None = None) -> dict[str, Any]:
    """The JSON of `study show --json`; None where there is no answer. ValueError for a column or axis there is not."""
    least, uncertain = _aims(results, least, uncertain)
    row = best_row(results, least)
    robust = robust_best(results, least, uncertain) if uncertain else None
    return {
        "title": results.about.get("title", ""),
        "points": results.points,
        "done": results.rows,
        "failed": int((~results.good).sum()),
        "sentences": _sentences(results),
        "least": least,
        "best": None if row is None else _row(results, row),
        "uncertain": list(uncertain),
        "robust": None
        if robust is None
        else {
            "least_worst": _robust(robust.least_worst),
            "least_mean": _robust(robust.least_mean),
            "designs": robust.designs,
            "dropped": robust.dropped,
        },
        "sensitivities": [_effect(one) for one in effects(results, least)],
        "package_version": results.about.get("package_version", ""),
        "commit": results.about.get("commit") or None,
    }


def report(results: Results, least: str | None = None, uncertain: tuple[str, ...] | None = None) -> str:
    """The same for a reader."""
    shown = record(results, least, uncertain)
    least = shown["least"]
    assert least is not None

    def value(number: float) -> str:
        return _shown(number, results.unit(least))

    lines = [f"{shown['title']}: {shown['done']:,} of {shown['points']:,} points, {shown['failed']:,} failed"]
    best = shown["best"]
    if best is None:
        lines.append(f"no point has a value of {least}")
    else:
        where = [*results.axes, *(name for name in ("twist",) if name not in results.axes)]
        lines += ["", f"least {least}: {value(best[least])}", f"  {_at({name: best[name] for name in where})}"]
    robust = shown["robust"]
    if robust is not None:
        cases = robust["least_worst"]["cases"]
        counts = f"{_count(cases, 'case')}; {_count(robust['designs'], 'design')}"
        lines += ["", f"robust over {', '.join(shown['uncertain'])} ({counts})"]
        for name, one in (("least worst case", robust["least_worst"]), ("least mean", robust["least_mean"])):
            lines.append(f"  {name:<17} worst {value(one['worst'])}, mean {value(one['mean'])}: {_at(one['design'])}")
        if robust["dropped"]:
            lines.append(f"  {_count(robust['dropped'], 'design')} left out: a case failed, or is not done yet")
    elif shown["uncertain"]:
        lines += ["", f"no design has an answer in every case of {', '.join(shown['uncertain'])}"]
    if shown["sensitivities"]:
        so_far = "" if shown["done"] == shown["points"] else ", as far as it is known"
        lines += ["", f"what {least} depends on{so_far}: share of its variance; mean where that is least … most"]
        for one in shown["sensitivities"]:
            ends = (
                f"{value(one['least'])} at {_text(one['least_at'])} … {value(one['most'])} at {_text(one['most_at'])}"
            )
            lines.append(f"  {one['axis']:<20}{100 * one['share']:6.1f} %   {ends}")
    if shown["failed"]:
        lines += ["", f"{shown['failed']:,} failed, for example:"]
        lines += [f"  {count:,} × {sentence}" for sentence, count in shown["sentences"].items()]
    return "\n".join(lines)


def _sentences(results: Results) -> dict[str, int]:
    messages: list[str] = results.columns["message"][~results.good].tolist()
    return dict(Counter(messages).most_common(_SENTENCES))


def _aims(results: Results, least: str | None, uncertain: tuple[str, ...] | None) -> tuple[str, tuple[str, ...]]:
    least = least or str(results.about.get("least", "power_total_w"))
    numbers = [name for name in results.columns if results.numeric(name)]
    if least not in numbers:
        raise ValueError(f"column {least!r} is not there to make small: use one of {', '.join(numbers)}")
    if uncertain is None:
        uncertain = tuple(results.about.get("uncertain", ()))
    else:
        check_uncertain(uncertain, results.axes, results.sampled)
    return least, uncertain


def _row(results: Results, row: int) -> dict[str, Any]:
    values = {name: column[row] for name, column in results.columns.items()}
    return {name: _plain(value) for name, value in values.items()}


def _robust(one: RobustDesign) -> dict[str, Any]:
    design = {name: _plain(value) for name, value in one.design.items()}
    return {"design": design, "worst": one.worst, "mean": one.mean, "cases": one.cases}


def _effect(one: Effect) -> dict[str, Any]:
    return {
        "axis": one.axis, "share": one.share, "least_at": one.least_at, "least": one.least, "most_at": one.most_at,
        "most": one.most,
    }  # fmt: skip


def _plain(value: Any) -> Any:
    if isinstance(value, float):  # numpy's own are floats as well.
        return float(value) if math.isfinite(value) else None
    return value


def _at(values: dict[str, Any]) -> str:
    return ", ".join(f"{name} {_text(value)}" for name, value in values.items())


def _count(number: int, noun: str) -> str:
    return f"{number:,} {noun}{'' if number == 1 else 's'}"


def _text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _shown(number: float, unit: str) -> str:
    if unit == "W":
        return f"{number / 1e3:.2f} kW"
    return f"{number:.6g}{' ' if unit not in ('', '°', '%') else ''}{unit}"
