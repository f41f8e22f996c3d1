"""What several tests of the solver share."""

import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from patched import Patch, patching

from rotor import make_design
from rotor.__main__ import main
from rotor.aero.lifting_line import WakeCourse
from rotor.aero.problem import build_problem
from rotor.engine.linearise import Point
from rotor.engine.newton import Factors
from rotor.trim import forward


@pytest.fixture
def evaluated(monkeypatch: pytest.MonkeyPatch) -> list[Factors]:
    """Every evaluation of derivatives from here on."""
    made, of = list[Factors](), Factors.of

    def counted(point: Point) -> Factors:
        made.append(of(point))
        return made[-1]

    monkeypatch.setattr(Factors, "of", counted)
    return made


@pytest.fixture
def patch() -> Iterator[Patch]:
    """For what cached functions read: every cache is emptied with each change, and at the end."""
    with patching() as patch:
        yield patch


@pytest.fixture
def same_course(patch: Patch) -> WakeCourse:
    """The course of every wake of a lifting line: that of the UH-60A at µ = 0.2."""
    course = forward.with_course(build_problem(make_design(mu=0.2))).course
    patch("rotor.trim.forward.found_course", lambda design: course)
    return course


@pytest.fixture
def printed(capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """What a command prints that ends with this code, and says nothing on stderr."""

    def run(*words: str, code: int = 0) -> str:
        assert main(list(words)) == code
        out, err = capsys.readouterr()
        assert err == ""
        return out

    return run


@pytest.fixture
def answer(printed: Callable[..., str]) -> Callable[..., Any]:
    """Its JSON, which has no NaN."""

    def strange(name: str) -> None:
        pytest.fail(f"{name} in JSON")

    return lambda *words, code=0: json.loads(
        printed(*words, "--json", code=code), parse_constant=strange
    )


@pytest.fixture
def refused(capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """The sentence of a command that cannot be done: one line, and exit code 2."""

    def run(*words: str) -> str:
        code, (out, err) = main(list(words)), capsys.readouterr()
        assert (code, out, err.count("\n"), err.partition(" ")[0]) == (2, "", 1, "rotor:")
        return err

    return run
