"""The section of the blade with its actuator, as a drawing of the rail."""

from functools import lru_cache
from html import escape

from explorer.colours import css
from explorer.tabs.actuator.lifted_picture import drive_colour
from rotor.actuator import InstalledActuator, PiezoPly
from rotor.actuator.pictures import Part, section_picture

_WIDTH, _HEIGHT = 312.0, 92.0
_MIDDLE = 46.0
_PLY = 3.4
"""Plies are drawn this thick [px]; to scale they would be half a pixel."""
_GAP = 0.2
_FILLS = {"spar": "#5c6b80", "skin": "#9aa3ad", "web": "#3f4b5c", "tube": "#b7791f"}


@lru_cache(maxsize=32)
def section_svg(installed: InstalledActuator, shares: tuple[float, ...]) -> str:
    """The cut through the blade at its middle segment; `shares` −1…1 colour the plies as they do on the blade."""
    middle = len(shares) // 2
    share = shares[middle]
    picture = section_picture(installed, exaggerate=1.6)
    scale = (_WIDTH - 12.0) / picture.chord
    marks: list[str] = []
    for part in picture.parts:
        if part.role == "outline":
            marks.append(_polygon(part, scale, 'fill="rgba(128,128,128,.14)" stroke="currentColor" stroke-width=".7"'))
        elif part.role == "ply":
            marks.append(_ply(part, scale, share))
        elif part.role == "tube":
            fill = f'fill="{css(drive_colour(share))}" stroke="currentColor" stroke-width=".6"'
            marks.append(_polygon(part, scale, fill))
        else:
            marks.append(_polygon(part, scale, f'fill="{_FILLS[part.role]}"'))
    return (
        f'<div class="rx" data-explorer="section"><svg viewBox="0 0 {_WIDTH:g} {_HEIGHT:g}" width="100%" '
        f'role="img" aria-label="Section of the blade with its plies">{"".join(marks)}{_scale(installed)}</svg>'
        f'<div class="rx-dim rx-small">{escape(_caption(installed, middle + 1))}</div></div>'
    )


def _ply(part: Part, scale: float, share: float) -> str:
    """A band outside the contour along the ply's own line."""
    line = part.points[: len(part.points) // 2] * scale
    upper = "upper" in part.label.rsplit(",", 1)[-1]
    offset = (_GAP + 0.5 * _PLY) * (1.0 if upper else -1.0)
    points = " ".join(f"{6.0 + x:.1f},{_MIDDLE - y - offset:.1f}" for x, y in line)
    red, green, blue = drive_colour(share)
    return (
        f'<polyline class="rx-ply" points="{points}" fill="none" stroke="currentColor" stroke-width="{_PLY + 1.2:g}"/>'
        f'<polyline points="{points}" fill="none" stroke="rgb({red},{green},{blue})" stroke-width="{_PLY:g}"/>'
    )


def _polygon(part: Part, scale: float, style: str) -> str:
    points = " ".join(f"{6.0 + scale * y:.1f},{_MIDDLE - scale * z:.1f}" for y, z in part.points)
    return f'<polygon points="{points}" {style}/>'


def _scale(installed: InstalledActuator) -> str:
    front, rear = installed.placement.chord
    ends = (0.0, front, rear, 1.0) if isinstance(installed.actuator, PiezoPly) else (0.0, 1.0)
    marks = []
    for end in ends:
        x = 6.0 + (_WIDTH - 12.0) * end
        marks.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="76" y2="80" stroke="currentColor" stroke-width=".8"/>')
        place = "start" if end < 0.03 else "end" if end > 0.97 else "middle"
        if not (0.0 < end < 0.08 or 0.9 < end < 1.0):
            look = f'font-size="12.5" fill="currentColor" text-anchor="{place}"'
            marks.append(f'<text x="{x:.1f}" y="90" {look}>{end:g} c</text>')
    marks.append(f'<line x1="6" x2="{_WIDTH - 6.0:g}" y1="78" y2="78" stroke="currentColor" stroke-width=".5"/>')
    return "".join(marks)


def _caption(installed: InstalledActuator, segment: int) -> str:
    labels = [part.label for part in section_picture(installed).parts]
    walls = next((label.split(",")[0] for label in labels if "spar" in label or "box" in label), "")
    plies = next((label.rsplit(",", 1)[0] for label in labels if "±" in label), installed.actuator.name)
    front, rear = installed.placement.chord
    where = f" per side, {100 * front:.0f}–{100 * rear:.0f} % chord" if isinstance(installed.actuator, PiezoPly) else ""
    shown = f" Segment {segment}." if len(installed.shapes) > 1 else ""
    return f"SC1095 with {walls} and web; {plies}{where}.{shown} Wall and ply thickness exaggerated."
