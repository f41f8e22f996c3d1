"""Kernels run wherever they are installed: without a writable folder, on a full disk, with damaged files."""

import errno
import importlib.util
import io
import os
import re
import sys
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any

import pytest
from numba.core import caching, config

import rotor
from rotor.__main__ import main
from rotor.command.warm import compile_lags
from rotor.engine.linearise import jacobian
from rotor.support import compiled
from rotor.support.compiled import (
    _watch,
    compiled_in_parallel,
    compiling,
    log_compiling,
    why_not_kept,
)
from rotor.trim.analysis import power_gradient
from rotor.trim.solve import analyse, solve

SOURCE = """
import numba
from rotor.support.compiled import compiled

@compiled(error_model="numpy")
def kernel(x):
    return x + 1.0
"""


def module(path: Path) -> Any:
    """The module in a file, imported anew."""
    spec = importlib.util.spec_from_file_location("kernels_of_a_test", path)
    assert spec is not None
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


@pytest.fixture(autouse=True)
def _kept_beside_the_source(monkeypatch: pytest.MonkeyPatch):
    """Also where `NUMBA_CACHE_DIR` names a folder for all."""
    monkeypatch.setattr(config, "CACHE_DIR", "")
    monkeypatch.setattr(_watch, "unkept", False)
    monkeypatch.setattr(_watch, "began", False)


@pytest.fixture
def source(tmp_path: Path) -> Path:
    path = tmp_path / "kernels.py"
    path.write_text(SOURCE, encoding="utf-8")
    return path


def hits(kernel: Any) -> int:
    """How often compiled code was read from disk."""
    return sum(kernel.stats.cache_hits.values())


@pytest.fixture
def two(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    """A module with a function, and one with a kernel that calls it."""
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "called_by_a_test", raising=False)
    monkeypatch.setattr(sys, "dont_write_bytecode", True)  # Python finds that by times and sizes.
    inner, outer = tmp_path / "called_by_a_test.py", tmp_path / "kernels.py"
    inner.write_text(
        "from rotor.support.compiled import compiled\n\n@compiled()\ndef by(x):\n    return x + 1.0\n"
    )
    outer.write_text(
        "import called_by_a_test\nfrom rotor.support.compiled import compiled\n\n"
        "@compiled()\ndef kernel(x):\n    return 10.0 * called_by_a_test.by(x)\n"
    )
    return inner, outer


