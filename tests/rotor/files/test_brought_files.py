"""Files as other programs and people write them: own outlines, polars and decks in each form, with what they give."""

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from test_rotor_file import GOOD, POLARS, polar_file, read

from explorer.widgets.design_files import UploadedFiles
from rotor import Aircraft, make_design, solve
from rotor.airfoil.c81 import C81Block, C81Deck, format_c81, parse_c81
from rotor.airfoil.contour import (
    Contour,
    load_contour,
    parse_contour,
    resample,
    thickness_and_camber,
)
from rotor.airfoil.polars import Polar, parse_polars
from rotor.airfoil.sections import load_section
from rotor.design.aircraft import SEA_LEVEL_DENSITY
from rotor.support.user_input import read_text

POINTS = resample(load_contour("naca2412"), 41).points
UPPER, LOWER = POINTS[:21], POINTS[20:]


def rows(points: np.ndarray, form: str = "{:9.6f} {:9.6f}") -> str:
    return "\n".join(form.format(*point) for point in points) + "\n"


LEDNICER = f"{rows(UPPER[::-1])}\n{rows(LOWER)}"
OUTLINES = {
    "clockwise": rows(POINTS[::-1]),
    "from the nose over the upper side": rows(np.concatenate((UPPER[::-1], LOWER[::-1]))),
    "from the nose over the lower side": rows(np.concatenate((LOWER, UPPER))),
    "from the middle": rows(np.roll(POINTS, 9, axis=0)),
    "closed": rows(POINTS) + rows(POINTS[:1]),
    "closed by 0 0": rows(POINTS) + "0 0\n",
    "nose twice": rows(UPPER) + rows(LOWER),
    "first point twice": rows(POINTS[:1]) + rows(POINTS),
    "middle of the trailing edge": rows(np.array([[1.0, 0.0], *POINTS, [1.0, 0.0]])),
    "Lednicer with counts": f"NACA 2412\n 21. 21.\n\n{LEDNICER}",
    "Lednicer in per cent": f"21 21\n{rows(100.0 * UPPER[::-1])}{rows(100.0 * LOWER)}",
    "both sides headed": f"Upper\n{rows(UPPER)}Lower\n{rows(LOWER[::-1])}",
    "credit": f"NACA 2412\n{rows(POINTS)}\nDrawn in 1998, with 41 points\nMoment(cm0): -0,05\n",
    "two headings": f"NACA 2412\nof 4 digits, 12 %\n{rows(POINTS)}",
    "heading of two numbers": f"2412 12\n{rows(POINTS)}",
    "commas": rows(POINTS, "{:.6f}, {:.6f}"),
    "decimal commas": rows(POINTS, "{:.6f};{:.6f}").replace(".", ","),
    "millimetres": rows(350.0 * POINTS),
    "metres": rows(0.35 * POINTS),
    "about the pitch axis": rows(POINTS - [0.3, 0.0]),
    "nose aft, in inches": rows((POINTS - [1.0, 0.0]) * [-12.0, 12.0]),
    "points in space": rows(np.insert(POINTS, 2, 0.4, axis=1), "{:.6f} {:.6f} {:.6f}"),
    "points in space, y along the span": rows(
        np.insert(POINTS, 1, 0.0, axis=1), "{:.6f} {:.6f} {:.6f}"
    ),
    "minus signs of print, Fortran": rows(POINTS, "{:.6E} {:.6E}")
    .replace("-", "−")
    .replace("E", "D"),
}


