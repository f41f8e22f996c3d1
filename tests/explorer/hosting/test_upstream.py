"""Patches for viser: each applies to the source that is installed; those in Python mend a fault that shows there.

When a fault is no longer there, this viser has mended it: drop the patch and our own change in `viser_compat.py`.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import viser

FOLDER = Path(__file__).parents[3] / "docs" / "developers" / "upstream"
INSTALLED = Path(viser.__file__).parent
FAULTS = r"""
import asyncio, contextlib, io, json, logging, sys, threading
from concurrent.futures import Future
from types import SimpleNamespace
import viser
from viser import _assignable_props_api, _messages, _threadpool_exceptions
from viser.infra._async_message_buffer import AsyncMessageBuffer

faults = []


async def events():
    '''A thread ends what waits on the loop, while the loop may change the list of what waits.'''
    buffer = AsyncMessageBuffer(asyncio.get_running_loop(), persistent_messages=False)
    waiting = asyncio.ensure_future(buffer.message_event.wait())
    await asyncio.sleep(0)
    (waiter,) = buffer.message_event._waiters
    thread = threading.Thread(target=buffer.push, args=(_messages.RunJavascriptMessage("x"),))
    thread.start()
    thread.join()
    if waiter.done():
        faults.append("events")
    await asyncio.wait_for(waiting, 60.0)


asyncio.run(events())

handle = object.__new__(_assignable_props_api.AssignablePropsBase)
made = []
kept = _assignable_props_api.npt
_assignable_props_api.npt = SimpleNamespace(NDArray=type("Count", (), {"__getitem__": lambda s, k: made.append(k)})())
assert handle._cast_value_recursive(str, "text", "content") == "text"
_assignable_props_api.npt = kept
if made:  # Types of arrays, to compare with that of a text.
    faults.append("cast")

printed = io.StringIO()
with contextlib.redirect_stdout(printed):
    server = viser.ViserServer("127.0.0.1", 0, verbose=False)
if printed.getvalue():
    faults.append("banner")

slider = server.gui.add_slider("x", 0.0, 1.0, 0.1, 0.5)


def update(**updates):
    message = _messages.GuiUpdateMessage(uuid=slider._impl.uuid, updates=updates)
    asyncio.run(server.gui._handle_gui_updates(0, message))


update(value=0.7)
assert slider.value == 0.7
update(is_button=True)
if slider._impl.is_button:
    faults.append("updates")
server.stop()

records = []
handler = logging.Handler()
handler.emit = records.append
logging.getLogger().addHandler(handler)
failed = Future()
failed.set_exception(ZeroDivisionError("one over nothing"))
with contextlib.redirect_stderr(io.StringIO()):
    _threadpool_exceptions.print_threadpool_errors(failed)
if not records:
    faults.append("callbacks")
print(json.dumps(sorted(faults)), file=sys.__stderr__)
"""
SHOWN = ["banner", "callbacks", "cast", "events", "updates"]
IN_THE_CLIENT = {"edits", "retry", "visible"}
"""TypeScript, which only viser's own build compiles: what they mend, `tests/browser/test_viser_client.py` and
`test_reconnect.py` hold for our own change."""


@pytest.fixture(scope="module")
def patched(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of viser's source with all patches."""
    copy = tmp_path_factory.mktemp("viser") / "viser"
    shutil.copytree(INSTALLED, copy, ignore=shutil.ignore_patterns("build", "__pycache__"))
    shutil.copytree(INSTALLED / "client" / "build", copy / "client" / "build")
    for patch in sorted(FOLDER.glob("*.patch")):
        subprocess.run(["git", "apply", "-p3", str(patch)], cwd=copy, check=True)
    return copy


def faults(folder: Path) -> list[str]:
    """What is wrong with the viser in a folder."""
    done = subprocess.run(
        [sys.executable, "-c", FAULTS],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
        env={**os.environ, "PYTHONPATH": str(folder)},
    )
    return json.loads(done.stderr.splitlines()[-1])


def test_each_patch_mends_a_fault_of_the_viser_that_is_installed(patched: Path):
    assert {path.stem.removeprefix("viser-") for path in FOLDER.glob("*.patch")} == {*SHOWN, *IN_THE_CLIENT}
    assert faults(INSTALLED.parent) == SHOWN
    assert faults(patched.parent) == []
    client = "client/src/WebsocketInterface.tsx"
    assert "document.hasFocus" in (INSTALLED / client).read_text(encoding="utf-8")
    assert "document.hasFocus" not in (patched / client).read_text(encoding="utf-8")
