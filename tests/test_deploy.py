"""The service file and the container file: flags that the program has, and a run where nothing is writable."""

import configparser
import json
import re
import shlex
from pathlib import Path

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


def test_the_container_starts_the_explorer_without_rights():
    text = CONTAINER.read_text(encoding="utf-8")
    entry = json.loads(text.partition("ENTRYPOINT ")[2])
    options = _parser().parse_args(entry[3:])
    assert entry[1:3] == ["-m", "explorer"]
    assert (options.host, options.no_browser) == ("0.0.0.0", True)
    assert re.search(r"^USER 65534", text, re.MULTILINE)
    for name in re.findall(r"-r (\S+)", text):
        assert (ROOT / name).is_file()
