"""A sample of small faults in the source: which does a test notice? `python -m tests.tools.faults [--seed N] [PART …]`.

A fault is another operator, comparison, sign, number, truth or returned value at one place. A seed draws as many from
each of `PARTS`. Each is written into a copy of the checkout, where the tests run that import the file, themselves or by
way of others, up to the first that fails: first those named after the file or that say the name, then the nearest.
"""

import argparse
import ast
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from collections import defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from copy import copy
from functools import partial
from pathlib import Path
from queue import SimpleQueue
from typing import Any

ROOT = Path(__file__).parent.parent.parent
PARTS = (
    "rotor/support", "explorer/text", "explorer/model/units.py", "rotor/support/units.py", "explorer/views",
    "rotor/aero", "rotor/airfoil", "rotor/dynamics", "rotor/columns", "rotor/trim", "rotor/actuator",
)  # fmt: skip
MOST, SECONDS = 12, 120
"""Files of tests for one fault, and their processor time."""
OPERATORS: dict[type[ast.AST], type[ast.AST]] = {
    ast.Add: ast.Sub, ast.Sub: ast.Add, ast.Mult: ast.Div, ast.Div: ast.Mult, ast.FloorDiv: ast.Mult, ast.Pow: ast.Mult,
    ast.Lt: ast.GtE, ast.LtE: ast.Gt, ast.Gt: ast.LtE, ast.GtE: ast.Lt, ast.Eq: ast.NotEq, ast.NotEq: ast.Eq,
    ast.Is: ast.IsNot, ast.IsNot: ast.Is, ast.In: ast.NotIn, ast.NotIn: ast.In, ast.And: ast.Or, ast.Or: ast.And,
    ast.USub: ast.UAdd,
}  # fmt: skip


def faults_at(node: ast.AST) -> Iterator[tuple[str, ast.AST]]:
    """What may be wrong at a node: in words, and the node to put in its place."""
    first = node.ops[0] if isinstance(node, ast.Compare) else getattr(node, "op", None)
    if first and (other := OPERATORS.get(type(first))):
        wrong = copy(node)
        vars(wrong).update(
            {"ops": [other(), *node.ops[1:]]} if isinstance(node, ast.Compare) else {"op": other()}
        )
        yield f"{type(first).__name__} → {other.__name__}", wrong
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
        yield "Not left out", node.operand
    if isinstance(node, ast.Constant) and isinstance(was := node.value, bool | int | float):
        now = (
            not was
            if isinstance(was, bool)
            else was + 1
            if isinstance(was, int)
            else 1.01 * was or 0.01
        )
        yield f"{was!r} → {now!r}", ast.Constant(now)
    if isinstance(node, ast.Return) and not isinstance(node.value, ast.Constant | None):
        yield "returns None", ast.Return(ast.Constant(None))


class _Put(ast.NodeTransformer):
    """One node in place of another."""

    def __init__(self, right: ast.AST, wrong: ast.AST) -> None:
        self.right, self.wrong = right, wrong

    def visit(self, node: ast.AST) -> Any:
        return self.wrong if node is self.right else self.generic_visit(node)


def faults_in(tree: ast.Module) -> list[tuple[ast.AST, str, ast.AST]]:
    """Every fault of a file: the node, words and the node in its place; decorators and annotations are left out."""
    left_out = set[ast.AST]()
    for node in ast.walk(tree):
        for part in (*getattr(node, "decorator_list", ()), getattr(node, "annotation", None)):
            left_out |= {*ast.walk(part)} if part else set()
    return [
        (node, *one) for node in ast.walk(tree) if node not in left_out for one in faults_at(node)
    ]


def text_with(tree: ast.Module, right: ast.AST, wrong: ast.AST) -> str:
    """The text of a file with one node in place of another; the tree is changed."""
    return ast.unparse(ast.fix_missing_locations(_Put(right, wrong).visit(tree)))


def name_around(tree: ast.Module, line: int) -> str:
    """The innermost function or class, or the constant, at a line."""
    names = [
        ast.unparse(one.targets[0])
        for one in tree.body
        if isinstance(one, ast.Assign) and one.lineno <= line
    ]
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.lineno <= line <= (
            node.end_lineno or 0
        ):
            names.append(node.name)
    return names[-1] if names else ""


def sample(parts: list[str], each: int, seed: int) -> list[tuple[str, str, str, str]]:
    """File, line with words, name around it and text of as many faults of each part."""
    chosen, draw = dict[tuple[str, str], tuple[str, str]](), random.Random(seed)
    for part in parts:
        texts = {
            file: file.read_text("utf-8")
            for file in sorted((ROOT / part).rglob("*.py")) or [ROOT / part]
        }
        known = [
            (file, k)
            for file, text in texts.items()
            for k in range(len(faults_in(ast.parse(text))))
        ]
        for file, k in draw.sample(known, min(each, len(known))):
            right, words, wrong = faults_in(tree := ast.parse(texts[file]))[k]
            line = getattr(right, "lineno", 0)
            name = name_around(tree, line)
            text = text_with(tree, right, wrong)
            chosen[str(file.relative_to(ROOT)), f"{line} {words}"] = name, text
    return [(*place, *rest) for place, rest in chosen.items()]


