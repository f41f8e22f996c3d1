"""What every panel of the page shows, asks and moves, as a function of the page's state; no browser, no threads."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from .record import Record, named

LINEAR = {"law": "builtin", "advance_ratio": 0.2, "inflow": "drees"}
EXPLORED: Mapping[str, Mapping[str, Any]] = {
    "opening": {"law": "builtin"},
    "linear inflow": LINEAR,
    "moved": {**LINEAR, "built_outer": -2.5},
    "two segments": {"law": "two", "advance_ratio": 0.3, "inflow": "drees"},
    "quadratic": {"law": "quadratic", "advance_ratio": 0.25, "inflow": "drees"},
    "linear twist": {"law": "linear", "linear": -16.0, "advance_ratio": 0.35, "mass_t": 9.0},
    "ideal": {"law": "ideal", "advance_ratio": 0.0},
    "hover": {"law": "builtin", "advance_ratio": 0.0},
    "slow": {"law": "builtin", "advance_ratio": 0.06},
    "high and hot": {
        "law": "linear",
        "advance_ratio": 0.15,
        "altitude_m": 1500.0,
        "isa_offset_c": 15.0,
    },
    "climbing": {"law": "builtin", "advance_ratio": 0.12, "climb_m_s": 4.0, "inflow": "drees"},
    "descending": {"law": "builtin", "advance_ratio": 0.15, "climb_m_s": -5.0, "inflow": "drees"},
    "bending": {"law": "builtin", "advance_ratio": 0.3, "bending": True, "inflow": "drees"},
    "without stall": {**LINEAR, "stall": False, "flapping": False},
    "thesis": {"law": "linear", "preset": "thesis", "advance_ratio": 0.2},
    "stalled": {
        "law": "linear",
        "linear": -2.0,
        "advance_ratio": 0.38,
        "mass_t": 9.5,
        "inflow": "drees",
    },
    "bo105": {"rotor": "bo105", "law": "builtin", "mass_t": 2.2, "advance_ratio": 0.2},
    "r22": {"rotor": "r22", "law": "builtin", "mass_t": 0.62, "advance_ratio": 0.15},
    "beyond": {"law": "builtin", "advance_ratio": 0.45, "mass_t": 11.0},
}
"""Sliders of Explore, by what they show."""
ROTORS = ("xv15", "knight-hefner-3", "hart2", "2mrts", "gazelle", "s61")
"""Rotors that are chosen from the menu as they come."""
DRIVEN = (77.0, 0.0, 0.0, 0.0, 0.0)
ACTUATED: Mapping[str, Mapping[str, Any]] = {
    "at rest": {},
    "driven": {"actuator": {"drives": DRIVEN}},
    "down": {"actuator": {"drives": (-60.0, 0.0, 0.0, 0.0, 0.0)}},
    "four plies": {"actuator": {"plies": 4, "drives": (100.0,) * 5}},
    "crossed": {"actuator": {"drives": DRIVEN, "crossed": True}},
    "three segments": {
        "actuator": {"concept": "three-segment", "drives": (10.0, -20.0, 30.0, 0.0, 0.0)}
    },
    "new blade": {"actuator": {"blade": "new", "stiffness": 0.6, "drives": DRIVEN}},
    "best fixed": {"actuator": {"against": "best-fixed", "drives": DRIVEN}},
    "stopped": {"actuator": {"drives": DRIVEN}, "stopped": True},
    "here": {"actuator": {"drives": DRIVEN}, "here": True},
    "on stage": {"actuator": {"drives": DRIVEN}, "on_stage": True},
    "supposed": {"on_stage": True, "place": (4.0, 12.0)},
    "flown": {"flown": 2.5, "actuator": {"drives": DRIVEN}},
    "two legs": {"actuator": {"hours": (1.0, 0.0, 0.0, 1.0)}},
}
"""What the hand has set in Actuate, by what it shows; `actuator`: fields of `ActuatorInputs`."""
HARMONICS = ((3, 1.0, 120.0), (4, 0.3, 0.0))
"""Per revolution, amplitude and phase [°]."""
PRESSES: Mapping[str, Sequence[Any]] = {
    "pin": (None,), "swap": (None,), "back": (None,), "along": (True, False), "unstall": (None,),
    "pull": (None, 0.5, -1.0, 2.0), "against": ("same-blade", "best-fixed"), "feasible": (None,),
    "suppose": ("on", "off"), "kind": ("MFC_P2", "SMA_tube"), "balance": ("here", "flight"), "fly": (0.0, 1.5, 4.0),
    "state": ("set", "schedule", "stopped"), "dial": ("start", "end"), "dial_front": (0, 3),
}  # fmt: skip
"""Values of presses, by name."""
TRUSTED = (
    "opening",
    "moved",
    "linear twist",
    "hover",
    "climbing",
    "bending",
    "thesis",
    "bo105",
    "beyond",
    "hart2",
)
"""Of these the drawers are opened, and the disk with the prices of its regions."""
FORESEEN = ("driven", "new blade", "SMA_tube", "at n/rev")
"""With these set in Actuate, its questions that take many trims are answered, too."""
BANDED = ("opening", "linear inflow", "hover", "climbing", "bo105")
"""Of these the band of power over µ is answered."""
PRICED = ("opening", "stalled", "hover")
"""Of these the distance to the edge of stall is answered."""
BAND, DIAL, STROKE = "curve_bands", "dial_answer", "other_stroke"
WATERFALL, EDGES, SLOPES = "waterfall", "stall-edges", "flight-slopes"
"""Functions of worker processes and the page's own works that take many trims."""
ANSWERED_OF = {BAND: BANDED, WATERFALL: TRUSTED, EDGES: PRICED, SLOPES: TRUSTED}
"""The designs of Explore of which each of these is answered."""
FILLS_STATE = ("measured", "flights")
"""Works that fill caches within the page's state: done anew for every state, for their result only says so."""
ROUNDS = 6
"""How often answers may lead to further questions."""