@pytest.mark.parametrize("kind", OUTLINES)
def test_an_outline_in_any_order_is_the_same(kind: str):
    """NACA 2412: 12 % thick, 2 % camber; upper trailing edge first, as all that draws and measures takes it."""
    contour = parse_contour(OUTLINES[kind], "a.dat")
    # Divided by the width in x, which is 1.0002 chords.
    assert_allclose(contour.points, POINTS, atol=3e-4)
    assert_allclose(
        thickness_and_camber(contour)[0::2],
        thickness_and_camber(Contour("", POINTS))[0::2],
        atol=1e-4,
    )


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (
            rows(POINTS[np.argsort(POINTS[:, 0])]),
            "does not go around a section exactly once: list the points",
        ),
        (
            rows(POINTS).replace(rows(POINTS[9:10]), "0.5 0.4\n"),
            "line 10: the outline jumps to this point and back",
        ),
        (
            rows(POINTS).replace(rows(POINTS[9:10]), "9.5 0.0\n"),
            "line 10: the outline jumps to this point: correct it",
        ),
        (
            rows(POINTS).replace(rows(POINTS[9:10]), "thick here\n"),
            "line 10: text interrupts the points of one side",
        ),
        (
            rows(resample(load_contour("naca2412"), 81).points[:41]),
            "does not go around a section exactly once: list the points",
        ),
        (
            rows(np.insert(POINTS, 2, POINTS[:, 0] ** 2, axis=1), "{} {} {}"),
            "three numbers a line, x y z, of no flat",
        ),
        (rows(np.tile(POINTS[3], (40, 1))), "x is"),
    ],
)
def test_an_outline_that_is_none_is_refused(text: str, says: str):
    with pytest.raises(ValueError, match=r"^a\.dat") as caught:
        parse_contour(text, "a.dat")
    assert says in str(caught.value)


POLAR = POLARS[2]
COLUMNS = (POLAR.alpha_deg, POLAR.cl, POLAR.cd, POLAR.cm)
XFOIL = polar_file(POLAR)


def table(form: str, *columns: np.ndarray) -> str:
    return "\n".join(form.format(*row) for row in zip(*(columns or COLUMNS), strict=True)) + "\n"


COMMAS = "{:.3f},{:.4f},{:.5f},{:.4f}"
BLANKS = COMMAS.replace(",", " ")
SEMICOLONS = f"0,3;3240000;{COMMAS.replace(',', ';')}"
POLAR_FILES = {
    "XFOIL": XFOIL,
    "rows twice": XFOIL + XFOIL.splitlines()[-1],
    "site": "Reynolds number fixed. Mach  number fixed\nReynolds number,3240000\nMach,0.3\n\nAlpha,Cl,Cd,Cm\n"
    + table(COMMAS),
    "capitals, blanks, further columns": "Name, Mach , RE, Alpha_deg, CL, CD, CM\n"
    + table(f"x, 0.3, 3.24e6, {COMMAS}"),
    "quotes and semicolons": '"mach";"reynolds";"alpha";"cl";"cd";"cm"\n' + table(SEMICOLONS).replace(".", ","),
    "AeroDyn": "! Mach 0.3\n 3.24   Re  ! in millions\n"
    + 45 * " 1.7 T_f0 ! a time constant\n"
    + " 73 NumAlf\n!  Alpha Cl Cd Cm\n! (deg) (-) (-) (-)\n"
    + f"{table(BLANKS)}! end\n",
    "QBlade": f"REYNOLDS 3.24e6\nMACH 0.3\nAOA CL CD CM\n{table(BLANKS)}",
    "names of two words": "Mach 0,300  Re = 3,240 e 6\nAngle of attack CL CD Top Xtr Cm Xcp\n"
    + table("{:.3f} {:.4f} {:.5f} 0.9 {:.4f} 0.3"),
    "minus signs of print, Fortran": "Mach 0.3 Re 3.24 x 10^6\nAlpha (deg) CL CD CM\n"
    + table("{:.5E} {:.5E} {:.5E} {:.5E}").replace("-", "−").replace("E", "D"),
    "0 to 360": "mach,reynolds,alpha,cl,cd,cm\n" + table(f"0.3,3.24e6,{COMMAS}", COLUMNS[0] % 360.0, *COLUMNS[1:]),
}  # fmt: skip


@pytest.mark.parametrize("kind", POLAR_FILES)
def test_a_polar_of_any_program_is_the_same(kind: str):
    read_ = parse_polars(POLAR_FILES[kind], "a.txt")
    (polar,) = read_.polars
    assert (polar.mach, polar.reynolds, read_.assumed) == (0.3, 3.24e6, ())
    for ours, column in zip((polar.alpha_deg, polar.cl, polar.cd, polar.cm), COLUMNS, strict=True):
        assert_allclose(ours, column, atol=1e-9)