def imported_by() -> dict[str, set[str]]:
    """By module, the files that import it or something of it; a name of `rotor` is of the module that it is from."""
    users = defaultdict[str, set[str]](set)
    public = ast.parse((ROOT / "rotor" / "public.py").read_text("utf-8")).body
    homes = {
        one.name: node.module
        for node in public
        if isinstance(node, ast.ImportFrom)
        for one in node.names
    }
    for folder in ("rotor", "explorer", "tests"):
        for path in (ROOT / folder).rglob("*.py"):
            for node in ast.walk(ast.parse(path.read_text("utf-8"))):
                names = [
                    alias.name
                    for alias in getattr(node, "names", [])
                    if isinstance(alias, ast.alias)
                ]
                if isinstance(node, ast.ImportFrom):
                    own = [homes.get(name, "") for name in names if node.module == "rotor"]
                    names = [f"{node.module}", *own, *(f"{node.module}.{name}" for name in names)]
                for name in names if isinstance(node, ast.Import | ast.ImportFrom) else ():
                    users[name].add(str(path.relative_to(ROOT)))
    return users


def tests_of(file: str, name: str, users: dict[str, set[str]]) -> list[str]:
    """Tests that import a file, then those that import what does, and so on; before all, those that say the name."""
    seen, front, found = {file}, [file], list[str]()
    while front:
        modules = [
            one.removesuffix(".py").removesuffix("/__init__").replace("/", ".") for one in front
        ]
        front = sorted({user for module in modules for user in users[module]} - seen)
        seen |= {*front}
        found += [one for one in front if re.match(r"tests/(rotor|explorer)/.*test_\w+\.py", one)]
    said, own = re.compile(rf"\b{re.escape(name)}\b"), f"test_{Path(file).stem}.py"
    return sorted(
        found,
        key=lambda test: (
            not test.endswith(own) and not said.search((ROOT / test).read_text("utf-8"))
        ),
    )[:MOST]


def run(checkout: Path, tests: list[str]) -> tuple[int, str]:
    """How the tests end, and what they print."""
    command = [sys.executable, "-m", "pytest", "-q", "-x", "-n", "0", "--no-header", *tests]
    limit = partial(resource.setrlimit, resource.RLIMIT_CPU, (SECONDS, SECONDS))
    try:
        done = subprocess.run(
            command,
            cwd=checkout,
            capture_output=True,
            text=True,
            preexec_fn=limit,
            timeout=10.0 * SECONDS,
        )
    except subprocess.TimeoutExpired:
        return -signal.SIGXCPU, ""
    return done.returncode, done.stdout


def noticed(checkout: Path, file: str, text: str, tests: list[str]) -> str:
    """The test that fails with the fault and passes without it, by its name; empty where none does in time."""
    place = checkout / file
    before, stat = place.read_bytes(), place.stat()
    place.write_text(text, "utf-8")
    try:
        code, out = run(checkout, tests)
    finally:
        place.write_bytes(before)
        # The kernels kept for it serve again.
        os.utime(place, ns=(stat.st_atime_ns, stat.st_mtime_ns))
    failed = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", out, re.M)
    if failed and run(checkout, [failed[1]])[0]:
        raise RuntimeError(f"{failed[1]} fails without the fault too: mend it first")
    if failed or code in (0, -signal.SIGXCPU, -signal.SIGKILL):
        return failed[1] if failed else ""
    return f"pytest ends with {code}"


def main() -> int:
    """Print each fault with the test that notices it, and how many of each part are noticed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "parts", nargs="*", default=list(PARTS), metavar="PART", help="file or folder"
    )
    parser.add_argument("--each", type=int, default=6, help="faults of each part")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    users, drawn = imported_by(), sample(args.parts, args.each, args.seed)
    with tempfile.TemporaryDirectory() as name:
        free = SimpleQueue[Path]()
        left_out = shutil.ignore_patterns(".git", ".venv", "artefacts", "dist", ".hypothesis")
        for k in range(os.cpu_count() or 1):
            free.put(shutil.copytree(ROOT, Path(name) / str(k), ignore=left_out, symlinks=True))

        def one(fault: tuple[str, str, str, str]) -> bool:
            file, words, name, text = fault
            checkout = free.get()
            test = noticed(checkout, file, text, tests_of(file, name, users))
            free.put(checkout)
            print(f"{file}:{words}: {test or 'SURVIVES'}", flush=True)
            return bool(test)

        with ThreadPoolExecutor(free.qsize()) as pool:
            found = list(pool.map(one, drawn))
    print(f"{sum(found)} of {len(found)} are noticed (seed {args.seed})")
    return 0


if __name__ == "__main__":
    sys.exit(main())
