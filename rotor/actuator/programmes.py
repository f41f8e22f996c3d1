"""What published programmes of active blades reached, from `assets/active_twist_programmes.toml`."""

import tomllib
from dataclasses import dataclass
from functools import cache
from typing import Any, Literal

from rotor.assets import asset_path

Control = Literal["active twist", "root pitch", "trailing-edge flap"]
Evidence = Literal["computed", "wind tunnel", "flight"]


@dataclass(frozen=True)
class Programme:
    """One published result. Changes are against the same rotor without active control [%]; None: not stated."""

    name: str
    short: str
    """For a label beside a point."""
    rotor: str
    control: Control
    kind: Evidence
    per_rev: tuple[int, ...]
    """Harmonics driven; empty where the text does not say."""
    amplitude_deg: tuple[float, float] | None
    """Lowest and highest, at the tip or at the root, as `control` says."""
    vibration_percent: tuple[float, float] | None
    """Lowest and highest change; negative is less vibration."""
    vibration: str
    """Which measure of vibration that is; empty without one."""
    power_percent: float | None
    """Change of rotor power as stated; negative is less."""
    lift_to_drag_percent: float | None
    """Change of the rotor's effective lift-to-drag ratio as stated; positive is better."""
    together: bool
    """Whether vibration and power belong to the same input at the same condition."""
    grade: str
    """P authors' own text, S press or another text that quotes them, T quoted by the source document."""
    source: str
    note: str

    @property
    def power_change_percent(self) -> float | None:
        """Change of power [%]: as stated, else that of L/D turned into power at the same lift and speed.

        P ∝ 1/(L/D), so ΔP/P = 1/(1 + ΔL/D) − 1; it counts the rotor's propulsive force as power.
        """
        if self.power_percent is not None or self.lift_to_drag_percent is None:
            return self.power_percent
        return 100.0 * (1.0 / (1.0 + 0.01 * self.lift_to_drag_percent) - 1.0)


@cache
def programmes() -> tuple[Programme, ...]:
    """All published results, in the order of the data file."""
    data = tomllib.loads(asset_path("active_twist_programmes.toml").read_text(encoding="utf-8"))
    return tuple(_programme(row) for row in data["programme"])


def _programme(row: dict[str, Any]) -> Programme:
    return Programme(
        name=row["name"],
        short=row["short"],
        rotor=row["rotor"],
        control=row["control"],
        kind=row["kind"],
        per_rev=tuple(row.get("per_rev", ())),
        amplitude_deg=_pair(row.get("amplitude_deg")),
        vibration_percent=_pair(row.get("vibration_percent")),
        vibration=row.get("vibration", ""),
        power_percent=row.get("power_percent"),
        lift_to_drag_percent=row.get("lift_to_drag_percent"),
        together=row["together"],
        grade=row["grade"],
        source=row["source"],
        note=row["note"],
    )


def _pair(values: list[float] | None) -> tuple[float, float] | None:
    if values is None:
        return None
    low, high = values
    return low, high
