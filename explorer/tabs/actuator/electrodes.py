"""Electrodes, field and free strain of the chosen actuator: chart data, pictures, words, and their folder."""

import base64
from collections.abc import Iterable
from functools import lru_cache
from html import escape

import numpy as np
import viser

from explorer.charts.plots import Plot, held_range
from explorer.colours import BASELINE, IDEAL, NOW, THIS, colour_map
from explorer.model.units import number
from explorer.picture.disk_image import encode_png
from explorer.tabs.live_charts import PanelChart, line, points
from rotor.actuator import Actuator, PiezoPly, actuators, find_actuator
from rotor.actuator.electrical import electric_field, field_map, free_strain, thermal_coefficients
from rotor.arrays import Array

_MODE = {"interdigitated": "d33", "continuous": "d31"}
_POINTS, _SWEEPS = 31, 900
"""Of the field's relaxation: enough for a picture of 140 pixels."""
_STATIONS = 61
_WIDTH, _CUT, _TALL = 312.0, 140.0, 84.0
"""[px] of the picture, of one cut, and of its height."""
_LINES = 9
_METAL = "#e8590c"
_PPM, _KV_MM = 1e6, 1e-6


def other_kind(sheet: PiezoPly) -> PiezoPly:
    """A sheet of the same fibres with the other kind of electrodes; of MFC fibres, where there is none."""
    other = find_actuator("MFC_P2" if sheet.electrodes == "interdigitated" else "MFC_P1")
    assert isinstance(other, PiezoPly)
    return other


def strain_plot(actuator: PiezoPly, volts: tuple[float, ...], previous: tuple[float, float] | None) -> Plot:
    """Free strain [µε] over voltage; series: the other kind along, across, along, along by α = d/ΔES, now."""
    low, high = actuator.voltage_range
    margin = 0.04 * (high - low)
    at = {round(value, 6) for value in volts}
    x = np.array(sorted({*np.linspace(low, high, _STATIONS).tolist(), *at}))
    along, across = _PPM * free_strain(actuator, x)
    other = other_kind(actuator)
    within = (x >= other.voltage_range[0]) & (x <= other.voltage_range[1])
    against = np.where(within, _PPM * free_strain(other, x)[0], np.nan)
    analogy = _PPM * thermal_coefficients(actuator)[0] * x
    now = np.where(np.isin(x, list(at)), along, np.nan)
    series = (against, across, along, analogy, now)
    seen = np.concatenate([values[np.isfinite(values)] for values in series])
    y_range = held_range(previous, float(seen.min()), float(seen.max()))
    return Plot((x, *series), y_range, (low - margin, high + margin))


@lru_cache(maxsize=16)
def field_panel(actuator: PiezoPly) -> str:
    """Cuts through the chosen sheet and through one of the other kind, at the highest voltage of each."""
    cuts = "".join(
        f'<g transform="translate({k * (_WIDTH - _CUT):g} 0)">{_cut(sheet)}</g>'
        for k, sheet in enumerate((actuator, other_kind(actuator)))
    )
    alpha, across = thermal_coefficients(actuator)
    lines = (
        ("d along / across", f"{number(1e12 * actuator.d_along)} / {number(1e12 * actuator.d_across)} pm/V"),
        ("Electrode gap ΔES", f"{number(1e3 * actuator.electrode_gap, 2)} mm"),
        ("α = d/ΔES along", f"{number(1e6 * alpha, 2)}·10⁻⁶ /V"),
        ("α across", f"{number(1e6 * across, 2)}·10⁻⁶ /V"),
        ("Measured along", f"{number(1e6 * actuator.swing[0] / actuator.voltage_swing, 2)}·10⁻⁶ /V"),
        ("Voltage", "{}…{} V".format(*(number(end) for end in actuator.voltage_range))),
    )
    return (
        f'<div class="rx" data-explorer="electrodes"><svg viewBox="0 0 {_WIDTH:g} 122" width="100%" role="img" '
        f'aria-label="Cut through the sheet: electrodes, equal potential and field">{cuts}</svg>'
        '<div class="rx-dim rx-small">One electrode gap along the fibres: electrodes orange, lines of equal potential, '
        "colour for the field (0 to twice its mean).</div>"
        f'{named_lines(lines)}<div class="rx-dim rx-small">Thermal analogy: one volt strains the sheet as one kelvin '
        "would with expansion coefficient α.</div></div>"
    )


def named_lines(entries: Iterable[tuple[str, str]]) -> str:
    """Names with their values, one a line; as HTML."""
    return "".join(
        f'<div class="rx-line"><span class="rx-dim">{name}</span><span class="rx-num">{value}</span></div>'
        for name, value in entries
    )


