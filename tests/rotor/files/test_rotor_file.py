"""Rotor files: what they hold, their units, and one clear sentence with the line for whatever is wrong in one."""

import math
import pickle
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from rotor import Aircraft, hub_loads, make_design, solve
from rotor.airfoil.c81 import C81Block, C81Deck, format_c81, parse_c81, read_c81
from rotor.airfoil.decks import on_run_time_grid
from rotor.airfoil.polars import Polar, read_polars
from rotor.airfoil.sections import load_installed
from rotor.files.rotor_file import load_rotor, read_aircraft
from rotor.support.assets import asset_path

POLARS = read_polars(asset_path("airfoils/naca0012_trip5.polars.csv")).polars
DECK = asset_path("airfoils/naca0012.c81").read_text(encoding="utf-8")
GOOD = """\
name = "Test rotor"

[main_rotor]
blades = 3
radius_m = 5.0
speed_rpm = 400.0
root_cutout_r = 0.2
chord_r = [0.2, 1.0]
chord_m = [0.30, 0.20]
section = "naca0012"
twist_r = [0.2, 0.75, 1.0]
twist_deg = [6.0, 0.0, -3.0]
flap_hinge_m = 0.2
blade_mass_kg = 40.0

[airframe]
drag_area_m2 = 1.0
mass_kg = 1500.0
"""


def read(text: str, **files: str) -> Aircraft:
    return read_aircraft("my.toml", {"my.toml": text, **files})


def polar_file(polar: Polar) -> str:
    """As XFOIL 6.99 writes one."""
    rows = "\n".join(
        f"{a:8.3f}{cl:9.4f}{cd:10.5f}{0.0:10.5f}{cm:9.4f}   0.0500   0.0500"
        for a, cl, cd, cm in zip(polar.alpha_deg, polar.cl, polar.cd, polar.cm, strict=True)
    )
    return (
        "\n       XFOIL         Version 6.99\n\n Calculated polar for: NACA 0012\n\n"
        " 1 1 Reynolds number fixed          Mach number fixed\n\n xtrf =   0.050 (top)        0.050 (bottom)\n"
        f" Mach = {polar.mach:7.3f}     Re = {(polar.reynolds or 0.0) / 1e6:9.3f} e 6     Ncrit =   9.000\n\n"
        "   alpha    CL        CD       CDp       CM     Top_Xtr  Bot_Xtr\n"
        "  ------ -------- --------- --------- -------- -------- --------\n"
        f"{rows}\n"
    )


def test_a_twist_that_rises_is_remarked():
    text = re.sub(r"twist_r = .*\ntwist_deg = .*", "linear_twist_deg = -9.0", GOOD)
    assert not read(text).remarks
    assert "for washout write linear_twist_deg = -9" in read(text.replace("-9.0", "9.0")).remarks[0]


def test_a_rotor_alone_needs_neither_mass_nor_spring():
    """Power in hover is that of any mass, and a rigid blade has none to flap with; without a mass γ is 8."""
    text = GOOD.partition("[airframe]")[0].replace("flap_hinge_m = 0.2\n", "")
    bare = text.replace("blade_mass_kg = 40.0\n", "")
    rigid = bare.replace("blades = 3", 'blades = 3\nhub = "hingeless"\nprecone_deg = 2.0')
    powers = list[float]()
    for craft in map(read, (text, bare, rigid)):
        powers.append(
            solve(make_design(rotor=craft, hover=True, stand={"ct_over_sigma": 0.08}))
            .require()
            .power.shaft
        )
    assert_allclose(powers, powers[0], rtol=1e-9)
    assumed, held = read(bare), read(rigid)
    assert_allclose(
        1.225 * 5.73 * 0.25 * 5.0**4 / assumed.rotor.blade.flap_inertia, 8.0, rtol=1e-12
    )
    assert "no blade_mass_kg: the blades flap with Lock number 8" in assumed.remarks[0]
    assert not held.remarks
    flown = solve(make_design(rotor=held, mu=0.15, stand={"ct_over_sigma": 0.08})).require()
    assert_allclose(math.degrees(flown.controls.coning), 2.0)
    assert (flown.controls.cyclic_1s, flown.controls.flap_1s) == (0.0, 0.0)
    assert flown.hub_moment.roll > 0.0  # More lift on the advancing side.
    assert "rigid-blades" in {caveat.name for caveat in flown.caveats}
    bends = 'structure = "uh60a"\n[airframe]'
    with pytest.raises(ValueError, match="a hingeless blade with bending stiffness also needs it"):
        read(
            GOOD.replace("blades = 3", 'blades = 3\nhub = "hingeless"').replace("[airframe]", bends)
        )


