"""The 3D pictures of a page without a server: viser's own viewer, once, and a scene for each design."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass

_SEAMS = re.compile(
    r'(?P<before>.*window\.__VISER_EMBED_DATA__=")(?P<scene>[^"]*)'
    r'(?P<between>";window\.__VISER_EMBED_CONFIG__=\{darkMode:)(?:true|false)(?P<after>\}.*)',
    re.DOTALL,
)
"""Where viser puts a scene, and whether the page is dark, into its viewer."""


@dataclass(frozen=True)
class EmbeddedViewer:
    """The viewer in parts, and what goes between them: before + scene + between + true or false + after."""

    before: str
    between: str
    after: str
    scenes: tuple[str, ...]
    """Base64."""

    @property
    def json(self) -> str:
        """For a script element: no `<` in it, so that nothing ends the element."""
        parts = {"before": self.before, "between": self.between, "after": self.after, "scenes": self.scenes}
        return json.dumps(parts).replace("<", "\\u003c")


def embedded_viewer(pages: Sequence[str]) -> EmbeddedViewer:
    """What viser's stand-alone pages share, once, and what each has of its own."""
    parts = [_parts(page) for page in pages]
    first = parts[0]
    return EmbeddedViewer(first["before"], first["between"], first["after"], tuple(part["scene"] for part in parts))


def _parts(page: str) -> dict[str, str]:
    found = _SEAMS.fullmatch(page)
    if found is None:
        raise ValueError("viser's viewer is not laid out as it was: the report has no 3D picture until it is adapted.")
    return found.groupdict()
