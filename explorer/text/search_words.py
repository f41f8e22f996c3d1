"""A search in words: where it stands, what it found and what that saves."""

from explorer.model.search_run import SearchRun
from explorer.model.units import SI, Units, number
from rotor import Optimum
from rotor.optimisation import Concept
from rotor.support.markup import Content, Markup, tag

_EQUAL = 50.0
"""Powers closer than this [W] read the same."""


def headline(run: SearchRun, units: Units = SI) -> Markup:
    """The least power so far as a large number, and its change from the start."""
    best = run.best
    if best is None:
        return Markup()
    change = None if run.start_power is None else best.power - run.start_power
    kind = "" if change is None or abs(change) < _EQUAL else "rx-less" if change < 0.0 else "rx-more"
    objective = run.search.objective
    several = objective is not None and len(objective.conditions) > 1
    mean = "mean power" if several else f"{'total' if objective is None else objective.quantity} power"
    mean += ", best so far" if run.under_way else ", best found"
    return tag(
        "div.rxp-big",
        tag("b", units.watts(best.power, 1), data_explorer="best"),
        tag("em", None if change is None else units.watts(change, 1, sign=True), class_=kind),
        tag("div.rx-dim", mean, _against_start(best.power, run.start_power)),
    )


def standing(run: SearchRun | None, problem: str = "") -> Markup:
    """One line beneath the bar: where the search stands."""
    if problem:
        return tag("div.rx.rx-found", tag("b", problem), data_explorer="search", data_kind="broken")
    if run is None:
        return tag("div.rx.rx-dim", "Not run yet.", data_explorer="search", data_kind="idle")
    progress = run.progress
    count = "" if progress is None else f"{number(progress.evaluation)} designs · {number(progress.elapsed, 1)} s"
    if run.optimum is not None:
        count = f"{number(run.optimum.evaluations)} designs · {number(run.optimum.elapsed, 1)} s"
    where = tag("span", _where(run)), tag("span.rx-dim.rx-num", count)
    return tag("div.rx.rx-line", where, data_explorer="search", data_kind=run.record.state)


def _where(run: SearchRun) -> str:
    progress, running = run.progress, "Trimming the starting design …"
    if progress is not None:
        at = f"Starting point {progress.start + 1} of {progress.starts}"
        running = "Computing the 0.1 % band" if progress.phase == "band" else at
    return run.record.words(running, "best so far is kept" if run.best else "nothing found yet")


def _against_start(power: float, start: float | None) -> str:
    if not start or start <= 0.0:
        return "; the starting design has no trim"
    return f", {number(100.0 * (power / start - 1.0), 2, sign=True)} % vs. start"


def result(run: SearchRun, units: Units = SI) -> Markup:
    """What the best so far saves against what is not the starting design; or why there is none."""
    best = run.best
    parts: list[Markup] = []
    if run.record.state == "broken":
        parts.append(tag("div.rx-broken", run.sentence))
    if best is None:
        if run.record.state == "done":
            parts.append(tag("div", run.sentence))
        return _block(parts)
    if run.optimum is not None and run.optimum.doubt is not None:
        parts.append(tag("div", run.optimum.doubt.sentence, data_explorer="sure"))
    if run.reference_power != run.start_power:
        parts.append(tag("table", _saving(run.record.task.reference_title, best.power, run.reference_power, units)))
    return _block(parts)


def details(run: SearchRun) -> Markup:
    """What the optimum is made of, and how flat it is."""
    optimum = run.optimum
    if optimum is None or optimum.best is None:
        return Markup()
    return _block(_optimum(optimum, run.concept), "details")


def _block(parts: list[Markup], name: str = "found") -> Markup:
    return tag("div.rx.rx-found", parts, data_explorer=name) if parts else Markup()


def _saving(title: str, power: float, reference: float | None, units: Units) -> Markup:
    if reference is None or reference <= 0.0:
        return tag("tr", tag("td.rx-dim", title), tag("td.rx-num", "has no trim"), tag("td"))
    less = power <= reference
    percent = 100.0 * (power / reference - 1.0)
    kind = "" if abs(percent) < 0.005 else "rx-less" if less else "rx-more"
    return tag(
        "tr",
        tag("td.rx-dim", "saving vs. " if less else "above ", title),
        tag("td.rx-num", units.watts(abs(power - reference), 1)),
        tag("td.rx-num", f"{number(abs(percent), 2)} %", class_=kind, style="width:26%"),
    )


def _optimum(optimum: Optimum, concept: Concept) -> list[Markup]:
    best = optimum.best
    assert best is not None
    rows, notes = list[Content](), [optimum.message]
    for parameter, value in zip(concept.parameters, best.parameters, strict=True):
        digits = 1 if parameter.angular else 2
        rows.append(
            tag(
                "tr",
                tag("td", parameter.title),
                tag("td.rx-num", number(parameter.shown(value), digits)),
                tag("td.rx-dim.rx-unit", parameter.shown_unit),
            )
        )
    if best.active:
        notes.append(f"Active limits: {', '.join(name.replace('_', ' ') for name in best.active)}.")
    if best.index is not None:
        notes.append(f"Vibration index {number(best.index, 1)} %.")
    return [tag("table", rows), tag("div.rx-dim.rx-small", " ".join(notes))]


def frame_line(run: SearchRun, cursor: int, units: Units = SI) -> Markup:
    """What the scrubber points at."""
    frame = run.frames[cursor]
    power = frame.power if frame.power < 1e12 else None  # A design that did not trim has no power.
    what = "starting design" if cursor == 0 else f"design {frame.evaluation}"
    line = tag("span", what), tag("span", units.watts(power, 1))
    return tag("div.rx.rx-line.rx-dim.rx-small", line, data_explorer="frame")
