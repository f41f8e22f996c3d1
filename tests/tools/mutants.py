"""Small faults put into the code one at a time: some test must fail. `python -m tests.tools.mutants [--sample 40]`.

A fault turns a comparison or a condition round, swaps + and −, × and ÷, min and max, `and` and `or`, changes a number,
a truth or what is returned. A copy of the checkout is changed, never the checkout. Each test file runs once on code
that notes which blocks it enters; then each fault meets the quick tests that enter its block, quickest first, up to
the first that fails or `ENOUGH` seconds. `--only` names faults of one kind or file. On Linux and macOS, for it forks.
"""

import argparse
import ast
import builtins
import compileall
import contextlib
import copy
import importlib
import itertools
import json
import os
import random
import shutil
import signal
import sys
import tempfile
import time
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parent.parent.parent
PARTS = ("rotor/optimisation", "rotor/actuator", "rotor/design", "explorer/model", "explorer/text")
ENOUGH = 45.0
"""Seconds of tests, as they took when counted, that a fault may survive."""
LEAST = 0.7
"""Part of the faults that is to be noticed."""
LEFT_OUT = ("__pycache__", ".git", ".venv", ".hypothesis", ".*_cache", "dist", "artefacts", "_made")
IMPORTED = ("numpy", "scipy.interpolate", "scipy.optimize", "numba", "viser", "trimesh", "PIL.Image")
"""What takes long to import; each test run is a fork of a process that has it."""

_OPPOSITE: dict[type, type] = {
    ast.Lt: ast.GtE, ast.GtE: ast.Lt, ast.Gt: ast.LtE, ast.LtE: ast.Gt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.In: ast.NotIn, ast.NotIn: ast.In, ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.And: ast.Or, ast.Or: ast.And,
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult,
}  # fmt: skip
_PAIRS = ("min max", "minimum maximum", "any all", "argmin argmax", "sin cos", "floor ceil")
_SWAPPED = {a: b for pair in _PAIRS for a, b in (pair.split(), reversed(pair.split()))}


@dataclass(frozen=True)
class Mutant:
    """One fault: what stands at a place of a file, what stands there instead, and the block it is in."""

    file: str
    line: int
    kind: str
    block: int
    start: int
    end: int
    text: str

    @property
    def name(self) -> str:
        """The place and the fault; places of one line are told apart by their text."""
        return f"{self.file}:{self.line} {self.kind} -> {' '.join(self.text.split())[:90]}"


def _changes(node: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    """What a node may be turned into."""
    if isinstance(node, ast.Compare) and len(node.ops) == 1:
        yield "compare", ast.Compare(node.left, [_OPPOSITE[type(node.ops[0])]()], node.comparators)
    elif isinstance(node, ast.BoolOp):
        yield "and/or", ast.BoolOp(_OPPOSITE[type(node.op)](), node.values)
    elif isinstance(node, ast.BinOp) and type(node.op) in _OPPOSITE and not isinstance(node.left, ast.JoinedStr):
        yield "arithmetic", ast.BinOp(node.left, _OPPOSITE[type(node.op)](), node.right)
    elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not | ast.USub):
        yield "not" if isinstance(node.op, ast.Not) else "sign", node.operand
    elif isinstance(node, ast.Constant) and isinstance(node.value, bool):
        yield "constant", ast.Constant(not node.value)
    elif isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        yield "constant", ast.Constant(node.value + 1 if isinstance(node.value, int) else node.value * 1.3 + 0.01)
    elif isinstance(node, ast.Name | ast.Attribute):
        called = node.id if isinstance(node, ast.Name) else node.attr
        if called in _SWAPPED:
            swapped = copy.copy(node)
            setattr(swapped, "id" if isinstance(node, ast.Name) else "attr", _SWAPPED[called])
            yield "swap", swapped
    elif isinstance(node, ast.Return) and node.value and not isinstance(node.value, ast.Constant):
        yield "return", ast.Return(ast.Constant(None))
    elif isinstance(node, ast.IfExp):
        yield "branch", node.orelse
    elif isinstance(node, ast.If):
        changed = copy.copy(node)
        changed.test = ast.Constant(False)
        yield "branch", changed