def test_thrust_at_a_collective_is_not_trusted_on_short_blades():
    text = GOOD.partition("[airframe]")[0]
    for chord, told in ((0.45, False), (0.6, True)):  # R/c 11.1 and 8.3.
        craft = read(text.replace("[0.30, 0.20]", f"[{chord}, {chord}]"))
        for stand in ({"collective_deg": 8.0}, {"ct_over_sigma": 0.05}):
            found = solve(make_design(rotor=craft, hover=True, stand=stand)).require()
            names = {caveat.name for caveat in found.caveats}
            assert ("small-aspect-ratio" in names) == (told and "collective_deg" in stand)


def test_a_minimal_file_is_enough():
    craft = read(GOOD)
    rotor, blade = craft.rotor, craft.rotor.blade
    assert (craft.name, rotor.blades, craft.mass, craft.tail_rotor, craft.key) == (
        "Test rotor",
        3,
        1500.0,
        None,
        "",
    )
    assert_allclose(rotor.angular_speed, 400.0 * 2.0 * math.pi / 60.0, rtol=1e-12)
    assert_allclose(rotor.reference_chord, 0.20 + 0.10 * (0.25 / 0.8), rtol=1e-12)  # at 0.75 R
    assert_allclose(np.rad2deg(rotor.builtin_twist([0.2, 1.0])), [6.0, -3.0], rtol=1e-12)
    assert rotor.builtin_twist.spec() == "builtin"
    # Uniform from the hinge outward: eqs. (2.35), (2.37) with 4.8 m.
    assert_allclose(blade.flap_inertia, 40.0 * 4.8**2 / 3.0, rtol=1e-12)
    assert_allclose(blade.flap_static_moment, 40.0 * 2.4, rtol=1e-12)
    assert pickle.loads(pickle.dumps(craft)) == craft
    assert hash(pickle.loads(pickle.dumps(craft))) == hash(craft)


