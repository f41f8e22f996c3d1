"""A further kind of actuator is two pieces: a class and its drawing. Here a servo flap, whose numbers are made up."""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

import explorer
import rotor
from explorer.model.actuator_inputs import ActuatorInputs
from explorer.model.inputs import Inputs
from explorer.picture.actuator_drawings import (
    DRAWINGS,
    BladePart,
    Drawing,
    PieceStyle,
    side_line,
    stations,
)
from explorer.picture.lifted_picture import lifted_picture
from explorer.views.actuator import ACTUATOR, actuator_titles
from explorer.views.line import line_text
from rotor import Rotor
from rotor.__main__ import main
from rotor.actuator import catalogue
from rotor.actuator.kind import Actuator, InstalledActuator, MassBreakdown
from rotor.actuator.section import Placement
from rotor.actuator.tables import table_5_1
from rotor.support.arrays import Array
from rotor.support.assets import toml_asset
from tests.actuate import actuate, asked

ROW = {
    "id": "servo_flap", "name": "Servo flap", "moment_nm": 300.0, "mass_kg": 25.0,
    "temperature_min_c": -40.0, "temperature_max_c": 100.0,
    "recalled": [], "assumed": ["moment_nm"], "readiness": 1, "tested": "none", "source": "this test",
}  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class ServoFlap(Actuator):
    moment: float
    mass: float

    noun, drive_noun, drive_unit = ("flap", "flaps"), "deflection", "°"

    @property
    def drive_range(self) -> tuple[float, float]:
        return -5.0, 5.0

    @property
    def mode(self) -> str:
        return f"servos, {self.moment:.0f} N·m"

    def moments(
        self, moment: float, compliance: Array, lengths: Array, placement: Placement
    ) -> Array:
        return np.full(len(lengths), placement.plies * self.moment)

    def masses(
        self, placement: Placement, blades: int, skin_area: float, length: float
    ) -> MassBreakdown:
        return MassBreakdown(blades, placement.plies * self.mass)


def flap(installed: InstalledActuator, blade: Rotor) -> list[BladePart]:
    r = stations(installed.placement.span, 10)
    lower = np.stack([side_line(blade, float(at), "lower", (0.85, 1.0), 5) for at in r])
    return [BladePart("driven", 0, r, lower - [0.0, 0.01], lower)]


@pytest.fixture(autouse=True)
def flaps(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.setitem(catalogue.KINDS, "servo_flap", ServoFlap)
    monkeypatch.setitem(toml_asset("actuators.toml"), "servo_flap", [ROW])
    monkeypatch.setitem(DRAWINGS, ServoFlap, Drawing(flap, PieceStyle((1, 2, 3)), None))
    catalogue.actuators.cache_clear()
    yield
    catalogue.actuators.cache_clear()


INPUTS = Inputs(advance_ratio=0.2, elements=12, azimuths=24)
FLAPS = ActuatorInputs(actuator="servo_flap", plies=2, drives=(40.0,) * 5)


def test_two_pieces_serve_command_tables_form_verdict_and_picture(
    capsys: pytest.CaptureFixture[str],
):
    """By hand: 40 % of 5° is 2°; four blades with two flaps of 25 kg each gain 200 kg."""
    assert (
        main(
            [
                "actuator",
                "--actuator",
                "servo_flap",
                "--json",
                "--elements",
                "12",
                "--azimuths",
                "24",
            ]
        )
        == 0
    )
    record = json.loads(capsys.readouterr().out)
    assert (record["actuator"], record["added_mass_kg"], record["voltages_v"]) == (
        "servo_flap",
        200.0,
        [],
    )
    assert "so this flap does not pay" in record["message"]
    assert {"temperature", "mass"} <= {limit["name"] for limit in record["limits"]}
    assert "Servo flap: assumed values: moment." in record["caveats"]
    row = dict(zip(table_5_1().columns, table_5_1().rows[-1], strict=True))
    assert (row["actuator"], row["mode"], row["voltage V"]) == (
        "servo_flap",
        "servos, 300 N·m",
        "–",
    )

    now = actuate(INPUTS, actuator=FLAPS)
    shown = ACTUATOR.view(now)
    form = shown["actuator.form"]
    assert actuator_titles()["servo_flap"] == "servo flap: servos, 300 N·m"
    assert (form.labels["plies"], form.labels["drive 0"]) == ("Flaps", "Deflection [%]")
    assert [name for name in ("plies", "span", "chord", "crossed") if form.seen[name]] == [
        "plies",
        "span",
    ]
    assert "5 °" in shown["actuator.bar"]
    assert "tip twist at +2 °" in shown["actuator.now"]
    verdict = asked(ACTUATOR, now)["lean_verdict"].run()
    assert " with servo flap at 40\u00a0% " in line_text(now)

    picture = lifted_picture(FLAPS, verdict.installed, INPUTS.design())
    assert picture.solids["drive_0"].surface.colour == (1, 2, 3)
    assert "box" not in picture.solids  # It has no electronics.
    assert "200 kg of flaps, +2 °" in [text for _, text, _ in picture.labels]


def test_its_twist_is_that_of_a_tube_of_the_same_moment():
    """At rest, twist over moment is the compliance of the blade, whatever moves it."""
    tubes, flaps = (
        ActuatorInputs(actuator=id).installed(INPUTS.design().rotor)
        for id in ("SMA_tube", "servo_flap")
    )
    assert flaps.moment == 600.0
    assert_allclose(flaps.rest_shapes / 600.0, tubes.rest_shapes / tubes.moment, rtol=1e-9)


def test_kinds_are_named_only_where_they_are_made_listed_and_drawn():
    """Elsewhere they answer for themselves: a further kind touches no other file."""
    own = {"ply.py", "tube.py", "laminate.py"}
    # The last: chapter 5 is on plies.
    listed = {
        "catalogue.py",
        "__init__.py",
        "actuator_drawings.py",
        "actuation.py",
    }
    for package in (rotor, explorer):
        for path in Path(str(package.__file__)).parent.rglob("*.py"):
            if any(
                kind in path.read_text(encoding="utf-8")
                for kind in ("PiezoPly", "TorqueTube", "ExtensionTwist")
            ):
                assert path.name in own | listed, path
