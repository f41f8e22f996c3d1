"""Searches, maps, schedules and fronts as the page asks for them, and what it says of each."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from .designs import QUICK
from .pictures import ask_chart, units_by_title
from .record import Record, named

REQUESTS: Mapping[str, tuple[Mapping[str, Any], Mapping[str, Any]]] = {
    "linear": ({"concept": "linear"}, {"mu": 0.3, **QUICK}),
    "two segments": ({"concept": "two-segment"}, {"mu": 0.3, "twist": "linear:-16", **QUICK}),
    "free break": ({"concept": "two-segment-free"}, {"mu": 0.2, **QUICK}),
    "two airfoils": (
        {"concept": "two-segment-two-airfoils", "division": 0.6},
        {"mu": 0.3, **QUICK},
    ),
    "hover and cruise": (
        {"concept": "linear", "objective": "hover-cruise", "hover_share": 30.0},
        {"mu": 0.3, **QUICK},
    ),
    "mission": ({"concept": "quadratic", "objective": "mission"}, {"mu": 0.2, **QUICK}),
    "induced": ({"concept": "linear", "objective": "induced"}, {"mu": 0.2, **QUICK}),
    "limited": (
        {"concept": "linear", "stalled": 1.0, "change": 2.0},
        {"mu": 0.35, "mass_kg": 9000.0, **QUICK},
    ),
    "drees": ({"concept": "linear"}, {"mu": 0.25, "inflow": "drees"}),
    "hover": ({"concept": "linear"}, {"hover": True}),
    "vibration": (
        {"concept": "linear", "index": 2.0},
        {"mu": 0.3, "bending": True, "inflow": "drees"},
    ),
    "no cruise": ({"objective": "hover-cruise"}, {"hover": True}),
    "no bending": ({"index": 2.0}, {"mu": 0.3, **QUICK}),
}
"""What a search is asked for, and its design."""


def write(record: Record) -> None:
    """Searches with their words, then maps, schedules, fronts and the best linear twist."""
    for name, (request_fields, arguments) in REQUESTS.items():
        record.scenario(name, search, name, request_fields, arguments)
    for name in ("two-segment", "quadratic", "two-segment-free"):
        record.scenario(f"map of {name}", draw_map, name)
    record.scenario("schedule", search_schedule)
    record.scenario("front", search_front)
    for name, arguments in {
        "µ 0.3": {"mu": 0.3, "inflow": "drees"},
        "hover": {"hover": True},
    }.items():
        best = record.ask(
            f"best linear twist at {name}",
            "rotor.optimisation.search.best_linear_twist",
            named("rotor.make_design")(**arguments),
        )
        for title, units in units_by_title().items():
            record.ask(
                f"best linear twist at {name}/{title}",
                "explorer.charts.doubt.twist_ranges",
                best,
                units,
            )


def search(
    record: Record, name: str, request_fields: Mapping[str, Any], arguments: Mapping[str, Any]
) -> None:
    """Keep what a search that the page asks for finds, as a worker process runs it, and what is said of it."""
    design = named("rotor.make_design")(**arguments)
    request = record.ask(
        f"{name}/request", "explorer.model.search_run.SearchRequest", **request_fields
    )
    legs = named("explorer.model.search_run.legs")
    objective = record.ask(f"{name}/search", lambda: str(request.search(design, legs).objective))
    if objective is None:
        # The page refuses the request: the reason is kept.
        return
    few_starts = replace(request.search(design, legs), starts=2)
    built = named("explorer.model.inputs.baseline_of")(design)
    task = record.make(
        f"{name}/task", "explorer.workers.solver.SearchTask", few_starts, built, "as built"
    )
    reports = list[Any]()
    optimum = record.ask(f"{name}/optimum", task.run, reports.append, lambda: False)
    # In a list, each report has one line.
    record.keep(f"{name}/reports", {number: [one] for number, one in enumerate(reports)})
    for state, work in search_states(record, name, task, reports, optimum).items():
        describe_search(record, f"{name}/{state}", work)


def search_states(
    record: Record, name: str, task: Any, reports: Sequence[Any], optimum: Any
) -> dict[str, Any]:
    """The page's record of a search at four moments: under way, stopped, done, and after the process broke."""
    begun = record.make(
        f"{name}/record",
        "explorer.workers.background.WorkRecord",
        task,
        "running",
        0,
        tuple(reports[:3]),
    )
    ended = named("rotor.support.processes.JobEnded")
    failed = named("rotor.support.processes.JobFailed")
    return {
        "begun": begun,
        "stopped": replace(begun, reports=tuple(reports[:5])).then(ended(None, stopped=True)),
        "done": replace(begun, reports=tuple(reports)).then(ended(optimum)),
        "broken": begun.then(failed("No more memory.")),
    }


