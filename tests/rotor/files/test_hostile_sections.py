"""Every polar and deck a user can bring is flown or refused in one sentence."""

import random
import re
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from test_rotor_file import DECK, GOOD, POLARS, polar_file

from explorer.widgets.design_files import UploadedFiles
from rotor import Aircraft, make_design, solve
from rotor.airfoil.c81 import format_c81, parse_c81
from rotor.airfoil.polars import COLUMNS, Polar, parse_polars
from rotor.files import rotor_file
from rotor.files.rotor_file import load_rotor, read_aircraft, read_tables

POLAR = POLARS[2]


def with_section(line: str, **files: str) -> Aircraft:
    text = (
        GOOD.replace('"naca0012"', '"mine"', 1)
        + f'\n[sections.mine]\n{line}\noutline = "naca0012"\n'
    )
    return read_aircraft("my.toml", {"my.toml": text, **files})


def with_polar(text: str) -> Aircraft:
    return with_section('polars = "a.txt"', **{"a.txt": text})


def with_deck(text: str) -> Aircraft:
    return with_section('deck = "a.c81"', **{"a.c81": text})


def changed(**values: object) -> str:
    """The polar with other values, as XFOIL writes it."""
    fields = {
        name: getattr(POLAR, name) for name in ("mach", "reynolds", "alpha_deg", "cl", "cd", "cm")
    }
    return polar_file(Polar(**{**fields, **values}))


def test_a_polar_at_mach_0_flies_as_one_at_low_mach():
    """XFOIL writes Mach 0.000 unless it is told otherwise. Prandtl–Glauert lift at Mach 0.3 is 4.8 % above it."""
    zero, low = (with_polar(changed(mach=mach)) for mach in (0.0, 0.3))
    assert any("incompressible" in remark for remark in zero.remarks)
    powers = [
        solve(make_design(rotor=craft, mu=mu)).power.total
        for craft in (zero, low)
        for mu in (0.0, 0.2)
    ]
    assert_allclose(powers[:2], powers[2:], rtol=0.03)
    table = zero.rotor.blade.installed("mine").table
    assert_allclose(
        table.lift_slope(0.3) / table.lift_slope(0.0), 1.0 / np.sqrt(1.0 - 0.3**2), rtol=0.01
    )


@pytest.mark.parametrize("mach", [1e-6, 0.001, 0.05, 0.06, 0.1])
def test_friction_stays_positive_at_any_low_mach(mach: float):
    table = with_polar(changed(mach=mach)).rotor.blade.installed("mine").table
    assert np.all(table(np.zeros(20), np.linspace(0.0, 0.7, 20)).cd > 0.4 * POLAR.cd.min())


@pytest.mark.parametrize(
    "lift",
    [np.zeros_like(POLAR.cl), np.full_like(POLAR.cl, 0.5), -POLAR.cl, POLAR.cl + 3.0],
    ids=range(4),
)
def test_lift_that_does_not_rise_through_zero_is_refused(lift: np.ndarray):
    with pytest.raises(ValueError, match=r"lift|cl stays") as refusal:
        with_polar(changed(cl=lift))
    assert len(str(refusal.value)) < 300


def test_a_deck_without_lift_is_refused():
    deck = parse_c81(DECK)
    flat = replace(deck, title="FLAT", cl=replace(deck.cl, values=np.zeros_like(deck.cl.values)))
    with pytest.raises(ValueError, match="lift does not rise through zero"):
        with_deck(format_c81(flat))