def test_several_reynolds_numbers_are_several_polars():
    body = "".join(
        table(f"0.3,{reynolds},{{}},{{:.4f}},{{:.5f}},{{:.4f}}") for reynolds in (4e5, 1e5)
    )
    polars = parse_polars(f"mach,reynolds,alpha_deg,cl,cd,cm\n{body}", "a.csv").polars
    assert [(polar.mach, polar.reynolds) for polar in polars] == [(0.3, 1e5), (0.3, 4e5)]
    tables = f"alpha cl cd\nRe 1e5\n{table('{} {} {}', *COLUMNS[:3])}"
    found = parse_polars(f"Re = 1e5\n{tables}\nRe = 4e5\n{tables}", "a.txt")
    assert [(polar.mach, polar.reynolds) for polar in found.polars] == [(0.0, 1e5), (0.0, 4e5)]
    assert found.assumed == (
        "names no Mach number: it is taken as incompressible",
        "has no cm: it is taken as 0",
    )


@pytest.mark.parametrize(
    "words",
    ["500,000", "500 000", "500'000", "500k", "0.5 million", "5x10^5", "5.0D+05", "0,500 e 6", "500 thousand"],
)  # fmt: skip
def test_a_reynolds_number_is_read_as_it_is_written(words: str):
    (polar,) = parse_polars(
        f"Reynolds number: {words} Mach number: 0,30\nalpha cl cd cm\n{table(BLANKS)}", "a.txt"
    ).polars
    assert (polar.mach, polar.reynolds) == (0.3, 5e5)


def test_angles_in_radians_are_said():
    rows = table("{:.9f} {:.4f} {:.5f} {:.4f}", np.deg2rad(COLUMNS[0]), *COLUMNS[1:])
    text = f"Mach 0.3\nalpha (rad) cl cd cm\n{rows}"
    found = parse_polars(text, "a.txt")
    assert_allclose(found.polars[0].alpha_deg, COLUMNS[0], atol=1e-6)
    assert found.assumed == ("has its angles in radians",)


def kept(inside: np.ndarray) -> str:
    return polar_file(Polar(POLAR.mach, 3.24e6, *(column[inside] for column in COLUMNS)))


LINES = len(XFOIL.splitlines())


def wrong(column: int, value: float) -> str:
    """A table with one wrong number where the lift is large."""
    columns = [one.copy() for one in COLUMNS]
    columns[column][np.argmax(COLUMNS[1])] = value
    return table(BLANKS, *columns)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (kept(np.abs(POLAR.alpha_deg) >= 9.0), "Mach 0.3 has no rows between -9 and 9 deg: run XFOIL there again"),
        (kept((POLAR.alpha_deg < 9.0) | (POLAR.alpha_deg > 13.0)), "smaller steps of ASEQ, or remove those beyond"),
        (XFOIL + "  18 0.7 0.2 0 0\n", f"line {LINES + 1}: 18 deg again, unlike line {LINES}"),
        (XFOIL.replace("number fixed  ", "number ~ 1/sqrt(CL)  "), "a.txt: its Reynolds number changes with lift"),
        (f"Mach 0.3 Re 500\nalpha cl cd cm\n{table(BLANKS)}", "Reynolds number 500 is not a blade's: give it in full"),
        (f"alpha cl cd stall margin cm\n{table(BLANKS)}", "line 1: the heading names 6 columns, but line 2 has 4"),
        (f"alpha cl cd cm\n{table(BLANKS)}90 0.1 1 -5\n", "cm -5 at 90 deg is not possible: remove the row"),
        (f"alpha cl cd cm\n{wrong(1, -0.3)}", "deg, as no section does: correct the row"),
        (f"alpha cl cd cm\n{wrong(2, 0.5)}", "a.txt, line 67: cd rises by 0.473 from 14 to 14.5 deg"),
    ],
)  # fmt: skip
def test_a_polar_that_cannot_be_trusted_is_refused(text: str, says: str):
    with pytest.raises(ValueError, match=re.escape(says)):
        mine('polars = "a.txt"', "a.txt", text)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_text_of_windows_is_read(encoding: str, tmp_path: Path):
    path = tmp_path / "a.txt"
    path.write_bytes(XFOIL.replace("NACA 0012", "Flügel, 20 °C").encode(encoding))
    assert (
        parse_polars(read_text(path, "section file", "save it as text"), "a.txt").polars[0].reynolds
        == 3.24e6
    )
    path.write_bytes(bytes(256))
    with pytest.raises(
        ValueError, match=r"section file '.*a\.txt' cannot be read \(not text\): save it as text"
    ):
        read_text(path, "section file", "save it as text")


