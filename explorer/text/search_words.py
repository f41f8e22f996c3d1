"""A search in words: where it stands, what it found and what that saves."""

from explorer.model.search_run import SearchRun
from explorer.model.units import SI, Units, number
from explorer.text.readout import banded, change_kind, total_words
from rotor import Optimum
from rotor.optimisation import Concept
from rotor.optimisation.concept import Parameter
from rotor.optimisation.results import ParameterBand
from rotor.support.markup import Content, Markup, tag
from rotor.trim.doubt import decimals


def headline(run: SearchRun, units: Units = SI) -> Markup:
    """The least power so far as a large number, and its change from the start."""
    best = run.best
    if best is None:
        return Markup()
    change = None if run.start_power is None else best.power - run.start_power
    sure = None if run.optimum is None or run.optimum.doubt is None else run.optimum.doubt.sureness
    kind = change and change_kind(change, sure)
    objective = run.search.objective
    several = objective is not None and len(objective.conditions) > 1
    mean = (
        "mean power" if several else f"{'total' if objective is None else objective.quantity} power"
    )
    mean += ", best so far" if run.under_way else ", best found"
    return tag(
        "div.rxp-big",
        tag("b", total_words(best.power, units), data_explorer="best"),
        tag(
            "em",
            None if change is None else _moved(change, run.optimum, units),
            class_=f"rx-{kind}" if kind else None,
        ),
        tag("div.rx-dim", mean, "" if run.start_power else "; the starting design has no trim"),
    )


def standing(run: SearchRun | None, problem: str = "") -> Markup:
    """One line beneath the bar: where the search stands."""
    if problem:
        return tag("div.rx.rx-found", tag("b", problem), data_explorer="search", data_kind="broken")
    if run is None:
        return tag("div.rx.rx-dim", "Not run yet.", data_explorer="search", data_kind="idle")
    progress = run.progress
    count = (
        ""
        if progress is None
        else f"{number(progress.evaluation)} designs · {number(progress.elapsed, 1)} s"
    )
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


def _moved(change: float, optimum: Optimum | None, units: Units) -> str:
    """The change from the start [W]; with its band once the search has ended."""
    band = None if optimum is None or optimum.doubt is None else optimum.doubt.change_band
    return (
        units.watts(change, 1, sign=True)
        if band is None
        else banded(change, band, units, sign=True)
    )


def result(run: SearchRun) -> Markup:
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
        words = run.optimum.doubt.in_words("Against the starting design it")
        parts.append(tag("div", words, data_explorer="sure"))
    if run.reference_doubt is not None:
        words = f"Against {run.record.task.reference_title} it {run.reference_doubt.saving_words}."
        parts.append(tag("div", words, data_explorer="sure-reference"))
    return _block(parts)


def details(run: SearchRun, units: Units = SI) -> Markup:
    """What the optimum is made of, and how flat it is."""
    optimum = run.optimum
    if optimum is None or optimum.best is None:
        return Markup()
    return _block(_optimum(optimum, run.concept, units), "details")


def _block(parts: list[Markup], name: str = "found") -> Markup:
    return tag("div.rx.rx-found", parts, data_explorer=name) if parts else Markup()


def _range(parameter: Parameter, band: ParameterBand) -> str:
    half = 0.5 * (parameter.shown(band.high) - parameter.shown(band.low))
    digits = min(_digits(parameter), decimals(half)) if half > 0.0 else _digits(parameter)
    low, high = (number(parameter.shown(end), digits) for end in (band.low, band.high))
    return f"{parameter.title.lower()} {low} … {high} {parameter.shown_unit}".rstrip()


def _digits(parameter: Parameter) -> int:
    """Decimals of a parameter, as on its slider and in the line on top; a wide range has fewer."""
    return 1 if parameter.angular else 2


def _optimum(optimum: Optimum, concept: Concept, units: Units) -> list[Markup]:
    best = optimum.best
    assert best is not None
    rows, notes = list[Content](), [optimum.message]
    ranges = {band.parameter: band for band in optimum.doubt_band}
    for parameter, value in zip(concept.parameters, best.parameters, strict=True):
        shown = tag("td.rx-num", number(parameter.shown(value), _digits(parameter)))
        unit = tag("td.rx-dim.rx-unit", parameter.shown_unit)
        rows.append(tag("tr", tag("td", parameter.title), shown, unit))
    if ranges and optimum.doubt_cost is not None:
        moved = "; ".join(
            _range(parameter, ranges[parameter.name]) for parameter in concept.parameters
        )
        notes.append(f"With other inputs or inflow: {moved}.")
        notes.append(
            f"The best twist would then need about {units.watts(optimum.doubt_cost, 1)} less than this one."
        )
    if best.active:
        notes.append(f"Active limits: {', '.join(name.replace('_', ' ') for name in best.active)}.")
    if best.index is not None:
        notes.append(f"Vibration index {number(best.index, 1)} %.")
    return [tag("table", rows), tag("div.rx-dim.rx-small", " ".join(notes))]


def frame_line(run: SearchRun, cursor: int, units: Units = SI) -> Markup:
    """What the scrubber points at."""
    power = run.frames[cursor].power  # Without bound where the design did not trim.
    what = "starting design" if cursor == 0 else f"step {cursor} of {len(run.frames) - 1}"
    line = tag("span", what), tag("span", total_words(power, units) if power < 1e12 else None)
    return tag("div.rx.rx-line.rx-dim.rx-small", line, data_explorer="frame")
