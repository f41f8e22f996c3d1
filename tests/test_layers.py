"""The layers of the code: what each folder may import, names, values, lengths of files, declared dependencies."""

import ast
import graphlib
import re
import sys
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
PHYSICS = {"numpy", "scipy", "numba", "threadpoolctl", "tqdm", "msgspec"}
KNOW_VISER = ("explorer/widgets/", "explorer/scene/", "explorer/hosting/")
"""Folders that may import viser; files directly in `explorer/` may too."""


def _order() -> dict[str, tuple[str, ...]]:
    """Folders and files of each package from the ground up, as the first column of its table in the map names them."""
    text = (ROOT / "docs" / "developers" / "map.md").read_text(encoding="utf-8")
    order = dict[str, tuple[str, ...]]()
    for package, table in re.findall(
        r"^## `([\w/]+)/`\n(.*?)(?=^## )", text, re.DOTALL | re.MULTILINE
    ):
        column = " ".join(line.split("|")[1] for line in table.splitlines() if line.startswith("|"))
        order[package] = tuple(re.findall(r"`(\w+)(?:\.py|/)`", column))
    return order


ORDER = _order()
"""Each folder or file imports only from itself and those before it."""


def sources(package: str) -> list[Path]:
    return sorted((ROOT / package).rglob("*.py"))


@cache
def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


@cache
def nodes(path: Path) -> tuple[ast.AST, ...]:
    return tuple(ast.walk(tree(path)))


@cache
def imports(path: Path, *, lazy: bool = True) -> frozenset[str]:
    """Modules and names that a file imports, as `package.module.name`; with `lazy`, also those inside functions."""

    def walk(node: ast.AST) -> Iterator[str]:
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.Import):
                yield from (alias.name for alias in child.names)
            elif isinstance(child, ast.ImportFrom) and child.level == 0 and child.module:
                yield from (f"{child.module}.{alias.name}" for alias in child.names)
            elif lazy or not isinstance(child, (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)):
                yield from walk(child)

    return frozenset(walk(tree(path)))


def packages(path: Path, *, lazy: bool) -> set[str]:
    return {one.partition(".")[0] for one in imports(path, lazy=lazy)}


MODULES = [*sources("rotor"), *sources("explorer")]


def name(path: Path) -> str:
    return str(path.relative_to(ROOT))


@pytest.mark.parametrize("path", sources("rotor"), ids=name)
def test_rotor_imports_only_numerics(path: Path):
    foreign = packages(path, lazy=False) - sys.stdlib_module_names - PHYSICS - {"rotor"}
    assert not foreign, (
        f"{name(path)} imports {sorted(foreign)}: import all but numerical libraries inside functions"
    )
    assert not packages(path, lazy=True) & {"explorer", "viser"}, (
        f"{name(path)}: rotor must not import the page"
    )


@pytest.mark.parametrize(
    "path",
    [
        p
        for p in sources("explorer")
        if p.parent != ROOT / "explorer" and not name(p).startswith(KNOW_VISER)
    ],
    ids=name,
)
def test_only_some_folders_of_the_page_import_viser(path: Path):
    assert "viser" not in packages(path, lazy=True), (
        f"{name(path)}: only {KNOW_VISER} may import viser"
    )


def test_one_file_uses_private_names_of_viser():
    users = [
        path.name
        for path in sources("explorer")
        if re.search(r"viser\.(\w+\.)*_", path.read_text(encoding="utf-8"))
    ]
    assert set(users) <= {"viser_compat.py"}


@pytest.mark.parametrize("package", ["rotor", "explorer", "explorer/widgets"])
def test_no_import_points_up(package: str):
    order = ORDER[package]
    folders = {
        path.relative_to(ROOT / package).parts[0].removesuffix(".py") for path in sources(package)
    }
    there = {folder for folder in folders if not folder.startswith("__")}
    assert sorted(there) == sorted(order), (
        "name each folder and file once in docs/developers/map.md"
    )
    for path in sources(package):
        folder = path.relative_to(ROOT / package).parts[0].removesuffix(".py")
        if folder.startswith("__"):
            continue
        for used in imported_parts(path, package):
            assert order.index(used) <= order.index(folder), (
                f"{name(path)} imports {used} of {package}"
            )


