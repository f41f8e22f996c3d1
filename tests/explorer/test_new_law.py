"""A further twist law is one class and one row of a table: here a cubic, in a copy of the two files alone."""

import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]
ADDED = {
    "design/twist.py": {
        "LAWS = {": '''@dataclass(frozen=True)
class CubicTwist(SpecTwist):
    """θ_tw = a (r³ − r) + D r + c."""

    kind, form, example, noun = "cubic", "A,D", "5,-14", "cubic"
    coefficient: float
    difference: float

    def __call__(self, r):
        return np.tensordot(np.array(self.values), self.slopes(np.asarray(r, dtype=float)), 1)

    def slopes(self, r):
        line = r - REFERENCE_RADIUS
        return np.stack([r**3 - REFERENCE_RADIUS**3 - line, line])


''',
        "        TableTwist,\n        IdealTwist,\n": "        CubicTwist,\n",
    },
    "optimisation/concepts.py": {
        "    LinearTwist,\n": "    CubicTwist,\n",
        "        _two_segment(DIVISION),": """        Concept(
            "cubic", "Cubic", "A cubic: its coefficient, and the twist from root to tip.", CubicTwist,
            (
                Parameter(  # θ' = a (3 r² − 1) + D.
                    "coefficient", "Coefficient", "rad/R³", -0.5, 0.5, Handle("bend"), (-1.0, 2.0), 5.0,
                    "Third-order coefficient.",
                ),
                Parameter(
                    "difference", "Root to tip", "rad", STEEPEST, FLATTEST, Handle("tilt"), (1.0, 1.0), -14.0,
                    "Twist at the tip.",
                ),
            ),
            "cubic",
        ),
""",
    },
}
"""By file: what stands before a text of it."""
HELD_BY_OTHER_TESTS = (
    "rotor/optimisation/test_concepts.py", "explorer/test_sensitivity.py", "explorer/test_grab.py",
    "explorer/test_server.py", "explorer/test_optimise.py",
)  # fmt: skip
"""They go through every law of the tables: slopes, rates, sliders, menu, power per step, drag, sketch."""
TEST = '''
import numpy as np
import pytest
from rotor import load_design, make_design, optimise
from rotor.optimisation.descent import TOLERANCE
from rotor.__main__ import main
from explorer.model.inputs import LAWS, ROWS, Inputs, inputs_of
from explorer.model.undo import History
from explorer.sharing.share import code_of, inputs_from
from explorer.text.design_words import twist_name
from explorer.text.glossary import hint

DESIGN = make_design(mu=0.2, twist="cubic:5,-14", inflow="drees", elements=12, azimuths=24)


def test_spec_file_and_command_of_a_cubic(tmp_path, capsys):
    """By hand: −14° root to tip; halfway 5 (0.125 − 0.5) = −1.875° below the chord."""
    root, middle, tip = np.degrees(DESIGN.twist(np.array([0.0, 0.5, 1.0])))
    assert [tip - root, middle - 0.5 * (root + tip)] == pytest.approx([-14.0, -1.875])
    assert DESIGN.twist.spec() == "cubic:5,-14"
    DESIGN.save(tmp_path / "cubic.json")
    assert load_design(tmp_path / "cubic.json") == DESIGN
    assert main(["solve", "--twist", "uh60a+cubic:5,-1", "--hover", "--save", str(tmp_path / "sum.json")]) == 0
    assert load_design(tmp_path / "sum.json").twist.spec() == "uh60a+cubic:5,-1"
    with pytest.raises(SystemExit):
        main(["solve", "--help"])
    assert "cubic:A,D" in capsys.readouterr().out
    with pytest.raises(ValueError, match="needs 2 numbers: write cubic:A,D, for example cubic:5,-14"):
        make_design(twist="cubic:5")


def test_the_best_cubic_needs_no_more_than_the_best_line():
    cubic, line = (optimise(DESIGN, name, starts=1).best for name in ("cubic", "linear"))
    assert cubic.twist.startswith("cubic:")
    # Each search ends where it foresees less than this part of the power.
    assert cubic.power <= line.power * (1.0 + 2.0 * TOLERANCE["total"])


def test_menu_sliders_link_and_undo_of_a_cubic():
    assert LAWS["cubic"].title == "Cubic"
    labels = [ROWS[name].slider.label for name in LAWS["cubic"].inputs]
    assert labels == ["Coefficient [°/R³]", "Root to tip [°]"]
    assert hint("cubic_coefficient") == "Third-order coefficient."
    inputs = Inputs(law="cubic", cubic_coefficient=-3.5, cubic_difference=-9.0)
    design = inputs.design()
    assert design.twist.spec() == "cubic:-3.5,-9"
    assert inputs_of(design).law == "cubic"
    assert inputs_from(code_of(design)).design() == design
    assert twist_name(design).startswith("cubic, ")
    history = History(Inputs(law="cubic"))
    for value in (-1.0, -2.0, -3.5):
        history.note(Inputs(law="cubic", cubic_coefficient=value), pause=0.1)
    assert history.undo() == Inputs(law="cubic")
'''


def test_a_cubic_is_a_class_and_a_row(tmp_path: Path):
    for entry in (*ROOT.iterdir(), *(ROOT / "rotor").iterdir()):
        place = tmp_path / entry.relative_to(ROOT)
        if entry.name == "rotor":
            place.mkdir()
        elif entry.name in ("design", "optimisation"):
            shutil.copytree(entry, place)
        elif entry.name not in (".git", ".venv"):
            place.symlink_to(entry)  # With its compiled kernels.
    for name, added in ADDED.items():
        file = tmp_path / "rotor" / name
        text = file.read_text(encoding="utf-8")
        for before, words in added.items():
            assert text.count(before) == 1
            text = text.replace(before, words + before)
        file.write_text(text, encoding="utf-8")
    (tmp_path / "test_cubic.py").write_text(TEST, encoding="utf-8")
    command = shlex.split("-m pytest -q -n 0 -p no:cacheprovider -k cubic test_cubic.py")
    tests = [f"tests/{name}" for name in HELD_BY_OTHER_TESTS]
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    words = [sys.executable, *command, *tests]
    done = subprocess.run(
        words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