@pytest.mark.parametrize("suffix", ["polar", "csv", "deck"])
def test_one_wrong_digit_is_flown_or_refused(suffix: str):
    """Any digit becomes any other character of a number: a sentence, or a section that trims or says why not."""
    random.seed(suffix)
    text = {
        "polar": polar_file(POLAR),
        "csv": "mach,reynolds,alpha_deg,cl,cd,cm\n"
        + "\n".join(
            f"0.3,3e6,{a:g},{cl:.4f},{cd:.5f},{cm:.4f}"
            for a, cl, cd, cm in zip(POLAR.alpha_deg, POLAR.cl, POLAR.cd, POLAR.cm, strict=True)
        ),
        "deck": DECK,
    }[suffix]
    places = [match.start() for match in re.finditer(r"\d", text)]
    flown, sentences = 0, list[str]()
    for _ in range(12):
        at = random.choice(places)
        wrong = text[:at] + random.choice("0123456789-. ") + text[at + 1 :]
        try:
            craft = with_deck(wrong) if suffix == "deck" else with_polar(wrong)
        except ValueError as refusal:
            sentences.append(str(refusal))
            continue
        for mu in (0.0, 0.2):
            solution = solve(make_design(rotor=craft, mu=mu))
            assert solution.message
            assert not solution.converged or np.isfinite(solution.power.total)
        flown += 1
    assert flown >= 3
    assert all(0 < len(sentence) < 400 for sentence in sentences)


@pytest.mark.parametrize(
    ("heading", "says"),
    [
        ("Mach = 0.1.2", "correct the number"),
        ("Mach =   1.300", "outside 0…1"),
        ("Mach = .", "correct the number"),
    ],
)
def test_a_heading_with_a_wrong_digit_is_refused(heading: str, says: str):
    text = re.sub(r"Mach =\s+[0-9.]+", heading, polar_file(POLAR))
    with pytest.raises(ValueError, match=says):
        parse_polars(text, "a.txt")


def test_only_sections_in_use_are_built(monkeypatch: pytest.MonkeyPatch):
    """2000 sections beside the one in use took over a minute: each is a deck from polars on the grid."""
    built = list[str]()
    read = rotor_file.read_section
    monkeypatch.setattr(
        rotor_file,
        "read_section",
        lambda table, name, *rest: built.append(name) or read(table, name, *rest),
    )
    text = GOOD.replace('"naca0012"', '"s0"', 1) + "".join(
        f'[sections.s{k}]\npolars = "a.txt"\n' for k in range(2000)
    )
    craft = read_aircraft("my.toml", {"my.toml": text, "a.txt": polar_file(POLAR)})
    assert built == ["s0"]
    assert "Section s1 and 1998 more is left out: no span of the blade uses it." in craft.remarks
    assert read_tables("my.toml", text.replace("a.txt", "b.txt", 1)).named == ["b.txt"]


def test_the_number_of_sections_and_files_is_bounded():
    own = "".join(f'[sections.s{k}]\npolars = "a.txt"\n' for k in range(13))
    spans = ", ".join(
        f'{{ start_r = {0.2 + 0.06 * k:.2f}, end_r = {0.26 + 0.06 * k:.2f}, section = "s{k}" }}'
        for k in range(13)
    )
    text = GOOD.replace('section = "naca0012"', f"spans = [{spans}]", 1) + own
    with pytest.raises(ValueError, match="uses 13 sections of its own: 12 are allowed"):
        read_aircraft("my.toml", {"my.toml": text, "a.txt": polar_file(POLAR)})
    files = ", ".join(f'"{k}.txt"' for k in range(41))
    with pytest.raises(ValueError, match="name 41 files: 40 are allowed"):
        read_tables(
            "my.toml", GOOD.replace('"naca0012"', '"s"', 1) + f"[sections.s]\npolars = [{files}]\n"
        )


LONG = 15_000
HEAD = "\n alpha cl cd\n ---- ----\n 1 2 3"
WORK = {
    "dotted names": ("a.toml", "\n".join(".".join(["a"] * 8000) + " = 1" for _ in range(11))),
    "a header that never ends": (
        "a.toml",
        f'x = """\n[{" " * LONG}x\n"""\n' + GOOD.replace("= 5.0", "= 5000.0", 1),
    ),
    "dashes": ("a.txt", "\n" + "-" * 1_900_000 + "x"),
    "blanks in a number": ("a.txt", f"Mach = 0.1 Re = 1e{' ' * 1_900_000}x{HEAD}"),
    "Mach numbers": (
        "a.csv",
        f"{COLUMNS}\n" + "".join(f"{k * 1e-6:g},1e6,{k % 20},0.1,0.01,0\n" for k in range(60_000)),
    ),
    "points": ("a.dat", "\n".join(f"{k / 9e4:.5f} 0.0" for k in range(120_000))),
    "keys": ("a.toml", GOOD + "".join(f"x{k} = 1\n" for k in range(18_000))),
    "a long file": ("a.toml", GOOD + "#" * 200_000),
}
"""What a file may hold that took seconds to hours, or held the interpreter, and is none that can be used."""


