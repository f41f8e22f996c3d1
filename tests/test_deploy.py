"""The service file and the container file: flags that the program has, and a run where nothing is writable."""

import configparser
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from explorer.__main__ import _parser

ROOT = Path(__file__).parent.parent
SERVICE, CONTAINER = ROOT / "deploy/rotor-explorer.service", ROOT / "deploy/Containerfile"


def service() -> dict[str, str]:
    """The values of [Service] by key; the last of a key that stands several times."""
    parser = configparser.ConfigParser(strict=False, interpolation=None)
    parser.optionxform = str  # pyright: ignore[reportAttributeAccessIssue] - keys keep their capitals
    parser.read(SERVICE, encoding="utf-8")
    assert parser.sections() == ["Unit", "Service", "Install"]
    return dict(parser["Service"])


def test_the_service_starts_the_explorer_with_flags_it_has():
    program, *arguments = shlex.split(service()["ExecStart"].replace("%S", "/var/lib"))
    assert program.endswith("/bin/python")
    assert arguments[:2] == ["-m", "explorer"]
    options = _parser().parse_args(arguments[2:])
    assert options.host == "127.0.0.1"
    assert options.allow_host == ["rotor.example"]


def test_the_service_may_write_nowhere_but_to_its_own_folders():
    values = service()
    for key in ("NoNewPrivileges", "PrivateTmp", "PrivateDevices", "ProtectHome", "DynamicUser", "RestrictNamespaces"):
        assert values[key] == "yes", key
    assert values["ProtectSystem"] == "strict"
    assert values["CapabilityBoundingSet"] == ""
    assert "ReadWritePaths" not in values
    assert values["IPAddressDeny"] == "any"
    assert "MemoryDenyWriteExecute" not in values, "compiled kernels are written and executed"
    assert "~@privileged" in values["SystemCallFilter"]


def test_the_container_starts_the_explorer_without_rights():
    text = CONTAINER.read_text(encoding="utf-8")
    entry = json.loads(text.partition("ENTRYPOINT ")[2])
    options = _parser().parse_args(entry[3:])
    assert entry[1:3] == ["-m", "explorer"]
    assert (options.host, options.no_browser) == ("0.0.0.0", True)
    assert re.search(r"^USER 65534", text, re.MULTILINE)
    for name in re.findall(r"-r (\S+)", text):
        assert (ROOT / name).is_file()


@pytest.mark.skipif(shutil.which("systemd-analyze") is None, reason="needs systemd-analyze")
def test_systemd_accepts_the_service_and_finds_it_little_exposed(tmp_path: Path):
    unit = tmp_path / SERVICE.name
    unit.write_text(SERVICE.read_text(encoding="utf-8").replace("/opt/rotor-explorer/bin/python", sys.executable))
    verified = subprocess.run(["systemd-analyze", "verify", unit], capture_output=True, text=True, timeout=60)
    assert (verified.returncode, verified.stderr) == (0, "")
    rated = subprocess.run(
        ["systemd-analyze", "security", "--offline=yes", unit], capture_output=True, text=True, timeout=60
    )
    found = re.search(r"exposure level for \S+: ([\d.]+)", rated.stdout)
    assert found is not None
    assert float(found[1]) < 2.0


_ISOLATED = """
mount -o remount,ro,bind / && {python} -c "
import fcntl, socket, struct
fcntl.ioctl(socket.socket(), 0x8914, struct.pack('16sh', b'lo', 0x41))  # SIOCSIFFLAGS: loopback up and running
" && exec setpriv --no-new-privs --bounding-set=-all --inh-caps=-all env -i {python} {script} 8080
"""


@pytest.mark.slow
def test_runs_with_a_read_only_root_and_without_home_network_and_rights():
    """Compiles its kernels, as no folder can keep them: some 25 s on an idle machine."""
    apart = ["unshare", "-m", "-n", "-p", "-f", "--mount-proc"]
    if not shutil.which("unshare") or subprocess.run([*apart, "true"], capture_output=True).returncode:
        pytest.skip("needs the right to make namespaces")
    script = _ISOLATED.format(python=sys.executable, script=ROOT / "tests/tools/hardened.py")
    done = subprocess.run(
        [*apart, "sh", "-c", script], capture_output=True, text=True, timeout=280, cwd="/", env=dict(os.environ)
    )
    assert done.returncode == 0, done.stderr
    facts = json.loads(done.stdout)
    assert facts["code"] == 0
    assert re.fullmatch(r"(Compiling kernels, once: .*\n)?", facts["errors"])
    assert facts["writable"] == []
    assert facts["home"] is None
    assert re.fullmatch(r"\d+ kW", facts["power"])
