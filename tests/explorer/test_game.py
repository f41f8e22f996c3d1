"""Beating the search by hand, from where the page was: a hand can tie; its link, and its scores."""

import itertools
import math
from dataclasses import replace
from typing import Any

import pytest

from explorer.model.inputs import LAWS, OPENING, TWISTS, Inputs, with_optimum
from explorer.model.sliders import SLIDERS, limits
from explorer.sharing.game import Game, game_from, game_of, same_but_twist
from rotor import Design, Limits, make_design, optimise, solve
from rotor.optimisation import CONCEPTS, Search, find_concept, nearest, run_search
from rotor.optimisation.objective import at_condition

PLAIN = replace(OPENING, inflow="drees", elements=20, azimuths=36)
"""Quick, where the physics does not matter."""
TIE = 50.0
"""[W]: the page says of powers so near that they are the same."""


def game_by(concept: str, inputs: Inputs) -> Game:
    search = Search(inputs.design(), CONCEPTS[concept], band=False)
    game = game_of(search, run_search(search).design, inputs)
    assert game is not None
    return game


def by_hand(game: Game, inputs: Inputs, begun: Design) -> float:
    """Least power [W] that a player reaches who moves the sliders from a blade, one to all at once, by ever fewer of
    their steps, and looks at power alone."""
    law = with_optimum(inputs, game.least).law
    names, solved = LAWS[law].inputs, solve(game.start).require()
    steps, powers = [SLIDERS[name].step for name in names], dict[tuple[float, ...], float]()

    def power(values: tuple[float, ...]) -> float:
        if values not in powers:
            tried = replace(inputs, law=law, **dict(zip(names, values, strict=True)))
            assert game.holds(tried)
            answer = solve(tried.design(), solved)
            powers[values] = answer.power.total if answer.converged else float("inf")
        return powers[values]

    placed = with_optimum(inputs, begun)
    at, stride = tuple(getattr(placed, name) for name in names), 32
    while stride >= 1:
        moves = itertools.product((0, stride, -stride), repeat=len(names))
        tries = [
            tuple(
                round(value + k * step, 4) for value, k, step in zip(at, move, steps, strict=True)
            )
            for move in moves
        ]
        held = [
            values
            for values in tries
            if all(within(*pair) for pair in zip(names, values, strict=True))
        ]
        best = min(held, key=power)
        at, stride = (best, stride) if power(best) < power(at) else (at, stride // 2)
    return power(at)


def nearest_of(name: str, start: Design) -> Design:
    """The nearest blade to the start that a concept makes: there the hand begins on the sliders of its law."""
    concept = find_concept(name)
    return concept.apply(start, nearest(concept, start.twist))


def within(name: str, value: float) -> bool:
    low, high = limits(name)
    return low <= value <= high


@pytest.mark.parametrize(
    ("concept", "inputs"),
    [
        ("linear", PLAIN),
        ("quadratic", PLAIN),
        pytest.param("two-segment-free", OPENING, marks=pytest.mark.slow),
    ],
)
def test_a_hand_on_the_sliders_of_the_law_ties_with_the_search(concept: str, inputs: Inputs):
    game = game_by(concept, inputs)
    begun = nearest_of(concept, game.start)
    least = solve(game.least).require().power.total
    assert solve(begun).require().power.total > least + 4.0 * TIE
    assert abs(by_hand(game, inputs, begun) - least) < TIE


def test_the_sliders_of_a_law_reach_as_far_as_its_search():
    for law in LAWS.values():
        for name, parameter in zip(law.inputs, law.parameters, strict=True):
            form = TWISTS[name].slider
            assert form is not None
            assert (form.low, form.high) == pytest.approx(
                (parameter.shown(parameter.low), parameter.shown(parameter.high))
            )


def test_the_hand_begins_where_the_page_was():
    for inputs in (PLAIN, replace(PLAIN, built_inner=-2.0, built_division=0.6)):
        design = inputs.design()
        found = replace(design, twist=make_design(twist="linear:-7.52").twist)
        game = game_of(Search(design, CONCEPTS["linear"]), found, inputs)
        assert game is not None
        assert game.start == design
        assert with_optimum(inputs, game.start) == inputs
        assert game.holds(inputs)
        assert with_optimum(inputs, game.least).linear == -7.5


def test_where_no_slider_holds_the_page_s_twist_the_hand_begins_at_the_nearest():
    points = make_design(twist="points:8,5,-1,-6@0.2,0.5,0.8,1").twist
    inputs = replace(PLAIN, law="given", given=points)
    design = inputs.design()
    game = game_of(
        Search(design, CONCEPTS["linear"]),
        replace(design, twist=make_design(twist="linear:-7.5").twist),
        inputs,
    )
    assert game is not None
    (begun,) = nearest(CONCEPTS["linear"], design.twist)
    assert with_optimum(inputs, game.start).linear == pytest.approx(math.degrees(begun), abs=0.05)


def test_no_game_where_the_sliders_cannot_do_what_the_search_did():
    design = PLAIN.design()
    found = replace(design, twist=make_design(twist="linear:-7.5").twist)
    assert game_of(Search(design, CONCEPTS["linear"]), found, PLAIN)
    for search in (
        Search(design, find_concept("two-segment", [0.5])),  # A hand moves the break, too.
        Search(design, CONCEPTS["free-form"]),
        Search(design, CONCEPTS["linear"], at_condition(design, "induced")),
        Search(design, CONCEPTS["linear"], limits=Limits(stalled=0.05)),
    ):
        assert game_of(search, found, PLAIN) is None


@pytest.fixture
def game() -> Game:
    start, least, score = (
        replace(PLAIN.design(), twist=make_design(twist=spec).twist) for spec in SPECS
    )
    return Game(start, least, score)


SPECS = ("linear:-16", "linear:-7.5", "linear:-9")


def test_a_link_opens_the_same_game(game: Game):
    for sent in (game, replace(game, score=None)):
        got = game_from(sent.code())
        powers = [
            [solve(one).require().power.total for one in designs(each)] for each in (sent, got)
        ]
        assert powers[0] == pytest.approx(powers[1], rel=1e-9)
        assert got.holds(with_optimum(PLAIN, got.start))


def designs(game: Game) -> list[Design]:
    return [one for one in (game.start, game.least, game.score) if one is not None]


def test_a_try_has_the_flight_of_the_game_and_a_twist_of_sliders(game: Game):
    tried = replace(PLAIN, law="linear", linear=-3.0)
    for other in ({}, {"law": "builtin", "built_outer": 1.0}, {"law": "two"}):
        assert game.holds(replace(tried, **other))
    for other in (
        {"law": "given", "given": game.start.twist},
        {"mass_t": 9.0},
        {"advance_ratio": 0.3},
        {"inflow": "uniform"},
    ):
        assert not game.holds(replace(tried, **other))


def test_a_text_that_is_no_game_is_refused(game: Game):
    start, least, score = game.code().split("|")
    other = start.replace("drees", "coleman")
    assert other != start
    for wrong in (start, "|".join((start, least, score, score)), f"{other}|{least}", "2;x|1;y"):
        with pytest.raises(ValueError, match=r"(a new link|the design file)\.$"):
            game_from(wrong)


def test_the_same_flight_and_models_and_no_other():
    start, optimum = (make_design(mu=0.2, twist=twist) for twist in ("linear:-4", "linear:-11"))
    assert same_but_twist(optimum, start)
    others: list[dict[str, Any]] = [
        {"mu": 0.21},
        {"mass_kg": 9000.0},
        {"inflow": "drees"},
        {"rotor": "r22"},
    ]
    for other in others:
        asked: dict[str, Any] = {"mu": 0.2, "twist": "linear:-4", **other}
        assert not same_but_twist(optimum, make_design(**asked))


def test_an_optimum_that_came_by_a_link_has_the_same_power():
    """Ten digits of each parameter stand in a link."""
    optimum = optimise(PLAIN.design(), "linear", starts=1).design
    game = Game(PLAIN.design(), optimum)
    got = game_from(game.code()).least
    assert solve(got).require().power.total == pytest.approx(
        solve(optimum).require().power.total, rel=1e-9
    )