class _Put(ast.NodeTransformer):
    """One node instead of another."""

    def __init__(self, old: ast.AST, new: ast.AST) -> None:
        self.old, self.new = old, new

    def visit(self, node: ast.AST) -> ast.AST:
        return self.new if node is self.old else self.generic_visit(node)


class _Blocks(ast.NodeVisitor):
    """The mutants of a file, and for each body of a function, branch or loop its number."""

    def __init__(self, file: str, source: bytes, first: int) -> None:
        self.file, self.source, self.block, self.next = file, source, 0, first
        self.starts = [0]
        for line in source.splitlines(keepends=True):
            self.starts.append(self.starts[-1] + len(line))
        self.bodies, self.mutants = list[tuple[list[ast.stmt], int]](), list[Mutant]()
        self.anchor: ast.expr | None = None

    def _keep(self, kind: str, node: Any, changed: Any) -> None:
        """The text of a changed node; inside an f-string the whole string, whose parts have no places of their own."""
        if isinstance(node, ast.If):
            node, changed = node.test, changed.test
        if self.anchor is not None:
            _Put(node, changed).visit(self.anchor)
            with contextlib.suppress(ValueError):  # A backslash within.
                self._add(kind, self.anchor, ast.unparse(self.anchor))
            _Put(changed, node).visit(self.anchor)
            return
        text = ast.unparse(ast.fix_missing_locations(changed))
        self._add(kind, node, text if isinstance(node, ast.stmt) else f"({text})")

    def _add(self, kind: str, node: Any, text: str) -> None:
        start = self.starts[node.lineno - 1] + node.col_offset
        end = self.starts[node.end_lineno - 1] + node.end_col_offset
        self.mutants.append(Mutant(self.file, node.lineno, kind, self.block, start, end, text))

    def visit(self, node: ast.AST) -> None:
        """A node with its changes, then what is within; types and texts have none."""
        if isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            return
        for kind, changed in _changes(node):
            self._keep(kind, node, changed)
        outer = self.anchor
        if isinstance(node, ast.JoinedStr) and outer is None:
            self.anchor = node
        for name, value in ast.iter_fields(node):
            if name in ("annotation", "returns", "decorator_list", "format_spec", "type_params"):
                continue
            parts = [one for one in (value if isinstance(value, list) else [value]) if isinstance(one, ast.AST)]
            if parts and isinstance(parts[0], ast.stmt) and not isinstance(node, ast.ClassDef):
                self._body(node, value)
            else:
                for part in parts:
                    self.visit(part)
        self.anchor = outer

    def _body(self, node: ast.AST, body: list[ast.stmt]) -> None:
        outer = self.block
        if not isinstance(node, ast.Module):
            self.next += 1
            self.block = self.next
            self.bodies.append((body, self.block))
        for child in body:
            self.visit(child)
        self.block = outer


def _read(folder: Path) -> tuple[list[Mutant], dict[str, str], dict[str, range]]:
    """All mutants; by file the source that notes the blocks it enters, and its blocks."""
    mutants, noted, blocks, first = list[Mutant](), dict[str, str](), dict[str, range](), 0
    for path in sorted(path for part in PARTS for path in (folder / part).rglob("*.py")):
        file, source = path.relative_to(folder).as_posix(), path.read_bytes()
        found = _Blocks(file, source, first)
        tree = ast.parse(source)
        found.visit(tree)
        for body, number in found.bodies:
            text = isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant)
            body[text:text] = ast.parse(f"__import__('builtins').__dict__.get('_entered', set()).add({number})").body
        noted[file], blocks[file] = ast.unparse(ast.fix_missing_locations(tree)), range(first + 1, found.next + 1)
        mutants += [mutant for mutant in found.mutants if mutant.text.encode() != source[mutant.start : mutant.end]]
        first = found.next
    return mutants, noted, blocks


