"""Types of what Python and the page's scripts tell each other: `python -m tests.tools.page_types` writes
`explorer/web/parts.d.ts` from `explorer.parts` and `presses.PRESSES`.

`make lint` writes it before it checks the scripts, and git ignores it. All names begin with `Rx`: an interface that has
a name of the browser's, such as `Response`, would be merged with it without a word.
"""

import dataclasses
import types
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, Union, get_args, get_origin, get_type_hints

import msgspec

from explorer.parts import Parts
from explorer.parts.presses import PRESSES

FILE = Path(__file__).parents[2] / "explorer" / "web" / "parts.d.ts"
_PLAIN = {
    str: "string",
    int: "number",
    float: "number",
    bool: "boolean",
    types.NoneType: "null",
    None: "null",
}
_HEAD = "// Made by `python -m tests.tools.page_types` from explorer/parts and presses.PRESSES: change those."


class _Declared:
    """Declarations by name, each written when a type first names it."""

    def __init__(self) -> None:
        self.texts: dict[str, str] = {}

    def type_of(self, kind: Any) -> str:
        """A Python type as TypeScript writes it; TypeError for one that has no counterpart."""
        origin, arguments = get_origin(kind), get_args(kind)
        if kind in _PLAIN:
            return _PLAIN[kind]
        if origin is Annotated:
            return self.type_of(arguments[0])
        if origin is Literal:
            return " | ".join(f"'{value}'" for value in arguments)
        if origin in (Union, types.UnionType):
            return " | ".join(dict.fromkeys(self.type_of(one) for one in arguments))
        if origin is tuple and arguments[-1] is not ...:
            return f"[{', '.join(self.type_of(one) for one in arguments)}]"
        if origin in (list, tuple, Sequence):
            inner = self.type_of(arguments[0])
            return f"({inner})[]" if " | " in inner else f"{inner}[]"
        if origin in (dict, Mapping):
            return f"Record<{', '.join(self.type_of(one) for one in arguments)}>"
        if isinstance(kind, type) and (
            dataclasses.is_dataclass(kind) or issubclass(kind, msgspec.Struct)
        ):
            return self._declare(kind)
        raise TypeError(f"{kind} has no counterpart in the page: see tests/tools/page_types.py")

    def _declare(self, kind: type[Any]) -> str:
        name = f"Rx{kind.__name__.lstrip('_')}"
        if name not in self.texts:
            self.texts[name] = ""
            config: Any = getattr(kind, "__struct_config__", None)
            fields = {
                field: self.type_of(one)
                for field, one in get_type_hints(kind, include_extras=True).items()
            }
            if config is not None and config.array_like:
                self.texts[name] = (
                    f"type {name} = [{', '.join(f'{field}: {one}' for field, one in fields.items())}];"
                )
                return name
            if config is not None and config.omit_defaults:
                known = {one.name: one.required for one in msgspec.structs.fields(kind)}
                fields = {
                    field if known[field] else f"{field}?": one for field, one in fields.items()
                }
            if config is not None and config.tag is not None:
                fields = {config.tag_field: f"'{config.tag}'"} | fields
            self.texts[name] = _interface(name, fields)
        return name


def _interface(name: str, fields: Mapping[str, str]) -> str:
    return "\n".join(
        [f"interface {name} {{", *(f"  {field}: {one};" for field, one in fields.items()), "}"]
    )


def page_types() -> str:
    """The text of the file."""
    declared = _Declared()
    parts = {
        name: declared.type_of(kind)
        for name, kind in get_type_hints(Parts, include_extras=True).items()
    }
    presses = {name: declared.type_of(kind) for name, kind in PRESSES.items()}
    tables = _interface("RxState", parts), _interface("RxPresses", presses)
    return "\n\n".join([_HEAD, *tables, *declared.texts.values()]) + "\n"


if __name__ == "__main__":
    FILE.write_text(page_types(), encoding="utf-8")