def imported_parts(path: Path, package: str) -> set[str]:
    """Folders and files of a package that a file imports, wherever in the file."""
    inside = package.replace("/", ".") + "."
    inner = {
        one.removeprefix(inside).split(".")[0] for one in imports(path) if one.startswith(inside)
    }
    return inner & set(ORDER[package])


def test_no_modules_import_each_other_in_a_circle():
    """Imports inside functions and for type checking included."""
    modules = {".".join(path.relative_to(ROOT).with_suffix("").parts): path for path in MODULES}
    modules = {module.removesuffix(".__init__"): path for module, path in modules.items()}
    graph = {
        module: {one if one in modules else one.rpartition(".")[0] for one in imports(path)}
        & modules.keys()
        for module, path in modules.items()
    }
    order = list(graphlib.TopologicalSorter(graph).static_order())  # CycleError names the circle.
    assert len(order) == len(MODULES)


def test_no_class_name_occurs_twice():
    """Whoever searches for a class finds one: a leading underscore makes no other name."""
    places = dict[str, list[str]]()
    for path in (*MODULES, *sources("tests/tools")):
        for node in nodes(path):
            if isinstance(node, ast.ClassDef):
                public_name = node.name.lstrip("_")
                places.setdefault(public_name, []).append(f"{name(path)}:{node.lineno}")
    assert not {one: where for one, where in places.items() if len(where) > 1}


EQUATIONS = ("aero", "columns", "dynamics", "engine")
"""Folders of `rotor` in which all numbers are in SI units and radians."""
OF_SECTION_DATA = {"REVERSE_FLOW_DEG"}
"""Tables of section data are over angles in degrees."""


def names_in(node: ast.AST) -> Iterator[str]:
    """The name that a node gives or reads."""
    for part in ("id", "attr", "arg", "name"):
        value = getattr(node, part, None)
        if isinstance(value, str):
            yield value


@pytest.mark.parametrize("folder", EQUATIONS)
def test_equations_are_in_si_units_and_radians(folder: str):
    units = re.compile(r"_(?:deg|kt|kw|kmh|ft|rpm)$", re.IGNORECASE)
    for path in sources(f"rotor/{folder}"):
        names = {one for node in nodes(path) for one in names_in(node)}
        foreign = {one for one in names if units.search(one)} - OF_SECTION_DATA
        assert not foreign, f"{name(path)} has {sorted(foreign)}: convert where the number enters"


CHANGED_IN_PLACE = {
    "BaselineCache", "ChunkRun", "FactorBox", "History", "UploadedFiles", "_Result",
}  # fmt: skip
"""Dataclasses that are no values: caches, the progress of a study, what a user did."""


def dataclass_options(node: ast.ClassDef) -> dict[str, bool] | None:
    """The options of a class's `@dataclass`; None without one."""
    for decorator in node.decorator_list:
        if isinstance(decorator, ast.Name) and decorator.id == "dataclass":
            return {}
        if isinstance(decorator, ast.Call) and ast.unparse(decorator.func) == "dataclass":
            return {str(one.arg): ast.literal_eval(one.value) for one in decorator.keywords}
    return None


def is_array(annotation: ast.expr) -> bool:
    """Whether the annotation of a field says that it holds an array; a function that returns one does not."""
    if isinstance(annotation, ast.Subscript) and ast.unparse(annotation.value) == "Callable":
        return False
    if isinstance(annotation, ast.Name):
        return annotation.id in ("Array", "Singles", "Integers", "Booleans")
    parts = (one for one in ast.iter_child_nodes(annotation) if isinstance(one, ast.expr))
    return any(is_array(one) for one in parts)