class _Run:
    """A plugin of pytest: only these tests, in this order; what each enters, how long it takes, which fail."""

    def __init__(self, only: list[str] | None) -> None:
        self.only, self.failed, self.tests = only, list[str](), dict[str, tuple[list[int], float]]()
        self.entered = set[int]()
        builtins.__dict__["_entered"] = self.entered

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        if self.only is not None:
            rank = {name: index for index, name in enumerate(self.only)}
            items[:] = sorted((item for item in items if item.nodeid in rank), key=lambda item: rank[item.nodeid])

    @pytest.hookimpl(wrapper=True)
    def pytest_runtest_protocol(self, item: pytest.Item) -> Any:
        self.entered.clear()
        start = time.process_time()
        done = yield
        self.tests[item.nodeid] = (sorted(self.entered), time.process_time() - start)
        return done

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            self.failed.append(report.nodeid)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        if report.failed:
            self.failed.append(f"{report.nodeid} is not importable")


def _fork(folder: Path, task: Callable[[], Any], seconds: float) -> Any:
    """What a task returns in a fork of this process, with all that it starts; None when it is not done in time."""
    with tempfile.TemporaryDirectory() as place:
        answer = Path(place, "answer")
        child = os.fork()
        if child == 0:
            try:
                os.setsid()
                os.chdir(folder)
                quiet = os.open(os.devnull, os.O_RDWR)
                for stream in (0, 1, 2):
                    os.dup2(quiet, stream)
                answer.write_text(json.dumps(task()), encoding="utf-8")
            finally:
                os._exit(0)  # Nothing of the process that it is a copy of is to end here.
        late = time.monotonic() + seconds
        while os.waitpid(child, os.WNOHANG)[0] == 0 and time.monotonic() < late:
            time.sleep(0.02)
        with contextlib.suppress(ProcessLookupError):
            os.killpg(child, signal.SIGKILL)
        with contextlib.suppress(ChildProcessError):
            os.waitpid(child, 0)
        text = answer.read_text(encoding="utf-8") if answer.exists() else ""
        return json.loads(text) if text else None


def _pytest(files: list[str], only: list[str] | None) -> tuple[list[str], dict[str, tuple[list[int], float]]]:
    """The tests that fail, and by test what it enters and its seconds; with `only` up to the first that fails."""
    run = _Run(only)
    stop = [] if only is None else ["-x"]
    code = pytest.main(["-q", *stop, "-n", "0", "-p", "no:cacheprovider", "--tb=no", *files], plugins=[run])
    return run.failed or ([] if code in (0, 5) else [f"pytest ends with {code}"]), run.tests


def measure(folder: Path, noted: dict[str, str]) -> dict[str, tuple[list[int], float]]:
    """By quick test the blocks it enters and its seconds."""
    kept = {file: (folder / file).read_bytes() for file in noted}
    for file, text in noted.items():
        (folder / file).write_text(text, encoding="utf-8")
    found = dict[str, tuple[list[int], float]]()
    for path in sorted((folder / "tests").rglob("test_*.py")):
        file = path.relative_to(folder).as_posix()
        if file.startswith("tests/browser/"):
            continue
        failed, tests = _fork(folder, lambda file=file: _pytest([file], None), 600) or (["is not done in time"], {})
        for name in failed:
            print(f"without a fault fails {file}: {name}", flush=True)
        found |= {name: row for name, row in tests.items() if name not in failed}
    for file, source in kept.items():
        (folder / file).write_bytes(source)
    compileall.compile_dir(folder, quiet=2)
    return found


