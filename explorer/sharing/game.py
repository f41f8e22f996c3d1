"""A game: by hand to the power that a search found, from where the page was. Values only."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from explorer.model.inputs import LAWS, NOT_ALWAYS, Inputs, inputs_of, with_optimum
from explorer.model.sliders import on_steps
from explorer.sharing.share import clipped, code_of, design_from
from rotor import Design, Solution
from rotor.optimisation import Search, at_condition, nearest

_BETWEEN = "|"
"""Between the designs of a game as text."""


@dataclass(frozen=True)
class Game:
    """Powers are not kept: who opens the link of a game solves its designs again."""

    start: Design
    """The page's design as the search began; the nearest of the search's twist law where no slider holds its twist."""
    least: Design
    """What the search found, at the nearest places of the sliders."""
    score: Design | None = None
    """What somebody reached; None: nobody yet."""

    def holds(self, inputs: Inputs) -> bool:
        """Whether these inputs are a try: the same flight, models and rotor, and a twist that sliders hold."""
        by_hand = inputs.law not in NOT_ALWAYS
        return by_hand and same_but_twist(self.least, inputs.design())

    def code(self) -> str:
        """As text for an address; ValueError where no address holds the rotor."""
        designs = (
            (self.start, self.least) if self.score is None else (self.start, self.least, self.score)
        )
        return _BETWEEN.join(code_of(design) for design in designs)


def game_from(code: str) -> Game:
    """The game of a text; ValueError with one sentence for one that is none."""
    designs = [design_from(part) for part in code.split(_BETWEEN)]
    if not 2 <= len(designs) <= 3:
        raise ValueError(
            f"The game in the address, {clipped(code)!r}, has {len(designs)} designs: ask for a new link."
        )
    game = Game(*designs)
    if any(not same_but_twist(game.least, design) for design in designs) or not any(
        _laws(game.least)
    ):
        raise ValueError(
            "The game in the address mixes flights, rotors or models: ask for a new link."
        )
    return game


def game_of(search: Search, found: Design, inputs: Inputs) -> Game | None:
    """The game that a search makes; None where the sliders cannot do what it did: its concept is no law on them, it
    had limits, or total power in the present flight was not what it made least."""
    design, concept = search.design, search.concept
    alone = search.limits == type(search.limits)() and search.objective in (
        None,
        at_condition(design, "total"),
    )
    if not alone or not concept.page or not same_but_twist(found, design):
        return None
    least = _on_sliders(found, inputs)
    start = design
    if inputs_of(design).law in NOT_ALWAYS:
        start = _on_sliders(concept.apply(design, nearest(concept, design.twist)), inputs)
    return None if start == least else Game(start, least)


def _on_sliders(design: Design, inputs: Inputs) -> Design:
    """The design with the twist at the nearest places of the sliders."""
    return replace(design, twist=on_steps(with_optimum(inputs, design)).design().twist)


def _laws(design: Design) -> Iterator[str]:
    return (name for name, law in LAWS.items() if name != "builtin" and law.values_of(design.twist))


def same_but_twist(one: Design, other: Design) -> bool:
    """Whether the two differ in nothing but the jig twist."""
    return replace(other, twist=one.twist) == one


@dataclass(frozen=True, eq=False)
class Standing:
    """A game in the present flight."""

    game: Game
    least: Solution
    start: Solution
    to_beat: Solution | None
    """The trim of the score."""
    best: Solution
    """The least power that the hand has reached; the start at first."""
