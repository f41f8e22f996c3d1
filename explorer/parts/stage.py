"""What stands over the scene: the disk's field and plan, words at points of it, a section, the blade in the hand."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rotor.chart import DrawnChart


@dataclass(frozen=True)
class SceneLabel:
    """Words at a point of the scene."""

    text: str
    node: str
    """Name of the node that the point moves with."""
    at: Sequence[float]
    """x, y, z from its origin [m]."""
    title: str = ""
    """What is said where the pointer rests on it."""
    kind: str = ""
    """How its style sheet names it."""


@dataclass(frozen=True)
class TurnPart:
    """The reference blade's azimuth, and how the rotor turns by itself."""

    psi: float
    """[°]"""
    playing: bool
    pace: str
    held: bool
    """Whether a presenter moves the page."""


@dataclass(frozen=True)
class FieldPart:
    """The quantity on the disk, with its colour bar."""

    fields: Sequence[str]
    field: str
    unit: str
    colours: Sequence[str]
    ticks: Sequence[tuple[float, str]]
    """Place [% of the bar] and text of each."""
    faded: bool
    fitted: bool
    """Whether the range is fitted to the data."""
    regions: Mapping[str, bool]
    """Whether each region is shown."""
    stalled: str
    """How much of the disk is; empty: none."""
    difference: bool | None
    """Whether B − A is shown; None without A."""
    wipe: bool
    beyond: tuple[bool, bool]
    """Whether values lie below the range, and above."""
    held: bool
    """Whether a presenter moves the page."""


@dataclass(frozen=True)
class PackedTable:
    """Values of shape (radii, azimuths): `low` + `step` times each of the 16-bit numbers in `data`, little-endian in
    base 64.
    """

    low: float
    step: float
    data: str


@dataclass(frozen=True)
class PlanRegion:
    name: str
    title: str
    words: str
    """Its shares of disk and thrust."""
    lines: Sequence[Sequence[Sequence[float]]]
    """Its outline as polylines of points (right, down), in radii."""
    before: Sequence[Sequence[Sequence[float]]]
    """The outline for A."""


@dataclass(frozen=True)
class PlanPart:
    """Everything that the page's plan of the disk is drawn from."""

    picture: str
    """A PNG in base 64."""
    reach: float
    """Half the length of its edges, in radii."""
    root: float
    """Where the blade begins, in radii."""
    blades: int
    field: str
    unit: str
    regions: Sequence[PlanRegion]
    flight: str
    """Airspeed in words; empty in hover."""
    around: DrawnChart
    """The axes of the angle of attack over azimuth."""
    mu: float
    """Advance ratio along the disk."""
    values: Mapping[str, PackedTable] | None = None
    """What is read under the pointer, by name, once nothing moves: `psi` of the columns begins at zero, `r` of the rows
    goes from `root` to 1."""
    alpha_a: PackedTable | None = None
    """Angle of attack of A [°]."""
    held: str | None = None
    """What the outlines beside are of while the blade is in the hand; None: it is not."""


@dataclass(frozen=True)
class VibrationPart:
    """The row of the power card; without an index the sentence says why."""

    title: str
    index: str = ""
    unit: str = ""
    at: str = ""
    sentence: str = ""
    band: str = ""
    change: str = ""
    kind: str = ""


@dataclass(frozen=True)
class RidePart:
    """A section around the disk at equal steps of ψ from 0. Where the flow comes from the trailing edge, angles count
    from there.
    """

    r: float
    psi: float
    """Where the turn begins [°]."""
    out: float
    """Radius of the section [m]."""
    radius: float
    """Of the rotor [m]."""
    section: str
    outline: Sequence[Sequence[float]]
    u: Sequence[float]
    """Flow [m/s], negative from the trailing edge."""
    theta: Sequence[float]
    phi: Sequence[float]
    alpha: Sequence[float]
    cl: Sequence[float]
    mach: Sequence[float]
    lift: Sequence[float]
    """[kN/m]"""
    where: Sequence[str]
    region: Sequence[str]
    margin: Sequence[str | None]
    """To stall [°]; None where it has none."""
    angles: Sequence[float]
    """Of the lift curves [°]."""
    curves: Sequence[Sequence[float]]
    """C_l over them, a curve for each step of ψ."""
    chart: DrawnChart
    """The axes, with the path of the turn."""


@dataclass(frozen=True)
class RubberPart:
    """The blade that is twisted by hand, seen from the tip."""

    press: int
    """Another number each time that it is taken."""
    knot: str
    """The station that is held."""
    by: str
    """A "hand" on the blade, a "key", or a handle of the "curve"."""
    stations: Sequence[float]
    """r/R of each."""
    titles: Sequence[str]
    ends: Sequence[tuple[float, str]]
    """Twist [°] where a slider ends, and which: the lower end first."""


@dataclass(frozen=True)
class Knot:
    """A handle of the twist curve."""

    name: str
    title: str
    r: float
    theta: float
    """[°]"""


@dataclass(frozen=True)
class RoleLines:
    """Places of lines among the series of the twist curve."""

    this: int
    reference: int


@dataclass(frozen=True)
class TwistPart:
    """The twist curve of the rail, with its handles."""

    chart: DrawnChart
    knots: Sequence[Knot]
    places: RoleLines
    """The blade in the hand is drawn from these lines."""