def asked(mutant: Mutant, tests: dict[str, tuple[list[int], float]], blocks: range) -> list[str]:
    """The tests that enter a fault's block, else its file, then their neighbours; quickest first, `ENOUGH` seconds."""
    own = {mutant.block}
    if not any(mutant.block in entered for entered, _ in tests.values()):
        own = set(blocks)
    enter = {name for name, (entered, _) in tests.items() if own & set(entered)} or set(tests)  # A file of data alone.
    beside = {name.partition("::")[0] for name in enter}
    stem = mutant.file.rpartition("/")[2].removesuffix(".py")
    order = sorted(
        (name not in enter, stem not in name, seconds, name)
        for name, (_, seconds) in tests.items()
        if name.partition("::")[0] in beside
    )
    total = itertools.accumulate(seconds for *_, seconds, _ in order)
    return [name for (*_, name), until in zip(order, total, strict=True) if until <= ENOUGH or name == order[0][-1]]


def meet(folder: Path, mutant: Mutant, chosen: list[str]) -> str:
    """The first test that notices a fault; empty when none does."""
    path = folder / mutant.file
    source, changed = path.read_bytes(), path.stat().st_mtime
    path.write_bytes(source[: mutant.start] + mutant.text.encode() + source[mutant.end :])
    other = changed + 10.0 + zlib.crc32(mutant.name.encode()) % 10**6  # Python keeps what it compiled by size and time.
    os.utime(path, (other, other))
    files = list(dict.fromkeys(name.partition("::")[0] for name in chosen))
    try:
        done = _fork(folder, lambda: _pytest(files, chosen), 60 + 4 * ENOUGH) if files else ([], {})
    finally:
        path.write_bytes(source)
        os.utime(path, (changed, changed))
    return "is not done in time" if done is None else next(iter(done[0]), "")


def main() -> int:
    """Print each fault with the test that notices it, and the score by folder; 1 where it is below `LEAST`."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sample", type=int, default=40, help="how many faults (default 40)")
    parser.add_argument("--seed", type=int, default=1, help="which (default 1)")
    parser.add_argument("--only", default="", help="faults whose name has this text")
    parser.add_argument("--out", type=Path, default=ROOT / "artefacts" / "mutants.json", help="where the list goes")
    arguments = parser.parse_args()
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    for name in IMPORTED:
        importlib.import_module(name)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place, "checkout")
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(*LEFT_OUT), symlinks=True)
        compileall.compile_dir(folder, quiet=2)
        sys.path[:] = [str(folder) if path in ("", str(ROOT)) else path for path in sys.path]
        os.environ["PYTHONPATH"] = str(folder)
        mutants, noted, blocks = _read(folder)
        mutants = [mutant for mutant in mutants if arguments.only in mutant.name]
        sample = random.Random(arguments.seed).sample(mutants, min(arguments.sample, len(mutants)))
        tests = measure(folder, noted)
        rows = list[dict[str, Any]]()
        for mutant in sorted(sample, key=lambda mutant: mutant.name):
            start, chosen = time.monotonic(), asked(mutant, tests, blocks[mutant.file])
            killer = meet(folder, mutant, chosen)
            print(f"{mutant.name}: {killer or f'SURVIVES {len(chosen)} tests'}", flush=True)
            seconds = round(time.monotonic() - start, 1)
            rows.append({"fault": mutant.name, "noticed": killer, "asked": len(chosen), "seconds": seconds})
            arguments.out.parent.mkdir(parents=True, exist_ok=True)
            arguments.out.write_text(json.dumps(rows, indent=0), encoding="utf-8")
    noticed = 0
    for part in PARTS:
        found = [bool(row["noticed"]) for row in rows if row["fault"].startswith(part)]
        noticed += sum(found)
        print(f"{part}: {sum(found)} of {len(found)} noticed")
    print(f"{noticed} of {len(rows)} noticed")
    return int(noticed < LEAST * len(rows))


if __name__ == "__main__":
    sys.exit(main())