BAD = [
    ("name = \n", "", "my.toml, line 1: this is not TOML"),
    ('name = "Test rotor"', 'name = "<b>"', "my.toml, line 1: name is '<b>': use 1 to 40 letters"),
    ("radius_m = 5.0", 'radius_m = "five"', "my.toml, line 5: radius_m is 'five', not a number"),
    ("radius_m = 5.0", "radius_m = 5000.0", "my.toml, line 5: radius_m is 5000, outside 0.1…30 m: check"),
    ("radius_m = 5.0", "radius_m = 0.5", "line 13: flap_hinge_m is 0.2, outside 0…0.15 m with radius_m = 0.5: check"),
    ("drag_area_m2 = 1.0", "drag_area_m2 = 0.1\ndrag_area_low_m2 = 0.8\ndrag_area_high_m2 = 1.2",
     "line 17: drag_area_m2 is 0.1, outside 0.8…1.2 with drag_area_low_m2 = 0.8 and drag_area_high_m2 = 1.2: check"),
    ("radius_m = 5.0", "radius = 5.0", "my.toml, line 5: unknown key 'radius'; did you mean 'radius_m'?"),
    ("blades = 3", "blades = 3.5", "my.toml, line 4: blades is 3.5, not a whole number"),
    ("blades = 3", 'blades = 3\nhub = "teetering"', "my.toml, line 5: hub is 'teetering' with 3 blades"),
    ("blades = 3", 'blades = 3\nhub = "teetring"',
     "line 5: hub is 'teetring'; did you mean 'teetering'? use articulated or"),
    ("speed_rpm = 400.0", "speed_rpm = 400.0\ntip_speed_m_s = 200.0", "my.toml, line 7: speed_rpm and"),
    ("chord_m = [0.30, 0.20]", "chord_m = [0.3, 0.2, 0.2]", "my.toml, line 9: chord_r has 2 and chord_m 3 values"),
    ("chord_r = [0.2, 1.0]", "chord_r = [1.0, 1.0]", "chord_r has 1 twice: for a step write 0.999 and 1"),
    ('"naca0012"', '"data\\mine"',
     "line 10: this is not TOML (Unescaped '\\' in a string): write key = value, texts in"),
    ('section = "naca0012"', 'section = "naca9999x"', "my.toml, line 10: section 'naca9999x' is not known"),
    ("mass_kg = 1500.0", "mass_kg = 1500.0\ncolour = 3", "my.toml, line 19: unknown key 'colour': the keys are"),
    ("mass_kg = 1500.0",
     "mass_kg = 1500.0\n[controls]\nlateral_deg = [9, 1]\ncollective_deg = [0, 1]\nlongitudinal_deg = [0, 1]",
     "line 20: lateral_deg is [9.0, 1.0]: write both"),
]  # fmt: skip


@pytest.mark.parametrize(("good", "bad", "says"), BAD)
def test_bad_files_get_one_sentence_with_line_and_remedy(good: str, bad: str, says: str):
    text = GOOD.replace(good, bad, 1) if good in GOOD else good + GOOD
    with pytest.raises(ValueError, match=r"my\.toml") as caught:
        read(text)
    sentence = str(caught.value)
    assert says in sentence
    assert "\n" not in sentence
    assert ": " in sentence


ODD = (
    "true", '""', '"x"', "nan", "-inf", "1e300", "-7", "9" * 400, "[]", "[1]", '["a", 1]', "{}", "{ a = 1 }",
    "1979-05-27",
)  # fmt: skip
"""Values in TOML of which hardly a key takes one."""


def test_any_value_of_any_key_is_read_or_refused_in_one_sentence():
    """The shipped rotors have nearly all keys between them, lists of numbers and of tables too. A number that does not
    fit another key is named, not that key alone."""
    refused, unnamed = list[str](), list[str]()
    for name in ("uh60a", "bo105", "rotors/hart2"):
        text = asset_path(f"{name}.toml").read_text(encoding="utf-8")
        for key in re.finditer(r"^(\w+) = (?:\[[^]]*\](?:, *\])?|[^#\n]+)", text, re.MULTILINE):
            number = re.fullmatch(r"-?[\d.]+", key[0].partition(" = ")[2].strip())
            scaled = [f"{float(number[0]) * scale:g}" for scale in (0.1, 10.0)] if number else []
            for odd in (*ODD, *scaled):
                try:
                    read(f"{text[: key.start()]}{key[1]} = {odd}{text[key.end() :]}")
                except ValueError as error:
                    refused.append(str(error))
                    unnamed += [refused[-1]] if odd in scaled and key[1] not in refused[-1] else []
    assert unnamed == []
    assert len(refused) > 800
    assert [
        one
        for one in refused
        if not re.fullmatch(r"my\.toml(, line \d+|: an integer).*[:?] ?.*", one)
    ] == []


def test_a_bad_span_is_reported_with_its_line():
    spans = """spans = [
  { start_r = 0.2, end_r = 0.6, section = "naca0012" },
  { start_r = 0.5, end_r = 1.0, section = "sc1095" },
]"""
    with pytest.raises(
        ValueError,
        match=r"my\.toml, line 12: span of sc1095 runs 0\.5…1: write the spans in ascending order",
    ):
        read(GOOD.replace('section = "naca0012"', spans))
    craft = read(
        GOOD.replace('section = "naca0012"', spans.replace("start_r = 0.5", "start_r = 0.7"))
    )
    assert craft.rotor.blade.section_at(0.65)[:2] == ("naca0012", "sc1095")