def describe_search(record: Record, name: str, work: Any) -> None:
    """Keep all that the page says of a search from its record, and of each frame of it."""
    words = "explorer.text.search_words"
    run = record.make(f"{name}/run", "explorer.model.search_run.SearchRun", work)
    record.ask(f"{name}/standing", f"{words}.standing", run)
    record.ask(f"{name}/result", f"{words}.result", run)
    record.ask_attribute(f"{name}/part done", run, "part_done")
    for title, units in units_by_title().items():
        record.ask(f"{name}/{title}/headline", f"{words}.headline", run, units)
        record.ask(f"{name}/{title}/details", f"{words}.details", run, units)
        for frame in range(len(run.frames)):
            record.ask(f"{name}/{title}/frame {frame}", f"{words}.frame_line", run, frame, units)


def draw_map(record: Record, name: str) -> None:
    """Keep power over two parameters of a concept, as a worker process reports it, and its drawing."""
    design = named("rotor.make_design")(mu=0.3, twist="linear:-12", **QUICK)
    concept = named("rotor.optimisation.concepts.CONCEPTS")[name]
    maps = "explorer.charts.power_map"
    place = f"map of {name}"
    axes = record.ask(f"{place}/axes", f"{maps}.default_axes", concept)
    objective = named("rotor.optimisation.at_condition")(design)
    start = record.ask(
        f"{place}/start", "rotor.optimisation.concept.nearest", concept, design.twist
    )
    task = record.make(
        f"{place}/task",
        "explorer.workers.solver.MapTask",
        design,
        concept,
        objective,
        axes,
        start,
    )
    reports = list[Any]()
    # The coarse grid is enough: the finer ones are computed alike.
    record.ask(f"{place}/run", task.run, reports.append, lambda: bool(map_levels(reports)))
    record.keep(f"{place}/reports", reports)
    coarse = map_levels(reports)[0]
    powers = named("numpy.array")(coarse.powers, dtype=float)
    power_map = record.make(
        f"{place}/drawn", f"{maps}.PowerMap", task, powers, coarse.values, coarse.least
    )
    record.ask(f"{place}/drawing", f"{maps}.drawing", power_map, design.twist)
    record.ask(f"{place}/place", f"{maps}.place_on", power_map, design.twist)
    record.ask(f"{place}/at", lambda: str(power_map.at(0.3, 0.7)))
    for title, units in units_by_title().items():
        record.ask(f"{place}/{title}/least", f"{maps}.least_words", power_map, units)


def map_levels(reports: Sequence[Any]) -> list[Any]:
    """The whole grids among what a task reports; the other reports are how much of it is done."""
    return [
        report for report in reports if hasattr(report, "powers") and getattr(report, "whole", True)
    ]


def search_schedule(record: Record) -> None:
    """Keep the best twist of each flight condition and the best fixed blade, with what the page shows of them."""
    design = named("rotor.make_design")(mu=0.2, **QUICK)
    concept = named("rotor.optimisation.concepts.CONCEPTS")["linear"]
    limits = named("rotor.optimisation.limits.Limits")()
    legs = record.ask(
        "schedule/legs", "explorer.model.search_run.legs", design, "0:1, 0.2:2, 0.3:1"
    )
    asked = record.make(
        "schedule/plan",
        "rotor.optimisation.SchedulePlan",
        design,
        (concept,),
        legs,
        "total",
        limits,
        1,
    )
    task = record.make("schedule/task", "explorer.workers.solver.ScheduleTask", asked)
    reports = list[Any]()
    record.ask(
        "schedule/ended", lambda: str(type(task.run(reports.append, lambda: False)).__name__)
    )
    views = "explorer.charts.schedule_view"
    for count in (1, len(reports)):
        one = record.make(
            f"schedule/{count}/record", "explorer.workers.background.WorkRecord", task, "running", 0,
            tuple(reports[:count]),
        )  # fmt: skip
        progress = record.make(f"schedule/{count}/progress", f"{views}.ScheduleProgress.of", one)
        place = f"schedule/{count}"
        ask_chart(record, f"{place}/twist", f"{views}.twist_chart", progress, None)
        ask_chart(record, f"{place}/saving", f"{views}.saving_chart", progress, None)
        record.ask_attribute(f"schedule/{count}/count", progress, "count")
        record.ask(f"schedule/{count}/csv", f"{views}.csv_of", progress)
        for title, units in units_by_title().items():
            record.ask(f"schedule/{count}/{title}/table", f"{views}.table", progress, units)
            record.ask(f"schedule/{count}/{title}/verdict", f"{views}.verdict", progress, units)


def search_front(record: Record) -> None:
    """Keep the response of vibration to harmonics, and the front of power against vibration."""
    design = named("rotor.make_design")(mu=0.3, bending=True, inflow="drees")
    matrix = record.ask("front/matrix", "rotor.t_matrix", design, (2, 3))
    if matrix is not None:
        record.ask("front/response", lambda: matrix.response("3:1:0"))
    front = record.make("front/found", "rotor.vibration_front", design, points=3)
    if front is not None:
        record.keep("front/printed", repr(front))
        record.keep(
            "front/points", {number: repr(point) for number, point in enumerate(front.points)}
        )