class Answers:
    """Answers to the questions of panels, each worked out once."""

    def __init__(self) -> None:
        self._known: dict[Any, Any] = {}

    def settled(self, now: Any, without: Sequence[str] = ()) -> Any:
        """The page's state with every answer that its panels ask for, but those of functions and works in `without`."""
        panels = [panel for panel in named("explorer.page.PANELS") if panel.seen(now.ui)]
        for _ in range(ROUNDS):
            new = self._new(now, panels, without)
            if not new:
                return now
            now = replace(now, answers={**now.answers, **new})
        return now

    def _new(self, now: Any, panels: Sequence[Any], without: Sequence[str]) -> dict[Any, Any]:
        """Answers to what the panels ask in this state and it does not hold yet, by key; `without`: as of `settled`."""
        found: dict[Any, Any] = {}
        for panel in panels:
            for question in panel.asks(now):
                for call in question.calls:
                    if call not in now.answers and call.function.__name__ not in without:
                        found[call] = self._once(call, call.run)
            for work in panel.works(now):
                if work.key in now.answers or work.key in found or work.name in without:
                    continue
                if work.name in FILLS_STATE:
                    found[work.key] = work_result(work)
                else:
                    found[work.key] = self._once(work.key, partial(work_result, work))
        return found

    def _once(self, key: Any, run: Callable[[], Any]) -> Any:
        """The answer of that key, computed for the first state that asks."""
        if key not in self._known:
            self._known[key] = run()
        return self._known[key]