def test_a_users_deck_is_used_and_pickles():
    text = (
        GOOD.replace('"naca0012"', '"mine"')
        + '\n[sections.mine]\ndeck = "mine.c81"\noutline = "naca0012"\n'
    )
    craft = read(text, **{"mine.c81": DECK})
    assert craft.remarks == (
        "Section mine: deck over −180…180° at Mach 0…1; outline naca0012, 12.0 % thick, 0.0 % camber.",
    )
    section = pickle.loads(pickle.dumps(craft)).rotor.blade.installed("mine")
    alpha, mach = np.deg2rad(np.linspace(-180.0, 180.0, 73)), 0.37
    assert_allclose(
        section.table(alpha, mach).cl, load_installed("naca0012").table(alpha, mach).cl, atol=1e-12
    )
    assert dict(craft.files.texts) == {"my.toml": text, "mine.c81": DECK}


SECTION = '\n[sections.mine]\npolars = ["a.txt", "b.txt"]\noutline = "naca0012"\n'


def test_xfoil_polars_give_the_bundled_deck():
    polars = read_polars(asset_path("airfoils/naca64208_trip5.polars.csv")).polars
    files = {"a.txt": polar_file(polars[2]), "b.txt": polar_file(polars[3])}
    craft = read(GOOD.replace('"naca0012"', '"mine"', 1) + SECTION, **files)
    assert len(craft.remarks) == 1
    assert "Mach 0.3 (Re 2.48 million), 0.4 (Re 3.31 million) over −12…14.5°" in craft.remarks[0]
    ours, mine = load_installed("naca64208").table, craft.rotor.blade.installed("mine").table
    alpha = np.deg2rad(np.arange(-8.0, 8.5, 0.5))
    for mach in (0.3, 0.4):
        # decks hold four decimals
        assert_allclose(mine(alpha, mach).cl, ours(alpha, mach).cl, atol=1e-3)
        assert_allclose(mine(alpha, mach).cd, ours(alpha, mach).cd, atol=2e-5)
    # Beyond the fastest polar both go on by the same formulas, with other caps on lift.
    small = np.deg2rad(np.arange(-4.0, 4.5, 0.5))
    assert_allclose(mine(small, 0.6).cl, ours(small, 0.6).cl, atol=0.02)


def test_bad_section_files_get_one_sentence():
    polar, deck = POLARS[2], DECK
    fine = polar_file(polar)
    toml = GOOD.replace('"naca0012"', '"mine"', 1)
    one = '\n[sections.mine]\npolars = "a.txt"\n'
    of_deck = '\n[sections.mine]\ndeck = "a.c81"\n'
    cut = Polar(0.3, 3e6, polar.alpha_deg[30:45], polar.cl[30:45], polar.cd[30:45], polar.cm[30:45])
    cases: list[tuple[str, dict[str, str], str]] = [
        (SECTION, {"a.txt": fine}, "my.toml, line 21: polars names 'b.txt', which is missing"),
        (SECTION, {"a.txt": fine, "b.txt": fine}, "line 21: two polars of mine have Mach 0.3"),
        (one, {"a.txt": "hello\n"}, "a.txt has no line that names columns alpha, cl and cd: save a polar with PACC"),
        (one, {"a.txt": fine.replace(f"{polar.cl[3]:9.4f}", "     oops", 1)}, "not a row of numbers"),
        (one, {"a.txt": polar_file(cut)}, "line 21: the polar of mine at Mach 0.3 covers"),
        (of_deck, {"a.c81": deck.replace("NACA", "NACA 0012 is too long a title", 1)}, "a.c81"),
        (of_deck, {"a.c81": deck[:9000]}, "of cl: check the counts in line 1"),
        ("\n[sections.mine]\n", {}, "line 20: there is no deck or polars or drag_coefficient: add one of them"),
        (of_deck.replace("mine", '"My Section"'), {"a.c81": deck}, "name 'My Section' is taken or has characters"),
    ]  # fmt: skip
    for section, files, says in cases:
        with pytest.raises(ValueError, match=r"a\.|my\.toml") as caught:
            read(toml + section, **files)
        assert says in str(caught.value)
        assert "\n" not in str(caught.value)


