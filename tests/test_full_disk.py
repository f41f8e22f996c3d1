"""Nothing that is written is half written: full disks, whatever the command."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import rotor

ROOT = Path(__file__).parent.parent
LIMITED = """
import resource, signal, sys
package, most, *arguments = sys.argv[1:]
if package == "save":
    import rotor
    def main(given): rotor.make_design().save(given[0])
else:
    main = __import__(package + ".__main__", fromlist=["main"]).main
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (int(most), int(most)))
sys.exit(main(arguments))
"""
STUDY = 'title = "small"\n[axes]\nmu = [0.1, 0.2]\n[fixed]\ntwist = "linear:-8"\n'
COMMANDS = {
    "sweep": ("rotor", "sweep", "--mu", "0.1:0.2:0.1", "--csv", "OUT/out.file"),
    "schedule": (
        "rotor",
        "schedule",
        "--concept",
        "linear",
        "--mu",
        "0.1,0.2",
        "--csv",
        "OUT/out.file",
    ),
    "report": ("explorer", "report", "IN/a.json", "--out", "OUT/out.html"),
    "blade": ("explorer", "blade", "--out", "OUT/blade"),
    "study": ("rotor", "study", "IN/small.toml", "--workers", "1", "--out", "OUT/study"),
    "reproduce": ("rotor", "reproduce", "OUT/blade", "--figure", "table 5.1"),
    "save": ("save", "OUT/out.json"),
}


def limited(name: str, most: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """The command in a process that cannot write a file of more than `most` bytes."""
    package, *arguments = COMMANDS[name]
    (folder / "in").mkdir(exist_ok=True)
    rotor.make_design(twist="linear:-8").save(folder / "in" / "a.json")
    (folder / "in" / "small.toml").write_text(STUDY, encoding="utf-8")
    given = [
        word.replace("OUT", str(folder / "out")).replace("IN", str(folder / "in"))
        for word in arguments
    ]
    return subprocess.run(
        [sys.executable, "-c", LIMITED, package, most, *given],
        cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, timeout=600,
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="this system has no limit on files")
@pytest.mark.parametrize("name", COMMANDS)
def test_on_a_full_disk_a_command_ends_with_a_sentence_and_what_was_there_stays(
    name: str, tmp_path: Path
):
    """A limit of 100 bytes a file stands for the disk: the write that exceeds it fails as one without room does."""
    (tmp_path / "out").mkdir()
    there = [tmp_path / "out" / file for file in ("out.file", "out.html", "out.json")]
    for file in there:
        file.write_text("precious", encoding="utf-8")
    done = limited(name, "100", tmp_path)
    assert [file.read_text(encoding="utf-8") for file in there] == ["precious"] * 3
    assert not list((tmp_path / "out").rglob("*.part"))
    assert not list((tmp_path / "out").glob("blade/*"))
    if name == "save":  # A function of Python's own kind of error.
        assert "OSError" in done.stderr
        return
    assert done.returncode in (1, 2)
    assert done.stderr.count("\n") == 1, done.stderr
    assert "File too large" in done.stderr