def mine(keys: str, name: str, text: str) -> Aircraft:
    """The same on the page and in Python."""
    toml = (
        GOOD.replace('"naca0012"', '"mine"', 1)
        + f'\n[sections.mine]\n{keys}\noutline = "naca0012"\n'
    )
    craft = read(toml, **{name: text})
    shelf = UploadedFiles()
    shelf.add("my.toml", toml.encode())
    assert shelf.add(name, text.encode()).aircraft == craft
    return craft


ANGLES = np.array([-180.0, -90.0, -20.0, -10.0, 0.0, 10.0, 20.0, 90.0, 180.0])


def block(mach: list[float], values: np.ndarray) -> C81Block:
    return C81Block(np.array(mach), ANGLES, np.tile(values[:, None], len(mach)))


def deck(mach: list[float], moment: bool = True) -> C81Deck:
    lift, drag = (
        np.interp(ANGLES, [-180, -10, 10, 180], [0, -1.1, 1.1, 0]),
        0.01 + np.sin(np.deg2rad(ANGLES)) ** 2,
    )
    return C81Deck(
        "OWN", block(mach, lift), block(mach, drag), block(mach, -0.1 * lift) if moment else None
    )


def spaced(text: str, width: int) -> str:
    """A deck with all fields of another width, or by single blanks."""
    title, *cards = text.splitlines()
    fields = [[card[k : k + 7].strip() for k in range(0, len(card), 7)] for card in cards]
    lines = [
        " ".join(row) if not width else "".join(f"{each:>{width}}" for each in row)
        for row in fields
    ]
    return "\n".join([title, *lines])


FULL = format_c81(deck([0.0, 0.5, 1.0]))
DECKS = {
    "lines above the title": "1 0 0\n0\ncomment 2412 12\n\n" + FULL,
    "fields of ten": spaced(FULL, 10),
    "by blanks": spaced(FULL, 0),
    "words below": FULL + "\nMade by hand in 1998\n",
    "counts apart": FULL.replace("                            3 9 3 9 3 9", "  3 9 3 9 3 9"),
    "an angle twice": FULL.replace(" 3 9 3 9 3 9", " 310 3 9 3 9").replace(
        "   0.00", f"   0.00{'  0.0000' * 0}", 1
    ),
}
DECKS["an angle twice"] = "\n".join(
    line
    for k, line in enumerate(DECKS["an angle twice"].splitlines())
    for _ in range(2 if k == 6 else 1)
)


@pytest.mark.parametrize("kind", DECKS)
def test_a_deck_of_any_spacing_is_the_same(kind: str):
    ours, plain = parse_c81(DECKS[kind], "a.c81"), parse_c81(FULL)
    assert ours.title == "OWN"
    for one, other in zip(ours.blocks, plain.blocks, strict=True):
        assert_allclose(one.values, other.values, atol=1e-12)
        assert_allclose(one.alpha_deg, ANGLES, atol=1e-12)
    assert (
        mine('deck = "a.c81"', "a.c81", DECKS[kind])
        .remarks[0]
        .startswith("Section mine: deck over −180…180° at Mach 0…1;")
    )


def test_a_deck_of_one_mach_number_without_moment_is_held():
    craft = mine('deck = "a.tab"', "a.tab", format_c81(deck([0.3], moment=False)))
    assert "at Mach 0.3, held at all Mach numbers, without cm;" in craft.remarks[0]
    installed = craft.rotor.blade.installed("mine").table
    assert installed.moment(0.1, 0.3) is None
    assert_allclose(installed(np.deg2rad(10.0), [0.0, 0.3, 0.9]).cl, 1.1, atol=1e-4)
    assert solve(make_design(rotor=craft, mu=0.2)).converged