def write(record: Record) -> None:
    """Explore with each drawer, A and B, and Actuate with each actuator."""
    answers = Answers()
    explored = {name: inputs_of(record, name, fields) for name, fields in EXPLORED.items()}
    for rotor in ROTORS:
        explored[rotor] = record.make(
            rotor, "explorer.model.inputs.with_rotor", named("explorer.model.inputs.OPENING"), rotor
        )
    for name, inputs in explored.items():
        record.scenario(f"explore {name}", explore, name, inputs, answers)
    record.scenario("compare", compare, explored, answers)
    for id in named("rotor.actuator.catalogue.actuators")():
        fields = {"actuator": {"actuator": id, "drives": DRIVEN}}
        record.scenario(f"actuator {id}", actuate, id, fields, LINEAR, answers)
    for name, fields in ACTUATED.items():
        record.scenario(f"actuator {name}", actuate, name, fields, LINEAR, answers)
    for name in ("bo105", "thesis"):
        record.scenario(f"actuator on {name}", actuate, f"on {name}", {}, EXPLORED[name], answers)
    record.scenario(
        "actuator at n/rev", actuate, "at n/rev", {}, {**LINEAR, **at_harmonics()}, answers
    )
    record.scenario("walk", follow, explored)


def at_harmonics() -> dict[str, Any]:
    """Twist at harmonics of the rotor speed, as fields of the sliders."""
    harmonic = named("rotor.design.Harmonic")
    waves = tuple(
        harmonic(n, math.radians(size), math.radians(phase)) for n, size, phase in HARMONICS
    )
    return {"twist_per_rev": waves, "advance_ratio": 0.3, "bending": True}


def explore(record: Record, name: str, inputs: Any, answers: Answers) -> None:
    """Keep the page in Explore; of `TRUSTED` designs with the drawer of power and trim, then with that of trust."""
    now = state_of(record, name, inputs)
    without = tuple(question for question, names in ANSWERED_OF.items() if name not in names)
    if name not in TRUSTED:
        keep_page(record, f"explore {name}", now, answers, without)
        return
    keep_page(record, f"explore {name}", now, answers, without, drawer="details")
    keep_page(record, f"trust {name}", now, answers, without, drawer="trust", disk=True)


def inputs_of(record: Record, name: str, fields: Mapping[str, Any]) -> Any:
    """The sliders with these values."""
    return record.make(f"sliders {name}", "explorer.model.inputs.Inputs", **fields)


def state_of(
    record: Record, name: str, inputs: Any, hand: Any = None, pinned: Any = None, units: str = "SI"
) -> Any:
    """The page's state once its trim is known; where there is none, that of the opening with a sentence."""
    solve = named("rotor.solve")
    opening = named("explorer.model.inputs.OPENING")
    fit = (lambda design: design) if hand is None else hand.fit
    try:
        sliders = inputs.design()
        solution = solve(fit(sliders))
    except ValueError as error:
        sliders, solution, problem = None, None, str(error)
    else:
        problem = "" if solution.converged else solution.message
    if problem:
        solution = solve(opening.design())
    view = named("explorer.model.inputs.ViewState")(units=units)
    baseline = solve(named("explorer.model.inputs.baseline_of")(solution.design))
    shown = opening if problem else inputs
    state = record.make(
        f"state {name}",
        "explorer.model.session_state.SessionState",
        shown, view, solution, baseline, None if pinned is None else pinned.solution, pinned,
    )  # fmt: skip
    now = named("explorer.views.page_state.PageState")(
        inputs, sliders, state, view=view, problem=problem
    )
    return now if hand is None else replace(now, hand=hand)


def keep_page(
    record: Record, name: str, now: Any, answers: Answers, without: Sequence[str] = (), **ui: Any
) -> None:
    """Keep what every panel that is seen shows before and after its questions are answered, and what presses do.

    `ui`: fields of `OpenPanels`, which decides what is seen.
    """
    now = replace(now, ui=named("explorer.views.page_state.OpenPanels")(**ui))
    record.ask(f"{name}/at first", parts_seen, now)
    now = record.make(f"{name}/answers", answers.settled, now, without)
    if now is None:
        return
    record.ask(f"{name}/settled", parts_seen, now)
    for panel in named("explorer.page.PANELS"):
        if not panel.seen(now.ui):
            continue
        effects = panel.reacts(now)
        if effects:
            record.keep(f"{name}/reacts", effects)
        for press, act in panel.presses.items():
            for number, value in enumerate(PRESSES.get(press, ())):
                record.ask(f"{name}/press {press} {number}", act, now, value)


