"""The documentation: what it names exists, what it shows runs, and it is short enough to read.

The site itself is built by `make docs`; here a page with a chart is, and its pixels are looked at.
"""

import argparse
import ast
import inspect
import json
import math
import re
import shlex
import types
import typing
from functools import partial
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import explorer
import explorer.__main__
import rotor
import rotor.validation
from explorer.export import blade, report
from explorer.model.inputs import LAWS, ROWS
from rotor.__main__ import build_parser
from rotor.__main__ import main as rotor_main
from rotor.design.quantities import BY_INPUT
from rotor.support.terminal import OneLineParser
from rotor.trim import validity
from tests.tools import measured

matplotlib.use("Agg")
ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
API = (DOCS / "reference" / "api.md").read_text(encoding="utf-8")
GUIDES = [*sorted((DOCS / "guide").glob("*.md")), DOCS / "scale.md"]
TUTORIALS = sorted((DOCS / "tutorials").glob("*.md"))


def text(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def named_in(annotation: object, where: types.ModuleType) -> set[type]:
    """Classes of ours in an annotation, which may be a text."""
    if isinstance(annotation, str):
        parts = [vars(where).get(word) for word in re.findall(r"[A-Za-z_]\w*", annotation)]
    else:
        parts = typing.get_args(annotation)
    if inspect.isclass(annotation) and not parts:
        return (
            {annotation} if annotation.__module__.split(".")[0] in ("rotor", "explorer") else set()
        )
    return set().union(*(named_in(part, where) for part in parts))


def names_in_source(folder: str, made_by: str) -> set[str]:
    """First arguments of the calls of a class, and keys of `found`, in the modules of a package."""
    names = set[str]()
    for path in (ROOT / "rotor" / folder).glob("*.py"):
        for node in ast.walk(ast.parse(text(path))):
            match node:
                case ast.Call(func=ast.Name(id=name), args=[ast.Constant(value=str(given)), *_]):
                    if name == made_by:
                        names.add(given)
                case ast.Assign(
                    targets=[
                        ast.Subscript(
                            value=ast.Name(id="found"), slice=ast.Constant(value=str(given))
                        )
                    ]
                ):
                    if path.name == "validity.py":
                        names.add(given)
                case _:
                    pass
    return names


def explained(title: str) -> dict[str, str]:
    """Name and sentence of each item of a section of the page on troubleshooting."""
    section = text(DOCS / "troubleshooting.md").split(f"## {title}\n")[1].split("\n## ")[0]
    return dict(re.findall(r"^- `([\w-]+)`: (.+)$", section, flags=re.MULTILINE))


def test_every_caveat_and_limit_has_its_sentence():
    """By name, as tables have it; and no other name."""
    caveats = names_in_source("trim", "Caveat")
    assert {"stall", "rotor-file", "no-hub-loads", "no-blade-structure"} < caveats
    assert set(explained("Caveats by name")) == caveats
    limits = names_in_source("actuator", "Limit")
    assert {"mass", "fibre-strain", "space", "rotor-speed"} < limits
    assert set(explained("Limits of an actuator by name")) == limits


def test_bounds_of_caveats_are_those_of_the_program():
    sentences = explained("Caveats by name")
    for name, bounds in {
        "twist-beyond-built": [math.degrees(validity.LARGEST_BUILT_TWIST)],
        "nose-up-twist": [math.degrees(validity.NOSE_UP_TWIST)],
        "small-aspect-ratio": [validity.LEAST_ASPECT_RATIO],
        "fast-pitch": [validity.FAST_PITCH],
        "low-speed-inflow": [validity.LOW_SPEED, validity.LOWEST_SPEED],
        "high-speed": [validity.HIGH_SPEED],
        "blade-loading": [validity.HOVER_CAUTION],
        "stall": [100.0 * validity.STALL_SHARE],
    }.items():
        numbers = [float(number) for number in re.findall(r"\d+\.?\d*", sentences[name])]
        for bound in bounds:
            assert any(math.isclose(number, bound) for number in numbers), name


def types_of(one: object) -> set[type]:
    """In the signature of a function; in the fields, properties and methods of a class."""
    found: set[type] = set()
    members = vars(one).items() if inspect.isclass(one) else ()
    for part in (one, *(value for name, value in members if not name.startswith("_"))):
        part = part.fget if isinstance(part, property) else getattr(part, "__func__", part)
        where = inspect.getmodule(part)
        if where is not None and callable(part):
            given = {
                name: value
                for name, value in inspect.get_annotations(part).items()
                if not name.startswith("_")
            }
            found |= set().union(*(named_in(value, where) for value in given.values()))
    return found


def test_each_public_type_has_an_entry():
    entries = {
        name.rpartition(".")[2] for name in re.findall(r"^   ~([\w.]+)$", API, flags=re.MULTILINE)
    }
    public = [
        getattr(module, name)
        for module in (rotor, rotor.actuator, explorer)
        for name in module.__all__
    ]
    described = [one for one in public if inspect.isclass(one) or inspect.isfunction(one)]
    needed = {*described}.union(*map(types_of, described))
    missing = {f"{one.__module__}.{one.__name__}" for one in needed if one.__name__ not in entries}
    assert not missing, "add to docs/reference/api.md: " + ", ".join(sorted(missing))


def names_of_the_page() -> set[str]:
    """What widgets, modes and buttons can be called: whole strings of the page's Python, and texts of its elements."""
    rows = (BY_INPUT | ROWS).values()
    found = {row.title for row in (*rows, *LAWS.values())} | {
        row.slider.label for row in rows if row.slider
    }
    page = ROOT / "explorer"
    for path in (
        page / "page.py",
        *(
            p
            for folder in ("widgets", "model", "charts", "views")
            for p in (page / folder).rglob("*.py")
        ),
    ):
        constants = (
            node.value for node in ast.walk(ast.parse(text(path))) if isinstance(node, ast.Constant)
        )
        found |= {value for value in constants if isinstance(value, str)}
    for path in (*(page / "web").glob("*.html"), *(page / "web").glob("*.js")):
        found |= {name.strip() for name in re.findall(r">([^<>]+)<", text(path))}
    return found


@pytest.mark.parametrize("path", [*TUTORIALS, *GUIDES], ids=lambda path: path.stem)
def test_tutorials_name_sliders_and_buttons_that_exist(path: Path):
    """A word in italics that begins with a capital is the name of a control, letter by letter as the page writes it."""
    plain = re.sub(r"\*\*.*?\*\*|```.*?```", "", text(path), flags=re.DOTALL)
    named = re.findall(r"(?<![*\w])\*([A-ZΔ][^*\n]*)\*(?![*\w])", plain)
    assert set(named) <= names_of_the_page()
    assert len(named) >= (8 if path.stem == "drag" else 0)


PLAIN_WORDS = {
    "mass",
    "altitude",
    "density",
    "thrust",
    "rotor speed",
    "middle",
    "at low speed",
    "flight or test",
}
RATES = {"rate", "inboard", "outboard", "curvature"}


def test_the_glossary_has_the_terms_of_sliders_and_switches():
    labels = {row.slider.label if row.slider else row.title for row in (BY_INPUT | ROWS).values()}
    terms = {
        re.sub(r" \[.*|^Δ | [θ\d].*", "", label).lower().replace("adv. ratio", "advance ratio")
        for label in labels
    }
    terms -= PLAIN_WORDS | RATES | {"inflow in hover", "tip and root loss"}
    words = text(DOCS / "glossary.md").lower().replace("c_t/σ", "ct/σ")
    assert not {term for term in terms if term not in words}


SITE = {
    path
    for path in DOCS.rglob("*.md")
    if path.relative_to(DOCS).parts[0] not in ("_made", "developers")
}
DEVELOPERS = {*(DOCS / "developers").rglob("*.md")}
TOP = tuple(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md"))


def linked(page: Path) -> set[Path]:
    """Files that the words of a page link to. Its hidden table of contents does not count."""
    words = re.sub(r"```\{toctree\}.*?```", "", text(page), flags=re.DOTALL)
    links = re.findall(r"\]\(([^)#\s]+)", words)
    links += [f"{name}.md" for name in re.findall(r"\{doc\}`(?:[^`<]*<)?([^`>]+)", words)]
    return {(page.parent / link).resolve() for link in links if "://" not in link}


@pytest.mark.parametrize(
    "path", sorted({*SITE, *DEVELOPERS, *TOP}), ids=lambda path: str(path.relative_to(ROOT))
)
def test_no_link_is_dead(path: Path):
    made = DOCS / "_made"  # Of the notebooks, when the site is built.
    assert not [
        str(link) for link in linked(path) if not link.exists() and not link.is_relative_to(made)
    ]


def test_what_the_page_on_attacks_names_exists():
    tests = {path.name for path in (ROOT / "tests").rglob("test_*.py")}
    assert not {*re.findall(r"test_\w+\.py", text(DOCS / "developers" / "made.md"))} - tests


LIMITS = (
    "at most 2 MB", "limit for rotor files is 2 MB", "file of 2 MB at most", "a design file 1 MB", "2 MB per second",
    "at most 256 MB", "least 64 MB", "up to 64 MB", "every few seconds", "20 s, own site", "for ten minutes",
    "set by an hour", "within 50 ms", "every 50 ms", "ends after five minutes",
)  # fmt: skip
"""Sizes and times that the code sets, or an attack lasted: no measurements."""
_SIZE = r"\d ?(?:ms|MB|GB)\b|milliseconds|frames a second"
_TIME = r"\d s\b|\b(?:[\d.]+|an?|half an?|some|few|two|three|four|five|ten|several|tenths of a) (?:minutes?|hours?)\b"
STATED = rf"{_SIZE}|{_TIME}|\b(?:[\d.]+|half a|some|few|two|three|several|tenths of a) seconds?\b"
STATED_IN_CODE = rf"{_SIZE}|\b(?:takes?|took)\b[^.\n]{{0,30}}\b(?:seconds?|minutes?)\b"


def test_speed_memory_and_load_are_stated_on_the_page_that_is_measured_alone():
    assert text(measured.PAGE) == measured.page(json.loads(text(measured.DATA))), (
        "make bench ARGS=--page writes it"
    )
    pages = {*SITE, *DEVELOPERS, *TOP} - {
        measured.PAGE,
        *(DOCS / "validation").glob("*"),
        DOCS / "changelog.md",
    }
    pages |= {
        *(DOCS / "notebooks").glob("*.py"),
        *(ROOT / "deploy").glob("*"),
        *(ROOT / "assets/studies").glob("*.toml"),
    }
    pages |= {ROOT / "Makefile"}
    code = {path for name in ("rotor", "explorer") for path in (ROOT / name).rglob("*.py")}
    found = dict[str, list[str]]()
    for paths, pattern in ((pages, STATED), (code, STATED_IN_CODE)):
        for path in sorted(paths):
            words = re.sub("|".join(LIMITS), "", text(path))
            found |= {str(path): said} if (said := re.findall(pattern, words)) else {}
    assert found == {}


OTHERS = {"--find-links", "--no-index", "--tls-ca-file", "--tls-cert", "--tls-key", "--tmpfs"}
"""Flags of pip, Dask and podman that a sentence names."""


def parsers() -> list[OneLineParser]:
    """Of all commands."""
    (commands,) = (
        one for one in build_parser()._actions if isinstance(one, argparse._SubParsersAction)
    )
    page = (explorer.__main__._parser(), report._parser(), blade._parser())
    return typing.cast(list[OneLineParser], [*commands.choices.values(), *page])


def test_every_help_has_examples_with_flags_that_exist():
    for parser in parsers():
        assert parser.examples
        assert len(parser.examples) == 3 or not parser.prog.endswith(" solve")
        for _, words in parser.examples:
            parser.parse_args(shlex.split(words))


ONLY_READ = ("two_segment.toml", "show results", "--port", "--design mine.json", "thesis")
"""Of examples that run for a minute or more, serve the page or need files, only the flags are read."""
SLOW = ("--doubt", "a.json", "MFC_P1")
SHOWN = [
    pytest.param(
        f"{parser.prog} {words}", marks=[pytest.mark.slow] * any(part in words for part in SLOW)
    )
    for parser in parsers()
    for _, words in parser.examples
    if parser.prog.split()[-1] != "warm" and not any(part in words for part in ONLY_READ)
]


@pytest.mark.parametrize("example", SHOWN)
def test_examples_of_the_help_run(example: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """With uniform inflow on a coarse grid."""
    monkeypatch.chdir(tmp_path)
    coarse = partial(rotor.make_design, inflow="uniform", elements=12, azimuths=24)
    monkeypatch.setattr("rotor.command.common.make_design", coarse)
    package, *words = shlex.split(example.removeprefix("python -m "))
    for name in ("a.json", "b.json"):
        rotor.make_design(mu=0.2).save(name)
    assert {"rotor": rotor_main, "explorer": explorer.__main__.main}[package](words) == 0


def test_flags_that_pages_name_exist():
    """In commands of ours, and in sentences where code begins with a flag."""
    known, unknown = (
        {flag for parser in parsers() for flag in parser._option_string_actions}
        | OTHERS
        | {"--help"},
        {},
    )
    for path in sorted({*SITE, *TOP}):
        code = [
            line
            for line in text(path).splitlines()
            if re.search(r"python -m (rotor|explorer) ", line)
        ]
        code += re.findall(r"`--[^`]*`", text(path))
        unknown[path.name] = {*re.findall(r"(?<=[ `(])--[a-z][\w-]*", "\n".join(code))} - known
    assert not {name: given for name, given in unknown.items() if given}


def examples(page: str) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```", page, flags=re.DOTALL | re.MULTILINE)


def test_numbers_of_the_student_theory_are_results():
    """Its lines run in order, and each number behind a # is the value of its line, to the last printed digit."""
    names: dict = {}
    checked = 0
    for code in examples(text(DOCS / "aerodynamics.md")):
        for part in re.split(r"(?<=\n)(?=\S)(?!\))", code):
            exec(part, names)
            stated = re.search(r"  # (-?\d+(?:\.(\d+))?)\b", part)
            if stated:
                expression = part.partition("  # ")[0]
                target = re.match(r"\w+(?= = )", expression)
                value = float(eval(target[0] if target else expression, names))
                assert value == pytest.approx(
                    float(stated[1]), abs=0.6 * 10.0 ** -len(stated[2] or "")
                ), part
                checked += 1
    assert checked >= 30


TASKS = examples(text(DOCS / "guide" / "sweep.md").partition("\n## Three tasks\n")[2])


@pytest.mark.parametrize("code", TASKS, ids=["two rotors", "three segments", "2/rev"])
def test_the_three_tasks(code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """At most twelve lines each, and they do what their heading says."""
    assert len([line for line in code.splitlines() if line]) <= 12
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    exec(code, names)
    if "limits" in names:
        best = names["best"]
        rates = [best.best.parameters[k] for k in range(3)]
        assert np.degrees(min(rates)) >= -20.001
        assert best.saving_percent > 0.5
    else:
        assert all(one.converged for one in names["table"])
        (written,) = tmp_path.glob("*.csv")
        assert len(written.read_text().splitlines()) == len(names["table"]) + 1


@pytest.mark.slow
@pytest.mark.parametrize("path", GUIDES, ids=lambda path: path.stem)
def test_examples_of_the_guides_run(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)
    for code in examples(text(path).partition("\n## Three tasks\n")[0]):
        if "HOST" not in code:  # A cluster of one's own.
            exec(code, {})
