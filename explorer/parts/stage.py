"""What stands over the scene: the disk's field and plan, words at points of it, a section, the blade in the hand."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rotor.support.chart import DrawnChart


@dataclass(frozen=True)
class SceneLabel:
    """Words at a point of the scene, which moves with a node: x, y, z from its origin [m].

    `title`: what is said where the pointer rests on it. `kind`: how the style sheet names it.
    """

    text: str
    node: str
    at: Sequence[float]
    title: str = ""
    kind: str = ""


@dataclass(frozen=True)
class TurnPart:
    """The reference blade's azimuth [°], and whether the rotor turns by itself."""

    psi: float
    playing: bool


@dataclass(frozen=True)
class FieldPart:
    """The quantity on the disk, with its colour bar.

    `ticks`: place [% of the bar] and text of each. `fitted`: the range is fitted to the data; `beyond`: values lie
    below it, and above. `regions`: whether each is shown; `shares`: of the disk, or "none". `difference`: whether
    B − A is shown; None without A.
    """

    fields: Sequence[str]
    field: str
    unit: str
    colours: Sequence[str]
    ticks: Sequence[tuple[float, str]]
    stale: bool
    fitted: bool
    regions: Mapping[str, bool]
    shares: Mapping[str, str]
    difference: bool | None
    wipe: bool
    beyond: tuple[bool, bool]


@dataclass(frozen=True)
class PackedTable:
    """Values of shape (radii, azimuths): `low` + `step` times each of the 16-bit numbers in `data`, little-endian in
    base 64.
    """

    low: float
    step: float
    data: str


@dataclass(frozen=True)
class StationValues:
    """What is read under the pointer: `tables` by name at the solver's own stations, `r` of the rows [R], azimuths at
    even steps from `first` [°]. Between them the page goes as `explorer.picture.element.probe` does.
    """

    r: Sequence[float]
    first: float
    tables: Mapping[str, PackedTable]


@dataclass(frozen=True)
class PlanRegion:
    """A region with its shares of disk and thrust in words; its outline, and that of A, as polylines of points
    (right, down), in radii.
    """

    name: str
    title: str
    words: str
    lines: Sequence[Sequence[Sequence[float]]]
    before: Sequence[Sequence[Sequence[float]]]


@dataclass(frozen=True)
class RegionPrice:
    """Words below a region of the disk; `press`: on the button that switches it off or on, where there is one."""

    lines: Sequence[str]
    stale: bool = False
    press: str = ""


@dataclass(frozen=True)
class PlanDisk:
    """The field on the disk as numbers of `explorer.picture.disk_numbers`, by radius and azimuth.

    `values`: 1…255 into `map`, 256 colours as hexadecimal digits; 0 where the field does not exist. `flow`: margin of
    reverse flow, where that has no field; None: it has one. `none`: the colour there.
    """

    radii: int
    azimuths: int
    values: str
    flow: str | None
    map: str
    none: str


@dataclass(frozen=True)
class PlanPart:
    """Everything that the page's plan of the disk is drawn from; lengths are in radii.

    `root`: where the blade begins. `sides`: what lies at ψ = 0°, 90°, 180° and 270°. `flight`: airspeed in
    words. `around`: the axes of the angle of attack over azimuth. `mu`: advance ratio along the disk. `values`: what is
    read under the pointer once nothing moves, `before` that of A. `coloured`: the field itself; `psi` of the columns
    begins at zero, `r` of the rows goes from `root` to 1. `held`: what the outlines beside are of while the blade is in
    the hand; None: it is not. `wiped`: the field of A, seen left of the handle while A is wiped over B.
    """

    disk: PlanDisk
    root: float
    blades: int
    field: str
    unit: str
    regions: Sequence[PlanRegion]
    sides: Sequence[str]
    flight: str
    around: DrawnChart
    mu: float
    values: StationValues | None = None
    before: StationValues | None = None
    coloured: PackedTable | None = None
    held: str | None = None
    wiped: PlanDisk | None = None


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
    from there, and the flow `u` [m/s] is negative.

    `psi`: where the turn begins. `out`: radius of the section [m]. `eye`, `look`: where the camera stands and looks,
    from the section out, ahead and up [m]; `view`: its field of view [°]. Angles [°], lift [kN/m]. `margin`: to stall;
    `filled`: α over the stall angle on its side; both None where it has none. `seen`: a sentence on what a viewer
    sees. `static`: C_l of the static lift curve at α; `stall`: the positive static stall angle, None where sections do
    not stall. `curves`: that C_l over `angles`, a curve for each step of ψ. `chart`: the axes, with the path of the
    turn.
    """

    r: float
    psi: float
    out: float
    eye: Sequence[float]
    look: Sequence[float]
    view: float
    section: str
    outline: Sequence[Sequence[float]]
    u: Sequence[float]
    theta: Sequence[float]
    phi: Sequence[float]
    alpha: Sequence[float]
    cl: Sequence[float]
    mach: Sequence[float]
    lift: Sequence[float]
    where: Sequence[str]
    region: Sequence[str]
    margin: Sequence[str | None]
    filled: Sequence[float | None]
    seen: Sequence[str]
    static: Sequence[float]
    stall: Sequence[float | None]
    angles: Sequence[float]
    curves: Sequence[Sequence[float]]
    chart: DrawnChart


@dataclass(frozen=True)
class RideCostPart:
    """What separated flow costs the whole rotor. `words`: the price, or why there is none.

    `spent`: its sum from ψ = 0 to ψ at equal steps over the turn, both ends included, in the `unit`; the last is the
    price. Empty where there is none, or it is not known yet.
    """

    words: str
    spent: Sequence[float]
    unit: str
    stale: bool


@dataclass(frozen=True)
class TwistingPart:
    """The blade that is twisted by hand, seen from the tip.

    `press`: another number each time that it is taken. `knot`: the station that is held, `by` a "hand" on the blade, a
    "key", or a handle of the "curve". `stations`: r/R. `ends`: twist [°] where a slider ends, and which: the lower end
    first.
    """

    press: int
    knot: str
    by: str
    stations: Sequence[float]
    titles: Sequence[str]
    ends: Sequence[tuple[float, str]]


@dataclass(frozen=True)
class Knot:
    """A handle of the twist curve, at r/R and a twist [°]."""

    name: str
    title: str
    r: float
    theta: float


@dataclass(frozen=True)
class RoleLines:
    """Places of lines among the series of the twist curve."""

    this: int
    reference: int


@dataclass(frozen=True)
class TwistPart:
    """The twist curve of the rail, with its handles; the blade in the hand is drawn from the lines at `places`."""

    chart: DrawnChart
    knots: Sequence[Knot]
    places: RoleLines
