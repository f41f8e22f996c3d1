"""The C81 reader and writer: abutting fields, continuation cards, blocks of their own shape, clear errors."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor.airfoil.c81 import C81Block, C81Deck, format_c81, parse_c81, read_c81
from rotor.support.assets import asset_path

# Written by hand to the card layout: fields touch, `split()` would see one word where there are two.
TOUCHING = (
    "HAND DECK                      2 2 2 2 2 2\n"
    "         0.300  0.400\n"
    "-180.00-0.3880-0.3880\n"
    " 180.00-0.3880-0.3880\n"
    "         0.300  0.500\n"
    "-180.000.012340.01235\n"
    " 180.000.012340.01235\n"
    "         0.000  1.000\n"
    " -90.00-0.1000 0.1000\n"
    "  90.00 0.1000-0.1000\n"
)


def small_deck(machs: int, angles: int) -> C81Deck:
    rng = np.random.default_rng(1)

    def block(m: int, a: int, low: float) -> C81Block:
        values = np.round(rng.uniform(low, 2.0, (a, m)), 4)
        return C81Block(
            np.round(np.linspace(0.0, 0.9, m), 3),
            np.round(np.linspace(-180.0, 180.0, a), 2),
            values,
        )

    return C81Deck(
        "RANDOM", block(machs, angles, -2.0), block(machs + 1, angles + 2, 0.01), block(2, 3, -1.0)
    )


def test_fields_that_touch_are_cut_by_column() -> None:
    deck = parse_c81(TOUCHING)
    assert_allclose(deck.cl.values, [[-0.388, -0.388], [-0.388, -0.388]], rtol=0, atol=0)
    assert_allclose(deck.cd.values, [[0.01234, 0.01235], [0.01234, 0.01235]], rtol=0, atol=0)
    assert_allclose(deck.cd.mach, [0.3, 0.5], rtol=0, atol=0)
    assert_allclose(deck.blocks[2].alpha_deg, [-90.0, 90.0], rtol=0, atol=0)


@pytest.mark.parametrize("machs", [2, 8, 9, 10, 18, 19, 30])
def test_round_trip_is_exact_with_continuation_cards(machs: int) -> None:
    deck = small_deck(machs, 7)
    back = parse_c81(format_c81(deck))
    for one, two in zip(deck.blocks, back.blocks, strict=True):
        assert_allclose(two.mach, one.mach, rtol=0, atol=0)
        assert_allclose(two.alpha_deg, one.alpha_deg, rtol=0, atol=0)
        assert_allclose(two.values, one.values, rtol=0, atol=0)


@pytest.mark.parametrize("name", ["sc1095", "sc1094r8"])
def test_bundled_deck_is_written_back_byte_by_byte(name: str) -> None:
    path = asset_path(f"airfoils/{name}.c81")
    deck = read_c81(path)
    assert format_c81(deck) == path.read_text(encoding="utf-8")
    assert deck.cl.alpha_deg.size <= 99, "the classic header has two digits"
    assert np.all(deck.cd.values > 0.0)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            ("-0.3880-0.3880\n 180.00", "-0.38x0-0.3880\n 180.00"),
            "line 3: '-0.38x0' is not a number",
        ),
        ((" 180.000.01234", "-180.000.02234"), "line 7: -180 deg again, unlike line 6: keep one"),
        (("0.01234", "-.01234"), "line 6: a cd at -180 deg is not positive"),
        (("  0.300  0.400", "  0.400  0.300"), "line 2: the Mach numbers of cl do not increase"),
        (("-0.3880-0.3880\n", "-0.3880-0.3880 0.1000\n"), "line 3: more than 2 values"),
        (
            (" 2 2 2 2 2 2", " 2 2 2 2 2 3"),
            "ends after line 10, at angle 3 of 3 of cm: check the counts in line 1",
        ),
        (
            ("  90.00 0.1000-0.1000\n", "  90.00 0.1000-0.1000\n 120.00 0.1\n"),
            "line 11: numbers after the last card",
        ),
    ],
)
def test_a_damaged_deck_is_refused_in_one_sentence(change: tuple[str, str], words: str) -> None:
    with pytest.raises(ValueError, match="deck") as caught:
        parse_c81(TOUCHING.replace(*change))
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_value_too_large_for_its_field_is_refused() -> None:
    block = C81Block(np.array([0.0, 1.0]), np.array([0.0, 1.0]), np.full((2, 2), 1e9))
    with pytest.raises(ValueError, match="seven characters"):
        format_c81(C81Deck("X", block, block, block))