def test_other_decks_are_interpolated_to_the_run_time_grid():
    """A deck with odd angles and Machs that ends at stall: its own values inside, the closed form far out."""
    ours = read_c81(asset_path("airfoils/naca0012.c81"))
    alpha, mach = np.array([-14.0, -9.3, -4.7, 0.0, 4.7, 9.3, 14.0]), np.array([0.3, 0.42, 0.61])
    lift = C81Block(mach, alpha, np.outer(alpha, [0.11, 0.115, 0.13]))
    drag = C81Block(mach, alpha, np.tile(0.008 + 1e-4 * alpha[:, None] ** 2, (1, 3)))
    deck = on_run_time_grid(parse_c81(format_c81(C81Deck("ODD", lift, drag, drag))))
    at = {angle: k for k, angle in enumerate(deck.cl.alpha_deg)}
    assert_allclose(deck.cl.mach[[0, -1]], [0.3, 0.6], rtol=1e-12)
    assert_allclose(deck.cl.values[at[4.5], 0], 0.495, rtol=1e-3)
    assert_allclose(
        deck.cl.values[at[90.0]],
        np.interp(90.0, ours.cl.alpha_deg, ours.cl.values[:, 3]),
        atol=0.01,
    )
    assert deck.cd.values.min() > 0.0
    with pytest.raises(ValueError, match=r"ODD: cl covers -4\.7…4\.7 deg: give at least −8…8 deg"):
        on_run_time_grid(C81Deck("ODD", C81Block(mach, alpha[2:5], lift.values[2:5]), drag, drag))


def test_assumptions_about_files_are_caveats():
    one = '\n[sections.mine]\npolars = "a.txt"\noutline = "naca0012"\n'
    craft = read(GOOD.replace('"naca0012"', '"mine"', 1) + one, **{"a.txt": polar_file(POLARS[2])})
    caveats = solve(make_design(rotor=craft, mu=0.2)).require().caveats
    assert [caveat.name for caveat in caveats] == [
        "rotor-file",
        "no-tail-rotor",
        "no-blade-structure",
    ]


@pytest.mark.parametrize("page", ["docs/tutorials/mine.toml", "docs/rotor_file.md"])
def test_the_examples_in_the_docs_are_rotor_files(page: str):
    text = (Path(__file__).parent.parent.parent.parent / page).read_text(encoding="utf-8")
    example = (
        text if page.endswith(".toml") else re.findall(r"```toml\n(.*?)```", text, re.DOTALL)[0]
    )
    files = {f"n23012_m0{k + 1}.txt": polar_file(POLARS[k]) for k in (1, 2, 3)}
    assert solve(make_design(rotor=read(example, **files), mu=0.2)).converged


def test_files_beside_the_rotor_file_are_found(tmp_path: Path):
    text = GOOD.replace('"naca0012"', '"mine"') + '\n[sections.mine]\ndeck = "mine.c81"\n'
    (tmp_path / "my.toml").write_text(text, encoding="utf-8")
    with pytest.raises(
        ValueError, match=r"my\.toml, line 21: deck names 'mine\.c81', which is missing"
    ):
        load_rotor(tmp_path / "my.toml")
    (tmp_path / "mine.c81").write_text(DECK, encoding="utf-8")
    craft = load_rotor(tmp_path / "my.toml")
    assert craft.remarks[0].endswith("no outline, so it is drawn as a symmetric 12 % section.")
    assert craft.rotor.blade.installed("mine").outline.name == "naca0012"
    (tmp_path / "sub").mkdir()
    (tmp_path / "mine.c81").rename(tmp_path / "sub" / "mine.c81")
    (tmp_path / "my.toml").write_text(text.replace("mine.c81", "sub/mine.c81"), encoding="utf-8")
    assert load_rotor(tmp_path / "my.toml").rotor.blade.own_sections[0].name == "mine"
    with pytest.raises(ValueError, match="does not exist"):
        load_rotor(tmp_path / "other.toml")