ODD = [0.0, 0.3, 0.42, 0.61, 0.72, 0.77, 0.87, 1.0]
DENSE = [0.0, 0.3, 0.71, 0.715, 0.72, 1.0]


@pytest.mark.parametrize(("machs", "remark"), [(ODD, ""), (DENSE, "of cd at Mach 0.7")])
def test_mach_numbers_of_a_deck_are_met_or_the_difference_is_said(machs: list[float], remark: str):
    """Steps of the table are 0.05. The curve read at them was 8 % of c_d off the first of these decks."""
    shipped = load_section("naca0012")
    given = shipped(np.deg2rad(ANGLES)[:, None], np.array(machs))
    drag = given.cd.copy()
    drag[:, machs.index(0.715) if remark else 0] *= 1.3 if remark else 1.0
    lift, drag = (C81Block(np.array(machs), ANGLES, values) for values in (given.cl, drag))
    own = C81Deck("OWN", lift, drag, None)
    craft = mine('deck = "a.c81"', "a.c81", format_c81(own))
    found = craft.rotor.blade.installed("mine").table(
        np.deg2rad([-10.0, 0.0, 10.0])[:, None], np.array(machs)
    )
    assert len(craft.remarks) == (2 if remark else 1)
    assert remark in craft.remarks[-1]
    if not remark:
        assert_allclose(found.cd, drag.values[3:6], rtol=0.005, atol=1e-5)


def test_an_outline_gives_the_thickness_of_the_wave_drag_or_asks_for_it():
    thin = POINTS * (1.0, 0.1)
    toml = (
        GOOD.replace('"naca0012"', '"mine"', 1)
        + '\n[sections.mine]\npolars = "a.txt"\noutline = "b.dat"\n'
    )
    files = {"a.txt": XFOIL, "b.dat": rows(POINTS)}
    assert "outline of 41 points, 12.0 % thick, 2.0 % camber" in read(toml, **files).remarks[0]
    with pytest.raises(
        ValueError, match=r"b\.dat: the outline is 1\.2 % thick, outside 2…40 %: .*`thickness`"
    ):
        read(toml, **{**files, "b.dat": rows(thin)})
    assert read(toml + "thickness = 0.05\n", **{**files, "b.dat": rows(thin)}).remarks
    windows = toml.replace('"b.dat"', "'data\\b.dat'")
    with pytest.raises(ValueError, match="which is missing: write / in paths"):
        read(windows, **files)


def test_a_round_shank_has_drag_alone():
    """In hover it takes ½ρ N_b ΔC_d Ω³ ∫c y³dy; its angle of attack does not matter, and it never stalls."""

    def with_drag(drag: float) -> Aircraft:
        spans = "[{start_r = 0.2, end_r = 0.3, section = 'shank'}, {start_r = 0.3, end_r = 1.0, section = 'naca0012'}]"
        shank = f"\n[sections.shank]\ndrag_coefficient = {drag}\n"
        return read(GOOD.replace('section = "naca0012"', f"spans = {spans}") + shank)

    thin, thick = with_drag(0.4), with_drag(1.0)
    assert any("no lift and no moment, drag coefficient 1 at" in remark for remark in thick.remarks)
    blade = thick.rotor.blade
    shank = blade.installed("shank").table
    assert not shank(np.linspace(-3.0, 3.0, 50), 0.3).cl.any()
    assert_allclose(shank(np.linspace(-3.0, 3.0, 50), 0.3).cd, 1.0)
    low, high = (solve(make_design(rotor=craft, hover=True)) for craft in (thin, thick))
    # Elements have one section each.
    r = np.linspace(0.2, 0.2 + high.disk.dr[high.disk.r < 0.3].sum(), 2001)
    along = np.trapezoid(blade.chord(r) * r**3, r) * thick.rotor.radius
    wanted = 0.5 * SEA_LEVEL_DENSITY * thick.rotor.blades * 0.6 * thick.rotor.tip_speed**3 * along
    assert_allclose(high.power.profile - low.power.profile, wanted, rtol=0.02)
    fast = solve(make_design(rotor=thick, mu=0.25))
    assert fast.converged
    assert not fast.disk.stalled[fast.disk.r < 0.29].any()
