"""What the panels are functions of, and what a panel is."""

from collections.abc import Callable, Generator, Hashable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

from explorer.charts.measured import FlownPowers, MeasuredChart
from explorer.charts.plots import PowerCurve, Range
from explorer.model.actuator_inputs import HandSettings
from explorer.model.inputs import Inputs, ViewState, with_optimum
from explorer.model.session_state import Analyses, Mode, Order, Pinned, Pins, SessionState
from explorer.model.undo import KeptDesign
from explorer.model.units import SI, Units, units_of
from explorer.parts.frame import NoticePart
from explorer.parts.results import LeastPower
from explorer.sharing.game import Standing
from explorer.workers.call import Call
from rotor import Design, Solution

T = TypeVar("T")


@dataclass(frozen=True)
class OpenPanels:
    """What of the page is open.

    `lifted`: the blade with its actuator is out of the rotor. `disk`: the view of the disk is shown. `riding`: the view
    goes with a blade section.
    """

    mode: Mode = "explore"
    drawer: str = ""
    lifted: bool = False
    disk: bool = False
    riding: bool = False


@dataclass(frozen=True)
class HeldStation:
    """The station of the blade that is in the hand, and its twist of least power with that power in W, once known.

    `before`: the answer when it was taken.
    """

    place: str
    best: LeastPower | None
    before: Solution | None = None


@dataclass(frozen=True, eq=False)
class PanelMemory:
    """What is remembered from one update to the next."""

    ranges: Mapping[str, Range] = field(default_factory=dict[str, Range])
    """Axes of charts, which hold as long as they serve."""
    latest: Mapping[str, Any] = field(default_factory=dict[str, Any])
    """The last result of the page's own work, by its name: it stands until that of the present design is known."""

    def then(self, state: SessionState, last: SessionState | None) -> "PanelMemory":
        """After a converged state and the `last` before it: what is known of one rotor says nothing of another."""
        same = last is not None and last.inputs.aircraft == state.inputs.aircraft
        return self if same else replace(self, latest={})


@dataclass(frozen=True, eq=False)
class PageState:
    """All that a panel may show at one instant."""

    inputs: Inputs
    sliders: Design | None
    """The design that the inputs mean, without the actuator's twist; None where they mean none."""
    state: SessionState | None
    """The last converged one; None before the first."""
    view: ViewState = field(default_factory=ViewState)
    preview: Design | None = None
    """That of a search which is shown in place of the sliders."""
    problem: str = ""
    """Why the present inputs have no solution, in one sentence; empty where they have one."""
    ui: OpenPanels = OpenPanels()
    pins: Pins = field(default_factory=Pins)
    kept: tuple[KeptDesign, ...] = ()
    """The bookmarks, oldest first."""
    steps: tuple[bool, bool] = (False, False)
    """Whether there is a step to undo, and one to redo."""
    hand: HandSettings = field(default_factory=HandSettings)
    station: HeldStation | None = None
    change: float | None = None
    """Power less that before the grab [W]; None while nothing was moved."""
    game: Standing | None = None
    """Where the hand is measured against what a search found."""
    searching: NoticePart | None = None
    """The bar over the scene while a search is shown in place of the sliders."""
    curve: PowerCurve | None = None
    """Power over µ; None before the first."""
    measured: MeasuredChart = field(default_factory=MeasuredChart)
    flown: FlownPowers = field(default_factory=FlownPowers)
    analyses: Analyses = field(default_factory=Analyses)
    memory: PanelMemory = field(default_factory=PanelMemory)
    answers: Mapping[Hashable, Any] = field(default_factory=dict[Hashable, Any])
    """What is known: of worker processes by `Call`, of the page's own work by the key of `PanelWork`. For a question
    that failed, the sentence that says why."""
    _derived: dict[Any, Any] = field(default_factory=dict[Any, Any], init=False, repr=False)

    def of(self, derive: Callable[["PageState"], T]) -> T:
        """What `derive` makes of this, worked out once for all panels."""
        if derive not in self._derived:
            self._derived[derive] = derive(self)
        return self._derived[derive]

    @property
    def shown(self) -> Inputs:
        """What the sliders show: the inputs, or in their place a design that a search previews."""
        if self.preview is None:
            return self.inputs
        return replace(
            with_optimum(self.inputs, self.preview),
            advance_ratio=self.preview.condition.advance_ratio,
        )

    @property
    def units(self) -> Units:
        return (
            SI
            if self.state is None
            else units_of(self.state.view.units, self.state.solution.design.aircraft)
        )

    def latest(self, work: "PanelWork") -> tuple[Any, bool]:
        """The result of work, and True; until it is known the last of its name, or None, and False."""
        known = self.answers.get(work.key)
        return (self.memory.latest.get(work.name), False) if known is None else (known, True)