def ranges_panel(actuator: PiezoPly, volts: tuple[float, ...]) -> str:
    """The field that each sheet may carry, as bars over kV/mm, with a mark where the chosen one is now."""
    known = [one for one in actuators().values() if isinstance(one, PiezoPly)]
    ends = {one.id: _KV_MM * electric_field(one, one.voltage_range) for one in known}
    least = min(float(low) for low, _ in ends.values())
    width = max(float(high) for _, high in ends.values()) - least

    def place(value: float) -> float:
        return 100.0 * (value - least) / width

    rows: list[str] = []
    for one in known:
        low, high = (float(end) for end in ends[one.id])
        chosen = one.id == actuator.id
        colour = "#1c7ed6" if chosen else "rgba(128,128,128,.5)"
        now = [_KV_MM * float(electric_field(one, value)) for value in volts] if chosen else []
        marks = "".join(f'<b style="left:calc({place(value):.1f}% - 1px)"></b>' for value in now)
        name = one.id.replace("_", " ")
        rows.append(
            f"<span>{f'<b>{escape(name)}</b>' if chosen else escape(name)}</span>"
            f'<span class="rxa-track"><i style="left:{place(low):.1f}%;width:{place(high) - place(low):.1f}%;'
            f'background:{colour}"></i><u style="left:{place(0.0):.1f}%"></u>{marks}</span>'
            f'<span class="rx-num">{number(low, 1)}…{number(high, 1)}</span>'
        )
    return (
        f'<div class="rx" data-explorer="field-ranges">{_present(actuator, volts)}'
        f'<div class="rx-dim rx-small">Permitted field [kV/mm]</div><div class="rxa-bars">{"".join(rows)}</div></div>'
    )


def _present(sheet: PiezoPly, volts: tuple[float, ...]) -> str:
    """Voltage, field and free strain of the first segment."""
    first, *others = volts
    field = _KV_MM * float(electric_field(sheet, first))
    strain = _PPM * float(free_strain(sheet, first)[0])
    which = "Now, segment 1" if others else "Now"
    return (
        f'<div class="rx-line"><span class="rx-dim">{which}</span><span class="rx-num" data-explorer="field-now">'
        f"{number(first, sign=True)} V · {number(field, 2, sign=True)} kV/mm · {number(strain, sign=True)} µε"
        "</span></div>"
    )


def _cut(sheet: PiezoPly) -> str:
    field = field_map(sheet, points=_POINTS, sweeps=_SWEEPS)
    data = base64.b64encode(_image(field.strength[::-1])).decode("ascii")
    lines: list[str] = []
    for level in np.linspace(0.0, 1.0, _LINES + 2)[1:-1]:
        if sheet.electrodes == "interdigitated":  # Potential rises along the fibre in every row.
            x = np.array([np.interp(level, row, field.x) for row in field.potential])
            z = field.z / field.z[-1]
        else:
            x, z = np.array([0.0, 1.0]), np.full(2, level)
        points = " ".join(f"{_CUT * a:.1f},{20.0 + _TALL * (1.0 - b):.1f}" for a, b in zip(x, z, strict=True))
        lines.append(f'<polyline points="{points}" fill="none" stroke="#fff" stroke-width=".7"/>')
    fingers = ((0.0, 0.1), (0.9, 1.0)) if sheet.electrodes == "interdigitated" else ((0.0, 1.0),)
    metal = "".join(
        f'<rect x="{_CUT * a:g}" y="{y:g}" width="{_CUT * (b - a):g}" height="4" fill="{_METAL}"/>'
        for a, b in fingers
        for y in (16.0, 20.0 + _TALL)
    )
    mean = _KV_MM * sheet.voltage_range[1] / sheet.electrode_gap
    name = f"{sheet.id.replace('_', ' ')}, {_MODE[sheet.electrodes]}"
    under = f"{sheet.electrodes}, {number(mean, 1)} kV/mm"
    look = 'font-size="12" fill="currentColor"'
    return (
        f'<text x="0" y="10" {look} font-weight="600">{escape(name)}</text>'
        f'<image href="data:image/png;base64,{data}" x="0" y="20" width="{_CUT:g}" height="{_TALL:g}" '
        f'preserveAspectRatio="none"/>{"".join(lines)}{metal}<text x="0" y="119" {look}>{escape(under)}</text>'
    )


def _image(strength: Array) -> bytes:
    """0 to twice the mean field, smoothed by the browser."""
    entries = np.full((256, 4), 255, dtype=np.uint8)
    entries[:, :3] = colour_map("sequential", 256)
    return encode_png(np.clip(127.5 * strength, 0.0, 255.0).astype(np.uint8), entries)


class ElectrodesPanel:
    """Written only when actuator or voltage change: a dragged twist costs nothing here."""

    def __init__(self, gui: viser.GuiApi) -> None:
        self._shown: tuple[Actuator, tuple[float, ...]] | None = None
        self._folder = gui.add_folder("Electrodes", expand_by_default=False)
        with self._folder:
            self._chart = PanelChart(
                gui,
                "Strain [µε]",
                (("this sheet", THIS), ("α·V", IDEAL), ("other kind", BASELINE)),
                # The other electrodes, across and along the fibres, along by α = d/ΔES, now.
                (line(BASELINE), line(THIS, 1.0), line(THIS, 2.5), line(IDEAL, 1.5, (5, 4)), points(NOW, 8)),
                (-1.0, 1.0),
                height=118,
            )
            self._field = gui.add_html("")
            self._ranges = gui.add_html("")

    def show(self, actuator: Actuator, volts: tuple[float, ...]) -> None:
        """Follow the chosen actuator; `volts` of each segment. What has no electrodes has no folder."""
        if self._shown == (actuator, volts):
            return
        before, self._shown = self._shown, (actuator, volts)
        if before is None or before[0] != actuator:
            self._folder.visible = isinstance(actuator, PiezoPly)
            if isinstance(actuator, PiezoPly):
                self._field.content = field_panel(actuator)
        if not isinstance(actuator, PiezoPly):
            return
        self._ranges.content = ranges_panel(actuator, volts)
        self._chart.show(strain_plot(actuator, volts, self._chart.y_range))