@pytest.mark.parametrize("kind", WORK)
def test_no_upload_holds_the_interpreter(kind: str):
    """Another thread waits 0.2 s at most for its turn, of which a page would see a still picture."""
    name, text = WORK[kind]
    longest = 0.0
    for _ in range(3):  # A busy machine may keep any thread waiting, but not every time.
        longest, took = longest_wait(name, text)
        assert took < 3.0
        if longest < 0.2:
            return
    raise AssertionError(f"{longest:.2f} s")


def longest_wait(name: str, text: str) -> tuple[float, float]:
    """How long another thread waits for the interpreter [s] while a file is refused, and its processor time [s]."""
    before, longest, done = sys.getswitchinterval(), 0.0, threading.Event()

    def watch() -> None:
        nonlocal longest
        last = time.perf_counter()
        while not done.wait(0.002):
            now = time.perf_counter()
            longest, last = max(longest, now - last), now

    shelf, key = (
        UploadedFiles(),
        {".txt": "polars", ".csv": "polars", ".dat": "outline"}.get(name[-4:]),
    )
    if key:
        names = f'{key} = "{name}"' if key == "polars" else f'polars = "p"\noutline = "{name}"'
        shelf.add("p", polar_file(POLAR).encode())
        shelf.add(
            "my.toml", f"{GOOD.replace('naca0012', 'mine')}\n[sections.mine]\n{names}\n".encode()
        )
    sys.setswitchinterval(1e-3)  # As the server does.
    watcher, begin = threading.Thread(target=watch), time.process_time()
    watcher.start()
    try:
        with pytest.raises(ValueError, match=re.escape(name)) as refusal:
            shelf.add(name, text.encode())
    finally:
        done.set()
        watcher.join()
        sys.setswitchinterval(before)
    assert len(str(refusal.value)) < 300
    return longest, time.process_time() - begin


OUTSIDE = GOOD.replace('"naca0012"', '"mine"', 1) + '[sections.mine]\ndeck = "NAME"\n'


@pytest.mark.parametrize("name", ["../mine.c81", "ABSOLUTE", "link.c81", "sub/../../mine.c81"])
def test_names_stay_inside_the_folder(name: str, tmp_path: Path):
    """A rotor file may come from others; what it names is carried into saved designs and exports."""
    folder = tmp_path / "rotor"
    (folder / "sub").mkdir(parents=True)
    (tmp_path / "mine.c81").write_text(DECK, encoding="utf-8")
    (folder / "link.c81").symlink_to(tmp_path / "mine.c81")
    named = str(tmp_path / "mine.c81") if name == "ABSOLUTE" else name
    (folder / "my.toml").write_text(OUTSIDE.replace("NAME", named), encoding="utf-8")
    with pytest.raises(
        ValueError, match=r"outside its folder: copy it there, or give --allow-outside"
    ):
        load_rotor(folder / "my.toml")
    assert (
        load_rotor(folder / "my.toml", allow_outside=True).rotor.blade.own_sections[0].name
        == "mine"
    )


def test_no_line_of_a_foreign_file_is_quoted(tmp_path: Path, refused: Callable[..., str]):
    """On the command line too, where `--allow-outside` is for those who want it."""
    secret = tmp_path / "secret"
    secret.write_text("root:x:0:0:very secret\n", encoding="utf-8")
    (tmp_path / "own").mkdir()
    path = tmp_path / "own" / "my.toml"
    path.write_text(OUTSIDE.replace("NAME", str(secret)), encoding="utf-8")
    said = refused("solve", "--rotor", str(path))
    assert "outside its folder" in said
    assert "very secret" not in said
    assert "outside its folder" not in refused("solve", "--rotor", str(path), "--allow-outside")