STRUCTURE = """
[main_rotor.structure]
r_m = [0.5, 5.0]
gj_nm2 = [5000.0, 4000.0]
mass_kg_m = [6.0, 5.0]
torsional_inertia_kg_m = [0.03, 0.02]
control_stiffness_nm_rad = 20000.0
pitch_horn_m = 0.1
"""


def test_a_structure_makes_the_blade_elastic():
    craft = read(GOOD + STRUCTURE)
    structure = craft.rotor.blade.structure
    assert (structure.torsional_stiffness, structure.control_stiffness) == (
        (5000.0, 4000.0),
        20000.0,
    )
    assert structure.clamp == craft.rotor.blade.flap_hinge * craft.rotor.radius
    solution = solve(make_design(rotor=craft, mu=0.2)).require()
    assert solution.elastic is not None
    assert "no-blade-structure" not in [caveat.name for caveat in solution.caveats]
    copied = read(GOOD.replace("root_cutout_r", 'structure = "uh60a"\nroot_cutout_r', 1))
    assert copied.rotor.blade.structure is not None


def test_a_structure_with_bending_has_hub_loads():
    bending = "flap_stiffness_nm2 = [4e4, 3e4]\nlag_stiffness_nm2 = [8e5, 6e5]\nlag_damper_nm_s_rad = 2000.0\n"
    craft = read(GOOD + STRUCTURE + bending)
    structure = craft.rotor.blade.structure
    assert structure.bends
    assert (structure.lag_stiffness, structure.lag_damper) == ((8e5, 6e5), 2000.0)
    solution = solve(make_design(rotor=craft, mu=0.25)).require()
    loads = hub_loads(solution)
    assert loads.per_rev == craft.rotor.blades


@pytest.mark.parametrize(
    ("old", "new", "remedy"),
    [
        ("gj_nm2 = [5000.0, 4000.0]", "gj_nm2 = [5000.0]", "one value per station"),
        ("r_m = [0.5, 5.0]", "r_m = [5.0, 0.5]", "ascending"),
        ("pitch_horn_m = 0.1\n", "", "pitch_horn_m"),
        ("pitch_horn_m", "pitch_horn", "pitch_horn_m"),
        ("20000.0", "-1.0", "control_stiffness_nm_rad"),
        ("pitch_horn_m = 0.1", "pitch_horn_m = 0.1\nflap_stiffness_nm2 = [1e5, 1e5]", "or neither"),
    ],
)
def test_a_wrong_structure_is_one_sentence(old: str, new: str, remedy: str):
    with pytest.raises(ValueError, match=remedy):
        read(GOOD + STRUCTURE.replace(old, new))


_IN_THREADS = """
import sys
import threading
from msgspec import defstruct
from rotor.files.declared import convert

sys.setswitchinterval(1e-6)
for _ in range(100):
    inner = defstruct("Inner", [(f"a{k}", float, 0.0) for k in range(40)])
    outer = defstruct("Outer", [(f"b{k}", inner | None, None) for k in range(20)])
    begin = threading.Barrier(4)
    def read():
        begin.wait()
        assert convert({"b0": {"a1": 1.0}}, outer).b0.a1 == 1.0
    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
"""


def test_threads_may_read_a_table_for_the_first_time_together():
    """msgspec ends the process there, in a few of a hundred such beginnings."""
    subprocess.run([sys.executable, "-c", _IN_THREADS], cwd=Path(__file__).parents[3], check=True)