def work_result(work: Any) -> Any:
    """What a work of the page's own thread returns, without a thread."""
    return named("explorer.workers.call.at_once")(work.run(lambda: None))


def parts_seen(now: Any) -> dict[str, Any]:
    """What the panels that are seen show, by the name of each part or text."""
    parts = dict[str, Any]()
    for panel in named("explorer.page.PANELS"):
        if panel.seen(now.ui):
            parts |= panel.view(now)
    return parts


def compare(record: Record, explored: Mapping[str, Any], answers: Answers) -> None:
    """A and B: another twist, another flight, another rotor; and the other units."""
    for b, a in (
        ("moved", "linear inflow"),
        ("linear twist", "hover"),
        ("bo105", "opening"),
        ("bending", "two segments"),
    ):
        solution = named("rotor.solve")(explored[a].design())
        pinned = record.make(
            f"pinned {a}", "explorer.model.session_state.Pinned", explored[a], solution
        )
        now = state_of(record, f"{b} beside {a}", explored[b], pinned=pinned)
        keep_page(record, f"{b} beside {a}", now, answers, (BAND, WATERFALL), drawer="details")
    for name in ("opening", "linear twist", "hover", "bo105", "r22", "xv15"):
        now = state_of(record, f"{name} in aviation units", explored[name], units="Aviation")
        keep_page(record, f"{name} in aviation units", now, answers, (BAND, WATERFALL))


def actuate(
    record: Record,
    name: str,
    fields: Mapping[str, Any],
    sliders: Mapping[str, Any],
    answers: Answers,
) -> None:
    """The page in Actuate with an actuator as the hand has set it, with the blade out of the rotor and in it."""
    hand = hand_of(record, name, fields)
    now = state_of(record, f"actuator {name}", inputs_of(record, f"actuator {name}", sliders), hand)
    without = (BAND, WATERFALL) if name in FORESEEN else (BAND, WATERFALL, SLOPES, DIAL, STROKE)
    for place, lifted in (("out", True), ("in", False)):
        keep_page(
            record,
            f"actuator {name}, {place}",
            now,
            answers,
            without,
            mode="actuate",
            lifted=lifted,
        )


def hand_of(record: Record, name: str, fields: Mapping[str, Any]) -> Any:
    """What the hand has set in Actuate."""
    actuator = record.make(
        f"actuator inputs {name}",
        "explorer.model.actuator_inputs.ActuatorInputs",
        **fields.get("actuator", {}),
    )
    rest = {key: value for key, value in fields.items() if key != "actuator"}
    return record.make(
        f"hand {name}",
        "explorer.model.actuator_inputs.HandSettings",
        actuator=actuator, by_hand=actuator, on_board=True, **rest,
    )  # fmt: skip


def follow(record: Record, explored: Mapping[str, Any]) -> None:
    """What a page without a browser is sent on a walk over the sliders, message by message."""
    texts = ("details.power", "details.trim", "details.waterfall", "trust.status", "trust.doubts", "switch.costs",
             "switch.bending", "actuator.per_rev")  # fmt: skip
    page = record.make(
        "walk", "tests.fake_bridge.PanelPage", *named("explorer.page.PANELS"), texts=texts
    )
    if page is None:
        return
    for step, name in enumerate(
        ("opening", "linear inflow", "moved", "hover", "beyond", "stalled", "bo105")
    ):
        now = state_of(record, f"walk {step}", explored[name])
        begin = len(page.bridge.sent), len(page.words)
        page.follow(
            replace(
                page.now,
                inputs=now.inputs,
                sliders=now.sliders,
                state=now.state,
                problem=now.problem,
            )
        )
        page.rest()
        for number, parts in enumerate(page.bridge.sent[begin[0] :]):
            record.keep(f"walk/{step} {name}/message {number}", dict(parts))
        for number, words in enumerate(page.words[begin[1] :]):
            record.keep(f"walk/{step} {name}/words {number}", words)