def test_values_are_frozen_dataclasses():
    """One that holds arrays has `eq=False`, for `==` of arrays is no yes or no."""
    changed = set[str]()
    for path in MODULES:
        for node in nodes(path):
            options = dataclass_options(node) if isinstance(node, ast.ClassDef) else None
            if not isinstance(node, ast.ClassDef) or options is None:
                continue
            if not options.get("frozen", False):
                changed.add(node.name)
            fields = [one for one in node.body if isinstance(one, ast.AnnAssign)]
            if any(is_array(one.annotation) for one in fields):
                assert options.get("eq") is False, f"{name(path)}: {node.name} needs eq=False"
    assert changed == CHANGED_IN_PLACE


def test_no_module_is_long():
    """None is over 800 lines."""
    for path in MODULES:
        length = path.read_text(encoding="utf-8").count("\n")
        assert length <= 800, f"{name(path)} has {length} lines"


MARKUP = re.compile(
    r"(?i)(?<!\(\?P)</?(?:[a-z]+|h[1-6])\b|<!(?:--|doctype)|</$|/>|&(?:[a-z]+|#x?[0-9a-f]+);"
)


def test_no_string_holds_markup():
    """Elements are made by `rotor.support.markup`, which alone writes tags and escapes."""
    held: list[str] = []
    for path in MODULES:
        if path == ROOT / "rotor" / "support" / "markup.py":
            continue
        # Docstrings.
        passed = {id(node.value) for node in nodes(path) if isinstance(node, ast.Expr)}
        passed |= {
            id(node.format_spec) for node in nodes(path) if isinstance(node, ast.FormattedValue)
        }
        for node in nodes(path):
            if (
                isinstance(node, ast.Constant)
                and isinstance(node.value, str)
                and id(node) not in passed
            ):
                held += [f"{name(path)}:{node.lineno}: {node.value!r}"] * bool(
                    MARKUP.search(node.value)
                )
            elif isinstance(node, ast.JoinedStr) and id(node) not in passed:
                # A tag whose name is a value.
                starts = [part.value for part in node.values[:-1] if isinstance(part, ast.Constant)]
                held += [
                    f"{name(path)}:{node.lineno}: {text}"
                    for text in starts
                    if str(text).endswith("<")
                ]
    assert not held, "make it with rotor.support.markup"


def test_every_import_is_a_declared_dependency():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    declared = {re.split(r"[^\w-]", item)[0] for item in project["dependencies"]}
    imported_as = {"pillow": "PIL"}  # The one package whose module has another name.
    known = (
        sys.stdlib_module_names
        | {imported_as.get(item, item) for item in declared}
        | {"rotor", "explorer"}
    )
    for path in MODULES:
        undeclared = packages(path, lazy=False) - known
        assert not undeclared, (
            f"{name(path)} imports {sorted(undeclared)}: declare it in pyproject.toml, and say why"
        )


def canonical(package: str) -> str:
    """The name of a package as indexes compare it, without its extras and versions."""
    return re.sub(r"[-_.]+", "-", re.split(r"[^\w.-]", package)[0]).lower()


def pinned(file: str) -> set[str]:
    """The packages to which a requirements file gives an exact version."""
    text = (ROOT / file).read_text(encoding="utf-8")
    return {canonical(package) for package in re.findall(r"^([\w.-]+)==", text, re.MULTILINE)}


def test_each_dependency_has_a_reason_and_an_exact_version():
    """The reason is a comment in its line. The extra `crosscheck` is installed by hand, in the newest version."""
    text = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    project = tomllib.loads(text)["project"]
    exact = pinned("requirements.txt") | pinned("requirements-dev.txt")
    extras: dict[str, list[str]] = project["optional-dependencies"]
    for extra, needed in {"": project["dependencies"], **extras}.items():
        for package in needed:
            if canonical(package) == project["name"]:
                continue
            lines = [line for line in text.splitlines() if f'"{package}"' in line]
            assert "#" in lines[-1], f"say in pyproject.toml why {package} is needed"
            assert extra == "crosscheck" or canonical(package) in exact, f"pin {package}"
