"""`explorer.show`: the page started from Python."""

import sys
import types
import webbrowser
from urllib.parse import urlsplit

import pytest

import explorer
import rotor
from explorer import notebook
from explorer.model.actuator_inputs import inputs_from_spec
from explorer.sharing.share import CARRIED, parameter


class FakeApp:
    """Stands for the server: what it was started with, and how often it was stopped."""

    made: "list[FakeApp]" = []  # noqa: RUF012 - emptied by the fixture

    def __init__(self, host, port, start, limits) -> None:
        self.host, self.port, self.start, self.limits = host, port, start, limits
        self.address, self.stops = f"http://{host}:8765", 0
        self.made.append(self)

    def stop(self) -> None:
        self.stops += 1


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Addresses that a browser was asked to open; no server starts."""
    addresses: list[str] = []
    FakeApp.made.clear()
    monkeypatch.setattr(notebook, "App", FakeApp)
    monkeypatch.setattr(webbrowser, "open", addresses.append)
    monkeypatch.delitem(sys.modules, "ipykernel", raising=False)
    return addresses


@pytest.mark.parametrize("key", ["uh60a", "s61"])
def test_the_page_starts_on_the_design(opened: list[str], key: str):
    design = rotor.make_design(
        rotor=key, twist="segments:-12,-4@0.5", mu=0.25, mass_kg=8000, altitude_m=500
    )
    page = explorer.show(design)
    (app,) = FakeApp.made
    assert app.start.design() == design
    assert app.host == "127.0.0.1"
    assert opened == [page.address]
    page.stop()


def test_the_page_starts_with_the_actuator_on_board(opened: list[str]):
    design = rotor.with_actuator(rotor.make_design(mu=0.25), "MFC_P1,drive=77")
    explorer.show(design).stop()
    (app,), (address,) = FakeApp.made, opened
    spec = parameter(urlsplit(address).query, CARRIED)
    assert spec is not None
    assert inputs_from_spec(spec).apply(app.start.design()) == design
    assert notebook.proxied_path(address).endswith(f"proxy/8765/?{urlsplit(address).query}")


def test_in_jupyter_the_page_is_inline(opened: list[str], monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setitem(sys.modules, "ipykernel", types.ModuleType("ipykernel"))
    page = explorer.show(rotor.make_design())
    assert opened == []
    assert f'<iframe src="{page.address}"' in page._repr_html_()
    assert "http://localhost:*" in FakeApp.made[0].limits.frame_ancestors
    page.stop()
    assert "<iframe" not in page._repr_html_()


def test_on_jupyterhub_a_sentence_says_how_the_page_is_reached(
    opened: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    """The browser is on another machine, where a frame would stay empty."""
    monkeypatch.setitem(sys.modules, "ipykernel", types.ModuleType("ipykernel"))
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/ann/")
    page = explorer.show(rotor.make_design())
    for said in (capsys.readouterr().out, page._repr_html_()):
        assert "ssh -L 8765:127.0.0.1:8765" in said
        assert "iframe" not in said
    page.stop()


@pytest.mark.parametrize("named", ["hub.example", "https://hub.example/hub/home"])
def test_on_a_jupyterhub_that_is_named_the_page_is_inline_by_its_path(
    named: str,
    opened: list[str],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
):
    """As jupyter-server-proxy passes it on; a path is of the hub's own origin, so the frame is allowed."""
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/ann/")
    page = explorer.show(rotor.make_design(), hub=named)
    assert opened == []
    assert '<iframe src="/user/ann/proxy/8765/"' in page._repr_html_()
    assert FakeApp.made[0].limits.allow_hosts == ("hub.example",)
    assert capsys.readouterr().out == ""
    page.stop()
    with pytest.raises(ValueError, match="is not a host name"):
        explorer.show(rotor.make_design(), hub="a@b")