@dataclass(frozen=True)
class Questions:
    """Questions of a panel to the worker processes, the first one first."""

    urgency: int
    """As in `Processes.begin`."""
    calls: tuple[Call, ...]
    delay: float
    """How long nothing must have moved before they are worked on [s]."""


Tell = Callable[[], None]
"""Says, before work is done, that there is more to show."""


@dataclass(frozen=True, eq=False)
class PanelWork:
    """What a panel wants computed by the page's own thread, once the page rests."""

    name: str
    about: tuple[Hashable, ...]
    """All that the result depends on."""
    run: Callable[[Tell], Generator[None, None, Any]]
    """Yields before each trim, where it gives way to edits and to other pages, and returns the result."""
    soon: bool = False
    """Whether it comes as soon as nothing moves; else after the sweep of power over µ."""

    @property
    def key(self) -> Hashable:
        """Key of the result in `PageState.answers`."""
        return self.name, *self.about


def as_one_step(compute: Callable[[], Any]) -> Callable[[Tell], Generator[None, None, Any]]:
    """`PanelWork.run` of a computation that is done in one step."""

    def run(tell: Tell) -> Generator[None, None, Any]:
        yield
        return compute()

    return run


@dataclass(frozen=True)
class MoveSliders:
    """Move the sliders, as a hand does or otherwise: undo, link, file, optimum, lecture."""

    inputs: Inputs
    by_hand: bool = True


@dataclass(frozen=True)
class SetGrabbed:
    """Something was taken by the hand, or let go: what moves in between is one step of undo."""

    held: bool


@dataclass(frozen=True)
class SetHand:
    """Of what the hand has set beside the inputs, these fields of `HandSettings`, and as widgets these of
    `ActuatorInputs`.

    Others may move meanwhile.
    """

    changes: Mapping[str, Any] = field(default_factory=dict[str, Any])
    actuator: Mapping[str, Any] = field(default_factory=dict[str, Any])


@dataclass(frozen=True)
class SetAddress:
    """Write a value into the address of the page; None removes it."""

    name: str
    value: str | None


@dataclass(frozen=True)
class PinOrder:
    """What becomes of A in the next update."""

    order: Order


@dataclass(frozen=True)
class PinDesign:
    """Make this design A, whatever is on the sliders."""

    design: Pinned


Effect = MoveSliders | SetGrabbed | SetHand | SetAddress | PinOrder | PinDesign
Press = Callable[[PageState, Any], tuple[Effect, ...]]
"""What a press does, from what is known now and the value that came with it."""


@dataclass(frozen=True)
class Panel:
    """A panel of the page, or what belongs together of it."""

    view: Callable[[PageState], Mapping[str, Any]]
    """What stands where: parts of the frame by their names in `Parts`, and texts by the names of their widgets."""
    seen: Callable[[OpenPanels], bool] = lambda ui: True
    """Where it is not, nothing is asked, worked out, viewed or pressed, and its parts are absent from the frame."""
    asks: Callable[[PageState], tuple[Questions, ...]] = lambda now: ()
    works: Callable[[PageState], Sequence[PanelWork]] = lambda now: ()
    turns: bool = False
    """Whether it follows the azimuth of the reference blade."""
    remember: Callable[[PageState, Mapping[str, Any]], PanelMemory] = lambda now, shown: now.memory
    """What is remembered of what it showed."""
    reacts: Callable[[PageState], tuple[Effect, ...]] = lambda now: ()
    """What a new answer moves, without a press."""
    presses: Mapping[str, Press] = field(default_factory=dict[str, Press])
    """By name in `presses.PRESSES`. Where the panel is not seen, they only let go."""
    keys: tuple[str, ...] = ()
    """Presses that a command of the keyboard with the same name does too."""
