"""The colour bar and the legend of the outlines, as HTML for the panel under the Field menu."""

from html import escape

from explorer.picture.fields import Field, ticks
from explorer.theme.colours import (
    CASING_DARK,
    CASING_LIGHT,
    DRAG_DIVERGENCE,
    REVERSE_FLOW,
    STALL,
    VOID,
    Rgb,
    colour_map,
    css,
    greyed,
)


def colour_bar(field: Field, low: float, high: float, faded: bool = False) -> str:
    """HTML of constant height: label with unit, gradient, numbers. Data beyond an end take its colour."""
    colours = colour_map(field.colours, 33)
    if faded:
        colours = greyed(colours)
    stops = ",".join(css(colour) for colour in colours.tolist())
    marks = "".join(_mark(value, low, high) for value in ticks(low, high))
    return (
        f'<div class="rx rx-scale" data-explorer="colour-bar"><div>{escape(field.label)}</div>'
        f'<div class="rx-gradient" style="background:linear-gradient(90deg,{stops})"></div>'
        f'<div class="rx-ticks">{marks}</div></div>'
    )


def _mark(value: float, low: float, high: float) -> str:
    at = f"left:{100.0 * (value - low) / (high - low):.2f}%"
    return f'<i style="{at}"></i><span style="{at}">{tick_text(value)}</span>'


def tick_text(value: float) -> str:
    """A tick's number with a true minus sign and no needless digits."""
    return f"{round(value, 6) + 0.0:g}".replace("-", "−")


def outline_legend(field: Field) -> str:
    """What the lines on the disk mean, and the grey patch where the field has no meaning."""
    lines = (
        _line(REVERSE_FLOW, CASING_DARK, "reverse flow"),
        _line(STALL, CASING_LIGHT, "stall"),
        _line(DRAG_DIVERGENCE, CASING_LIGHT, "drag divergence"),
    )
    patch = f'<span class="rx-patch" style="background:{css(VOID)}"></span>not defined in reverse flow'
    return (
        f'<div class="rx rx-legend"><div class="rx-line">{"".join(lines)}</div>'
        f'<div class="rx-dim">{patch if field.void_in_reverse_flow else ""}</div></div>'
    )


def _line(colour: Rgb, casing: Rgb, text: str) -> str:
    swatch = f'<span class="rx-outline" style="background:{css(colour)};border-color:{css(casing)}"></span>'
    return f"<span>{swatch}{text}</span>"
