"""`python -m rotor airfoil`."""

import argparse
import json
import re

import pytest
from numpy.testing import assert_allclose

from rotor.command import airfoil as command


def run(*words: str) -> int:
    parser = argparse.ArgumentParser()
    command.add_parser(parser.add_subparsers())
    args = parser.parse_args(["airfoil", *words])
    return args.run(args)


def test_show_as_table_and_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("show", "sc1095", "--mach", "0.7", "--alpha", "4", "--json") == 0
    point = json.loads(capsys.readouterr().out)
    assert list(point) == ["cl", "cd", "cm"]
    assert_allclose([point["cl"], point["cd"], point["cm"]], [0.72, 0.036, 0.001], atol=0.06)  # The C81 deck.
    assert run("show", "sc1095-thesis", "--mach", "0.3", "--alpha", "4", "--json") == 0
    assert json.loads(capsys.readouterr().out)["cm"] is None
    with pytest.raises(ValueError, match="needs both --mach and --alpha"):
        run("show", "sc1095", "--mach", "0.7")
    assert run("show", "sc1094r8", "--json") == 0
    answer = json.loads(capsys.readouterr().out)
    assert answer["incidence_offset_deg"] == 1.0
    k = answer["mach"].index(0.3)
    assert_allclose(answer["cl_alpha_per_deg"][k], 0.1104, rtol=0.01)  # McCroskey's, as in the data tests
    assert_allclose(answer["cm_at_0_deg"][k], -0.0236, atol=1e-3)
    for name in ("sc1095", "sc1095-thesis"):
        assert run("show", name) == 0
        text = capsys.readouterr().out
        assert "nan" not in text
        assert len(text.splitlines()) == 13


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("show", "vr12"), "no section named 'vr12': choose one of sc1095"),
        (("build", "sc1095"), "run `python -m tests.tools.sections build sc1095`"),
    ],
)
def test_bad_input_names_value_and_remedy(words: tuple[str, ...], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        run(*words)
