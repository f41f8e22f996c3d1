"""The server without a browser: start, addresses, errors in one sentence, private names of viser."""

import re
import signal
import socket
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import viser

from explorer import __main__ as command
from explorer.colours import LIGHT
from explorer.model.inputs import FLIGHT, LAWS, NOT_ALWAYS, Inputs, ViewState, with_optimum
from explorer.model.sliders import SLIDERS
from explorer.model.units import SI
from explorer.picture.picture import make_picture
from explorer.scene.scene import Scene
from explorer.widgets.controls import DesignControls
from rotor.files.make_design import make_design, uh60a_rotor
from rotor.optimisation.concepts import CONCEPTS
from rotor.trim.solve import solve

ROOT = Path(__file__).parent.parent.parent


class TestCommand:
    def test_busy_port_exits_2_with_one_line(self, capsys: pytest.CaptureFixture[str]):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))
            taken.listen()
            port = taken.getsockname()[1]
            assert command.main(["--port", str(port), "--no-browser"]) == 2
        error = capsys.readouterr().err
        assert error.count("\n") == 1
        assert re.search(
            rf"127\.0\.0\.1:{port} cannot be used .*: choose another with --port", error
        )

    def test_missing_design_exits_2_with_one_line(
        self, capsys: pytest.CaptureFixture[str], tmp_path: Path
    ):
        assert command.main(["--design", str(tmp_path / "none.json"), "--no-browser"]) == 2
        error = capsys.readouterr().err
        assert error.count("\n") == 1
        assert "none.json" in error

    @pytest.mark.parametrize("port", ["x", "-1", "70000"])
    def test_a_port_that_is_none_is_refused(self, port: str, capsys: pytest.CaptureFixture[str]):
        assert command.main(["--port", port]) == 2
        assert "is not a port" in capsys.readouterr().err

    @pytest.mark.parametrize(("host", "lines"), [("127.0.0.1", 0), ("0.0.0.0", 2)])
    def test_who_opens_the_server_to_others_is_warned(
        self,
        host: str,
        lines: int,
        monkeypatch: pytest.MonkeyPatch,
        capsys: pytest.CaptureFixture[str],
    ):
        class Started:
            address = "http://somewhere"

            def __init__(self, *_: object) -> None: ...

            def wait_until_warm(self) -> None:
                raise KeyboardInterrupt

            def stop(self) -> None: ...

        monkeypatch.setattr("explorer.app.App", Started)
        monkeypatch.setattr(signal, "signal", lambda *_: None)
        assert command.main(["--host", host, "--no-browser"]) == 0
        said = capsys.readouterr()
        assert said.err.count("\n") == lines
        assert ("reverse proxy" in said.err) == (lines > 0)

    @pytest.mark.slow
    def test_prints_its_address_and_ends_cleanly_on_interrupt(self):
        process = subprocess.Popen(
            [sys.executable, "-m", "explorer", "--port", "0", "--no-browser"],
            cwd=ROOT,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            # Tests that run in the background ignore the interrupt, and would hand that on.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )
        try:
            printed = ""
            while "http://127.0.0.1:" not in printed.partition("Rotor explorer")[2]:
                line = process.stdout.readline()
                assert line, "ended without printing its address"
                printed += line
            process.send_signal(signal.SIGINT)
            _, error = process.communicate(timeout=60)
        finally:
            process.kill()
        assert process.returncode == 0
        assert "Traceback" not in error


class TestControls:
    @pytest.mark.parametrize("law", [law for law in LAWS if law not in NOT_ALWAYS])
    def test_inputs_go_through_the_widgets_unchanged(self, controls: DesignControls, law: str):
        wanted = Inputs(
            law=law, advance_ratio=0.31, mass_t=9.1, altitude_m=1500.0, linear=-7.5, flapping=False
        )
        controls.set_inputs(wanted)
        assert controls.inputs() == wanted

    def test_a_hand_on_a_slider_goes_on_from_the_search_that_it_shows(
        self, controls: DesignControls
    ):
        own, found = Inputs(law="linear"), Inputs(law="two", two_inner=-12.0, two_outer=-5.0)
        controls.set_inputs(own)
        controls.follow(found)
        assert controls.inputs() == own  # Until it is applied.
        controls.follow(None)
        assert controls.form["law"] == "linear"
        controls.follow(found)
        controls.form.place("two_inner", -11.0)
        controls.form._moved("two_inner", True)
        assert controls.inputs() == replace(found, two_inner=-11.0)
        controls.follow(None)  # There is no preview of another design.
        assert controls.inputs() == replace(found, two_inner=-11.0)

    def test_an_optimum_that_no_law_holds_joins_the_menu(self, controls: DesignControls):
        design = CONCEPTS["free-form"].apply(make_design(), [0.2, 0.1, 0.05, 0.03, -0.03, -0.06])
        wanted = with_optimum(Inputs(mass_t=9.0), design)
        controls.set_inputs(wanted)
        assert controls.inputs() == wanted
        assert controls.inputs().design().twist == design.twist
        controls.set_inputs(Inputs())
        assert controls.inputs().design() == Inputs().design()

    @pytest.mark.parametrize("name", CONCEPTS)
    def test_an_optimum_on_the_sliders_means_the_same_blade(self, name: str):
        concept = CONCEPTS[name]
        middle = [0.6 * p.low + 0.4 * p.high for p in concept.parameters]
        design = concept.apply(make_design(), middle)
        applied = with_optimum(Inputs(), design).design()
        assert applied.rotor == design.rotor
        r = np.linspace(0.13, 1.0, 50)
        np.testing.assert_allclose(applied.twist(r), design.twist(r), atol=2e-6)

    def test_the_break_point_is_shown_where_it_has_an_effect(self, controls: DesignControls):
        place, built = controls.form._handles["built_division"], Inputs(law="builtin")
        changed, moved = replace(built, built_outer=-1.0), replace(built, built_division=0.7)
        assert built.design().twist == moved.design().twist  # It has no effect indeed.
        for inputs, shown in ((built, False), (changed, True), (built, False)):
            controls.refresh(inputs, SI)
            assert place.visible is shown

    def test_only_the_sliders_of_the_law_show(self, controls: DesignControls):
        def shown(inputs: Inputs) -> set[str]:
            controls.refresh(inputs, SI)
            return {name for name in SLIDERS if controls.form._handles[name].visible}

        law = {"two_inner", "two_outer", "two_division"}
        assert shown(Inputs(law="two")) == {*law, "advance_ratio", "mass_t"}
        assert shown(Inputs(law="two", climb_m_s=2.0)) == {
            *law,
            "advance_ratio",
            "mass_t",
            "climb_m_s",
        }
        controls._show_more("on")
        assert shown(Inputs(law="two")) == {*law, *FLIGHT}
        assert "climb_m_s" not in shown(Inputs(preset="thesis", law="two"))


class TestScene:
    def test_another_rotor_fits_into_the_same_handles(self, server: viser.ViserServer):
        scene = Scene(server.scene, uh60a_rotor("flight"), LIGHT)
        handles = dict(server.scene._handle_from_node_name)
        solution = solve(make_design(rotor="r22"))
        for shown in (
            solve(make_design(mu=0.0)),
            solve(make_design(preset="thesis", mu=0.2)),
            solution,
        ):
            scene.fit(shown.design)
            scene.show(make_picture(shown, ViewState()))
        assert dict(server.scene._handle_from_node_name) == handles
        assert [blade.visible for blade in scene.rotor._blades] == [True, True, False, False]
        reach = np.abs(scene._body.vertices).max()
        assert reach < 1.5 * solution.design.rotor.radius