def test_kept_code_follows_the_functions_it_calls(two: tuple[Path, Path]):
    """Compiled code holds that of the functions it calls, here of another file."""
    inner, outer = two
    assert module(outer).kernel(1.0) == 20.0
    again = module(outer).kernel
    assert (again(1.0), hits(again)) == (20.0, 1)
    inner.write_text(inner.read_text().replace("x + 1.0", "x + 21.0"))
    del sys.modules["called_by_a_test"]
    changed = module(outer).kernel
    assert (changed(1.0), hits(changed)) == (220.0, 0)
    stat = inner.stat()  # Packages and images may give the files of all versions one time.
    inner.write_text(inner.read_text().replace("x + 21.0", "x + 31.0"))
    os.utime(inner, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    del sys.modules["called_by_a_test"]
    changed = module(outer).kernel
    assert (changed(1.0), hits(changed)) == (320.0, 0)


@pytest.mark.parametrize("said", ["from called_by_a_test import TEN", "import called_by_a_test"])
def test_kept_code_follows_the_constants_of_other_files(two: tuple[Path, Path], said: str):
    """numba compiles their values into the code, and no digest tells of a file that has constants alone."""
    inner, outer = two
    name = "TEN" if "from" in said else "called_by_a_test.TEN"
    outer.write_text(SOURCE.replace("import numba", said).replace("1.0", name), encoding="utf-8")
    for value, read in ((10.0, 0), (10.0, 1), (12.5, 0), (12.5, 1)):
        inner.write_text(f"TEN = {value}\n", encoding="utf-8")
        sys.modules.pop("called_by_a_test", None)
        kernel = module(outer).kernel
        assert (kernel(1.0), hits(kernel)) == (1.0 + value, read)


@pytest.mark.parametrize("ending", ["nbi", "nbc"])
def test_a_file_with_a_flipped_bit_is_written_again(source: Path, ending: str):
    """LLVM ended the program over such code; here no bit of code is looked at that has not its checksum."""
    assert module(source).kernel(1.0) == 2.0
    (kept,) = source.parent.rglob(f"*kernel*.{ending}")
    whole = kept.read_bytes()
    # The first bytes of the index are numba's version, which numba reads before its own content.
    for place in (
        *range(min(30, len(whole) - 1)),
        *range(len(whole) - 1, 30, -max(1, len(whole) // 12)),
    ):
        kept.write_bytes(whole[:place] + bytes([whole[place] ^ 16]) + whole[place + 1 :])
        damaged = module(source).kernel
        assert damaged(1.0) == 2.0
        assert hits(damaged) == 0
        again = module(source).kernel
        assert (again(1.0), hits(again)) == (2.0, 1)
        (kept,) = source.parent.rglob(f"*kernel*.{ending}")


def test_without_a_folder_to_write_to_nothing_is_kept(
    source: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(caching.CompileResultCacheImpl, "_locator_classes", [])
    kernel = module(source).kernel
    assert (kernel(1.0), hits(kernel)) == (2.0, 0)
    assert "NUMBA_CACHE_DIR" in why_not_kept()


def test_a_command_that_keeps_nothing_says_so_in_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
):
    monkeypatch.setattr(_watch, "unkept", True)
    assert main(["actuator", "--table", "5.1"]) == 0
    assert capsys.readouterr().err == ""  # It has compiled nothing.
    monkeypatch.setattr(_watch, "began", True)
    assert main(["actuator", "--table", "5.1"]) == 0
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "NUMBA_CACHE_DIR" in said


@pytest.mark.parametrize("method", ["_save_data", "_save_index"])
def test_on_a_full_disk_nothing_is_kept(source: Path, monkeypatch: pytest.MonkeyPatch, method: str):
    def full(*_: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    assert module(source).kernel(1.0) == 2.0
    assert not why_not_kept()
    for file in source.parent.rglob("*.nb*"):
        file.unlink()
    monkeypatch.setattr(caching.IndexDataCacheFile, method, full)
    assert module(source).kernel(1.0) == 2.0
    assert why_not_kept()
    monkeypatch.undo()
    assert module(source).kernel(1.0) == 2.0


@pytest.mark.parametrize("written", [0, 1, 2])
@pytest.mark.parametrize("changed", ["source", "argument", "numba"])
def test_a_write_cut_short_leaves_no_code_of_something_else(
    source: Path, monkeypatch: pytest.MonkeyPatch, written: int, changed: str
):
    """numba writes the index, then the code, under a name that the version before may have used."""
    replace, left = os.replace, written

    def until_the_disk_is_full(*names: str) -> None:
        nonlocal left
        if not left:
            raise OSError(errno.ENOSPC, "No space left on device")
        left -= 1
        replace(*names)

    assert module(source).kernel(1.0) == 2.0
    argument: Any = 1.0
    if changed == "source":
        source.write_text(SOURCE.replace("x + 1.0", "x + 21.0"), encoding="utf-8")
    elif changed == "argument":
        argument = 1 + 2j
        next(source.parent.rglob("*.nbi")).unlink()
    else:
        monkeypatch.setattr("numba.__version__", "another")
    right = argument + (21.0 if changed == "source" else 1.0)
    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", until_the_disk_is_full)
        assert module(source).kernel(argument) == right
    assert bool(why_not_kept()) == (written < 2)
    after = module(source).kernel
    assert (after(argument), hits(after)) == (right, int(written == 2))
    again = module(source).kernel
    assert (again(argument), hits(again)) == (right, 1)


def test_every_kernel_is_compiled_here():
    """A kernel with numba's own cache ends the program at import where no folder can be written."""
    home = Path(rotor.__file__).parent
    compiles = re.compile(r"\b(njit|jit|vectorize|guvectorize|stencil)\(")
    users = [
        path.name
        for path in home.rglob("*.py")
        if compiles.search(path.read_text(encoding="utf-8"))
    ]
    assert users == ["compiled.py"]


def test_kept_code_is_found_by_all_that_is_compiled_into_it():
    """Values of other kinds, and the names in a function within a kernel, would not be seen."""
    own = [one.py_func for one in _watch.kernels if one.py_func.__module__.startswith("rotor.")]
    for function in {inner for kernel in own for inner in compiled._called(kernel, {kernel: None})}:
        code = function.__code__
        assert not any(isinstance(one, CodeType) for one in code.co_consts), function
        for value in filter(None, (function.__globals__.get(name) for name in code.co_names)):
            known = int, float, tuple, ModuleType
            assert (
                isinstance(value, known) or hasattr(value, "py_func") or hasattr(value, "_defn")
            ), (function, value)


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def test_a_terminal_counts_what_is_compiled_and_is_left_empty(
    source: Path, monkeypatch: pytest.MonkeyPatch
):
    said = Terminal()
    monkeypatch.setattr(sys, "stderr", said)
    assert module(source).kernel(1.0) == 2.0
    shown = [line for line in said.getvalue().split("\r") if line.strip()]
    assert len(shown) == 2  # Padded over the line before, and as it stays.
    assert re.fullmatch(r"Compiling, once: \d+ of \d+", shown[-1])
    assert said.getvalue().endswith(f"{' ' * len(shown[-1])}\r")
    assert compiling() == ""
    said.truncate(0)
    assert module(source).kernel(1.0) == 2.0
    assert said.getvalue() == ""  # Kept code.


def test_a_line_does_not_say_once_where_nothing_can_be_kept(
    source: Path, monkeypatch: pytest.MonkeyPatch
):
    said = io.StringIO()
    monkeypatch.setattr(sys, "stderr", said)
    monkeypatch.setattr(caching.CompileResultCacheImpl, "_locator_classes", [])
    log_compiling()
    assert module(source).kernel(1.0) == 2.0
    assert "Compiling kernels, in each run" in said.getvalue()


BESIDE = """
import time
from rotor.support.compiled import compiled

@compiled(error_model="numpy")
def kernel(x):
    return x + 1.0

def compile_it():
    time.sleep(0.5)
    kernel(1.0)

def fail():
    raise RuntimeError
"""


class TestBeside:
    @pytest.fixture
    def made(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
        name = f"beside_{tmp_path.name}"
        (tmp_path / f"{name}.py").write_text(BESIDE, encoding="utf-8")
        monkeypatch.syspath_prepend(tmp_path)
        monkeypatch.setenv("PYTHONPATH", os.pathsep.join(sys.path))
        monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
        return importlib.import_module(name)

    def test_what_another_process_compiles_is_waited_for_and_not_compiled_twice(self, made: Any):
        with compiled_in_parallel(made.compile_it, made.__name__):
            assert made.kernel(1.0) == 2.0
        assert hits(made.kernel) == 1
        assert not _watch.began
        assert compiling() == ""

    def test_what_it_does_not_compile_is_compiled_here(self, made: Any):
        with compiled_in_parallel(made.fail, made.__name__):
            assert made.kernel(1.0) == 2.0
        assert hits(made.kernel) == 0

    def test_there_is_none_where_the_kernels_are_kept(
        self, made: Any, monkeypatch: pytest.MonkeyPatch
    ):
        made.kernel(1.0)
        monkeypatch.setattr(compiled.subprocess, "Popen", None)
        with compiled_in_parallel(made.compile_it, made.__name__):
            assert made.kernel(1.0) == 2.0


def test_the_lags_compiled_beside_are_those_that_a_trim_and_its_gradient_use():
    power_gradient(solve(rotor.make_design(mu=0.2)))
    jacobian(analyse(rotor.make_design(mu=0.2, bending=True)).adjoint.point)
    kernels = [one for one in _watch.kernels if one.py_func.__module__.startswith("rotor.")]
    before = {one: set(one.signatures) for one in kernels}
    compile_lags()
    assert {one: set(one.signatures) for one in kernels} == before
