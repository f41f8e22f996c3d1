"""The frame's own files, put together to go into the served page."""

from functools import cache
from pathlib import Path

_FOLDER = Path(__file__).parent
STYLES = ("frame.css", "panels.css")
SCRIPTS = ("frame.js", "cards.js", "charts.js", "inset.js")
"""In the order in which they run: the first defines what the others use."""


@cache
def frame_html() -> str:
    """Style sheets, skeleton and scripts of the frame, to stand at the beginning of the body."""
    styles = "".join(f"<style>{_text(name)}</style>" for name in STYLES)
    scripts = "".join(f"<script>{_text(name)}</script>" for name in SCRIPTS)
    return f"{styles}{_text('frame.html')}{scripts}"


def _text(name: str) -> str:
    return (_FOLDER / name).read_text(encoding="utf-8")
