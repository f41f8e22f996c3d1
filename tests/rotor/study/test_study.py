"""Studies: the file, the order of points, rows, the folder, and reading its results."""

import csv
import errno
import importlib
import io
import json
import math
import signal
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from rotor import Design, hub_loads, make_design, run_study, solve
from rotor.__main__ import main
from rotor.command.common import interruptible
from rotor.command.study import record, report
from rotor.study import point as study_point
from rotor.study.chunks import (
    FinishedChunk,
    StudyFolder,
    StudyProvenance,
    evaluate_chunk,
    evaluate_points,
    is_undamaged,
)
from rotor.study.point import WarmStarts
from rotor.study.results import Results, best_row, main_effects, read_results, robust_best
from rotor.study.study import QUANTITIES, StudyAxis, StudyPoints, StudySample, columns_of
from rotor.study.study_file import StudyFile, parse_study, read_study
from rotor.support.assets import asset_path
from rotor.trim import Analysis, analyse

WHENCE = StudyProvenance("0.0", None, "0")
COARSE = '[models]\ninflow = "pitt-peters"\nelements = 12\nazimuths = 24\n'
SMALL = (
    'chunk = 4\n[axes]\nmu = [0.1, 0.2, 0.3]\nrate_deg = [-16, -8]\n[fixed]\nconcept = "linear"\n'
    + COARSE
)


def test_points_are_in_small_steps_and_need_no_memory():
    axes = (
        StudyAxis("mu", (0.0, 0.1, 0.2, 0.3)),
        StudyAxis("mass_kg", (1.0, 2.0)),
        StudyAxis("inflow", ("a", "b", "c")),
    )
    places = StudyPoints(axes, StudySample("sobol", 5, 0, (("altitude_m", 0.0, 100.0),)))
    points = places.at(0, places.count)
    assert len(points) == 4 * 2 * 3 * 5 == len({tuple(sorted(point.items())) for point in points})
    for before, after in pairwise(points):
        changed = [name for name in before if before[name] != after[name]]
        assert len(changed) == 1
        for axis in axes:
            if axis.name in changed:
                at = [axis.values.index(point[axis.name]) for point in (before, after)]  # type: ignore[arg-type]
                assert abs(at[0] - at[1]) == 1
    assert places.at(37, 41) == points[37:41]
    assert sum(a["inflow"] != b["inflow"] for a, b in pairwise(points)) == 2  # Texts are slowest.
    axis = tuple(float(k) for k in range(1000))
    places = StudyPoints(
        (StudyAxis("mu", axis), StudyAxis("mass_kg", axis), StudyAxis("altitude_m", axis)), None
    )
    assert places.count == 10**9
    assert places.at(10**9 - 1, 10**9)[0]["mu"] == 999.0


@pytest.mark.parametrize("method", ["sobol", "latin-hypercube"])
def test_samples_fill_their_ranges_and_are_ordered_in_small_steps(method: Any):
    places = StudyPoints(
        (), StudySample(method, 500, 3, (("mu", 0.1, 0.3), ("mass_kg", 6000.0, 9000.0)))
    )
    points = np.array([[point["mu"], point["mass_kg"]] for point in places.at(0, 500)])
    unit = (points - [0.1, 6000.0]) / [0.2, 3000.0]
    assert ((unit >= 0.0) & (unit <= 1.0)).all()
    assert_allclose(unit.mean(axis=0), 0.5, atol=0.01)
    step = np.sqrt((np.diff(unit, axis=0) ** 2).sum(axis=1)).mean()
    assert step < 3.0 / math.sqrt(500)  # At random it would be 0.52.


STAND = "[axes]\nmu = [0.1]\n[models]\ntrim = 'wind-tunnel'\n[fixed]\nrotor = 'xv15'\n"
BAD = {
    "axes": ("[axes\n", "line 1", "not TOML"),
    "none": ("title = 'x'\n", "no axes", "add"),
    "unknown quantity": ("[axes]\nspeed = [0.1]\n", "line 2", "mu"),
    "text": ("[axes]\nmu = ['fast']\n", "line 2", "not a number"),
    "empty": ("[axes]\nmu = []\n", "line 2", "give at least one"),
    "twice": ("[axes]\nmu = [0.1, 0.1]\n", "line 2", "remove one"),
    "both": ("[axes]\nmu = [0.1]\n[fixed]\nmu = 0.2\n", "line 4", "remove one"),
    "inflow": ("[axes]\nmu = [0.1]\n[models]\ninflow = 'free'\n", "line 4", "'free'"),
    "sample missing": ("[axes]\nmu = { low = 0.1, high = 0.3 }\n", "line 2", "[sample]"),
    "parameter": ("[axes]\nrate_deg = [-8]\n", "line 2", "concept"),
    "missing parameter": ("[axes]\ninboard_rate_deg = [-8]\n[fixed]\nconcept = 'two-segment'\n", "outboard", "add"),
    "no concept": ("[axes]\nmu = [0.1]\n[optimum]\n", "concept", "add"),
    "steep blade": ("[axes]\nmu = [0.1]\n[fixed]\nconcept = 'linear'\nrate_deg = -9.9e29\n", "line 5", "100"),
    "uncertain": ("[axes]\nmu = [0.1]\n[show]\nuncertain = ['wind']\n", "line 4", "mu"),
    "rotor": ("[axes]\nrotor = ['uh60a', 'mine.toml']\n", "line 2", "mine.toml"),
    "table": ("[axes]\nmu = [0.1]\n[fixed]\ntwist = 'table:mine.csv'\n", "line 4", "mine.csv"),
    "no section": ("axes = 3\n", "line 1", "axes is 3, not a table"),
    "heading of a key": ("[axes.mu]\nlow = 0.1\nhigh = 0.9\n[sample]\ncount = 8\n", "line 1", "0.9"),
    "long range": ("[axes]\nmu = '0.1:0.3:0.00001'\n", "line 2", "larger step"),
    "half an element": ("[axes]\nmu = [0.1]\n[models]\nelements = 40.5\n", "line 4", "whole number"),
    "twist and optimum": ("[axes]\nmu = [0.1]\n[fixed]\ntwist = 'ideal'\n[optimum]\n", "line 4", "omit twist"),
    "partly sampled": (
        "[axes]\nmu = { low = 0.1, high = 0.3 }\nmass_kg = { low = 7000, high = 8000 }\n[sample]\ncount = 8\n"
        "[show]\nuncertain = ['mu']\n", "line 7", "list of values"),
    "stand load": (f"{STAND}stand_tip_mach = 0.6\n", "give one of thrust_n, ct_over_sigma and collective_deg"),
    "speeds": ("[axes]\nspeed_kt = [90]\nmu = [0.1]\n", "line 2", "omit one"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_a_bad_study_file_is_one_sentence(name: str, tmp_path: Path, refused: Callable[..., str]):
    text, *words = BAD[name]
    path = tmp_path / "bad.toml"
    path.write_text(text, encoding="utf-8")
    said = refused("study", str(path), "--out", str(tmp_path / "out"))
    for word in ("bad.toml", *words):
        assert word in said
    assert not (tmp_path / "out").exists()


STANDS = """
[axes]
stand_shaft_tilt_deg = [15, 30]
[fixed]
rotor = "xv15"
mu = 0.15
stand_ct_over_sigma = 0.075
stand_tip_mach = 0.691
[models]
trim = "wind-tunnel"
inflow = "uniform"
"""


def alone_in_flight(row: dict[str, Any]) -> Design:
    twist = f"linear:{row['rate_deg']:g}"
    return make_design(twist=twist, mu=row["mu"], inflow="pitt-peters", elements=12, azimuths=24)


def alone_on_a_stand(row: dict[str, Any]) -> Design:
    stand = {
        "shaft_tilt_deg": row["stand_shaft_tilt_deg"],
        "ct_over_sigma": 0.075,
        "tip_mach": 0.691,
    }
    return make_design(rotor="xv15", mu=0.15, trim="wind-tunnel", stand=stand, inflow="uniform")


@pytest.mark.parametrize(("text", "asked"), [(SMALL, alone_in_flight), (STANDS, alone_on_a_stand)])
def test_rows_agree_with_single_trims(text: str, asked: Callable[[dict[str, Any]], Design]):
    study = parse_study(text)
    for row in evaluate_points(study, 0, study.count):
        design = asked(row)
        alone = solve(design)
        assert (row["status"], row["twist"]) == ("converged", design.twist.spec())
        assert_allclose(row["power_total_w"], alone.power.total, rtol=1e-8)
        assert_allclose(row["collective_deg"], math.degrees(alone.controls.collective), rtol=1e-7)


@pytest.mark.parametrize("inflow", ["pitt-peters", "lifting-line"])
def test_a_point_is_the_design_of_the_same_arguments(inflow: str):
    given = {"mu": 0.2, "inflow": inflow, "elements": 12, "azimuths": 24, "mass_kg": 8000.0}
    assert study_point.design_of(given, {}) == make_design(**given)


def test_points_of_one_condition_in_step_have_the_rows_that_they_have_alone(
    monkeypatch: pytest.MonkeyPatch,
):
    """One that does not trim, or that fails, leaves the others."""
    text = '[axes]\nmu = [0.2, 0.3]\nrate_deg = [-18, -15, 90, -14]\n[fixed]\nconcept = "linear"\n'
    study = parse_study(text)
    alone = [
        study_point.evaluate(values, study, WarmStarts({}))
        for values in study.values(0, study.count)
    ]
    by_themselves = list[str]()

    def recorded(design: Design, *rest: Any) -> Analysis:
        by_themselves.append(design.twist.spec())
        return analyse(design, *rest)

    monkeypatch.setattr(study_point, "analyse", recorded)
    rows = evaluate_points(study, 0, study.count)
    assert by_themselves == ["linear:90"] * 2
    assert {row["status"] for row in rows} == {"converged", "not-converged"}
    for row, one in zip(rows, alone, strict=True):
        del row["elapsed_ms"], one["elapsed_ms"]
        assert row.pop("point") in range(8)
        assert row == {
            name: pytest.approx(x, rel=1e-11, abs=1e-11) if isinstance(x, float) else x
            for name, x in one.items()
        }


def test_a_users_rotor_and_table_are_part_of_the_study(tmp_path: Path):
    """A worker has none of the user's files, so their contents are in the study."""
    (tmp_path / "mine.toml").write_text(
        asset_path("r22.toml").read_text(encoding="utf-8"), encoding="utf-8"
    )
    (tmp_path / "twist.csv").write_text("0.1, 5\n1, -5\n")
    text = (
        f'[axes]\nrotor = ["mine.toml", "s61"]\n[fixed]\ntwist = "table:{tmp_path}/twist.csv"\n'
        + COARSE
    )
    (tmp_path / "study.toml").write_text(text, encoding="utf-8")
    study = read_study(tmp_path / "study.toml").study
    for name in ("mine.toml", "twist.csv"):
        (tmp_path / name).unlink()
    rows = evaluate_points(study, 0, 2)
    assert [row["status"] for row in rows] == ["converged", "converged"]
    assert [row["rotor"] for row in rows] == ["mine.toml", "s61"]
    assert rows[0]["mass_kg"] < 700.0 < rows[1]["mass_kg"]
    assert rows[0]["twist"] == "points:5,-5@0.1,1"


def test_the_row_of_an_optimum_has_its_results():
    text = (
        '[axes]\nmu = [0.2]\n[fixed]\nconcept = "two-segment"\ndivision = 0.6\n[optimum]\nstarts = 1\n'
        + COARSE
    )
    (row,) = evaluate_points(parse_study(text), 0, 1)
    assert row["status"] == "converged"
    assert row["division"] == 0.6
    assert row["twist"].endswith("@0.6")
    assert row["twist"].startswith(f"segments:{row['inboard_rate_deg']:.6f}".rstrip("0"))
    assert_allclose(row["mean_power_w"], row["power_total_w"], rtol=1e-8)
    assert row["saving_percent"] > 0.0


def test_a_failed_point_is_a_row_with_a_message(monkeypatch: pytest.MonkeyPatch):
    heavy = parse_study(
        "[axes]\nmass_kg = [8000, 30000]\n[fixed]\nmu = 0\naltitude_m = 4000\n" + COARSE
    )
    rows = evaluate_points(heavy, 0, 2)
    assert [row["status"] for row in rows] == ["converged", "not-converged"]
    assert "lower" in rows[1]["message"]
    assert "power_total_w" not in rows[1]
    crossed = (
        '[axes]\ninner_break = [0.3, 0.9]\n[fixed]\nconcept = "three-segment"\nouter_break = 0.8\n'
    )
    rates = "inboard_rate_deg = -8\nmiddle_rate_deg = -8\noutboard_rate_deg = -8\n"
    with pytest.raises(ValueError, match="ascend"):
        parse_study(crossed + rates)  # Where one value alone is at fault, the file says so …
    both = crossed.replace("[0.3, 0.9]", "[0.3, 0.7]").replace("outer_break = 0.8\n", "") + rates
    both = both.replace("[fixed]", "outer_break = [0.8, 0.5]\n[fixed]")
    statuses = [row["status"] for row in evaluate_points(parse_study(both + COARSE), 0, 4)]
    # … where a pair is, the row does.
    assert sorted(statuses) == [
        "bad-input",
        "converged",
        "converged",
        "converged",
    ]
    monkeypatch.setattr("rotor.study.point.analyse", lambda *_: 1 / 0)
    (row,) = evaluate_points(parse_study("[axes]\nmu = [0.1]\n"), 0, 1)
    assert (row["status"], row["message"]) == ("error", "ZeroDivisionError: division by zero")


def test_a_guess_is_exact_for_quadratic_variation_and_the_nearest_trim_far_out():
    def collective(mu: float, mass: float) -> float:
        return 0.1 + 0.2 * mu + 1e-5 * mass - 0.4 * mu**2 + 3e-5 * mu * mass + 2e-8 * mass**2

    solution, memory = (
        solve(make_design(inflow="uniform")),
        WarmStarts({"mu": (0.0, 1.0), "mass_kg": (0.0, 2000.0)}),
    )
    for mu, mass in (np.random.default_rng(1).random((30, 2)) * [1.0, 2000.0]).tolist():
        start = replace(
            solution.start, state=replace(solution.controls, collective=collective(mu, mass))
        )
        memory.keep(
            {"mu": mu, "mass_kg": mass, "inflow": "uniform"}, replace(solution, start=start)
        )

    def guess(mu: float, mass: float) -> float:
        found = memory.guess({"mu": mu, "mass_kg": mass, "inflow": "uniform"}, hovering=False)
        return found.state.collective

    assert_allclose(guess(0.4, 900.0), collective(0.4, 900.0), rtol=1e-5)
    assert abs(guess(40.0, 900.0) - collective(0.0, 0.0)) < 1.0  # The quadratic itself gives −600.
    point = {"mu": 0.4, "mass_kg": 900.0, "inflow": "uniform"}
    assert (
        memory.guess(point | {"inflow": "drees"}, hovering=False)
        is memory.guess(point, hovering=True)
        is None
    )


def stored(folder: Path, text: str = SMALL, whence: StudyProvenance = WHENCE) -> StudyFolder:
    return StudyFolder(folder, StudyFile(parse_study(text), text, "study.toml"), whence)


@pytest.fixture
def done(monkeypatch: pytest.MonkeyPatch) -> Callable[[StudyFolder, int], FinishedChunk]:
    monkeypatch.setattr("rotor.study.chunks.package_version", lambda: WHENCE.version)
    return lambda store, chunk: evaluate_chunk(store.study, chunk, WHENCE)


def test_a_study_continues_from_its_folder(
    tmp_path: Path, done: Callable[[StudyFolder, int], FinishedChunk]
):
    store = stored(tmp_path / "out")
    with pytest.raises(ValueError, match="another run writes"):
        stored(tmp_path / "out")
    made = done(store, 1)
    store.keep(1, made.content)
    assert (made.rows, made.failures) == (2, 0)
    store.close()
    (store.folder / ".chunk-000000.parquet.part").write_bytes(b"half")
    (store.folder / "chunk-000000.parquet").write_bytes(b"PAR1 and no more")
    again = stored(tmp_path / "out", SMALL.replace("chunk = 4", "title = 'other words'\nchunk = 4"))
    assert again.missing() == [0]
    assert not list(store.folder.glob(".*.part"))
    again.close()
    with pytest.raises(ValueError, match="holds another study"):
        stored(tmp_path / "out", SMALL.replace("0.3]", "0.31]"))
    for other in (replace(WHENCE, version="0.1"), replace(WHENCE, commit="abc")):
        with pytest.raises(
            ValueError, match=r"computed by rotor-explorer 0\.0, this is .*: give another --out DIR"
        ):
            stored(tmp_path / "out", whence=other)
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("dear")
    with pytest.raises(ValueError, match="holds other files"):
        stored(tmp_path / "mine")


def test_a_damaged_chunk_is_refused_and_computed_again(
    tmp_path: Path, done: Callable[[StudyFolder, int], FinishedChunk], refused: Callable[..., str]
):
    """Of 400 flipped bits 25 were read as other numbers."""
    store = stored(tmp_path / "out")
    for chunk in (0, 1):
        store.keep(chunk, done(store, chunk).content)
    store.close()
    damaged = store.folder / "chunk-000001.parquet"
    whole = damaged.read_bytes()
    flipped = [
        bytes((*whole[:k], whole[k] ^ 1 << k % 8, *whole[k + 1 :]))
        for k in range(0, len(whole), 11)
    ]
    assert is_undamaged(whole)
    assert not any(map(is_undamaged, flipped))
    for content in (
        whole[:-3],
        whole[: len(whole) // 2],
        b"",
        bytes(reversed(whole)),
        *flipped[::40],
    ):
        damaged.write_bytes(content)
        sentence = refused("study", "show", str(store.folder))
        assert "chunk-000001.parquet" in sentence
        assert "run the study again" in sentence
    said: list[str] = []
    again = stored(tmp_path / "out")
    assert again.missing(said.append) == [1]
    assert said == [
        "chunk-000001.parquet is damaged: it is now _chunk-000001.parquet, and its points are computed again"
    ]
    again.keep(1, whole)
    assert again.missing(said.append) == []
    assert read_results(again.folder).rows == 6
    again.keep(1, evaluate_chunk(again.study, 1, replace(WHENCE, commit="abc")).content)
    assert again.missing(said.append) == [1]
    assert "was computed by rotor-explorer 0.0 at commit abc, this is rotor-explorer 0.0" in said[1]


@pytest.mark.parametrize(
    "error", [MemoryError("no more"), OSError(errno.ENOMEM, "no more"), SystemError("kernel")]
)
def test_a_lack_of_memory_is_no_result(
    error: Exception, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    if isinstance(error, SystemError):
        error.__cause__ = MemoryError()
    (file := tmp_path / "small.toml").write_text(SMALL)
    failures = [error] * 2

    def starved(*arguments: Any) -> Analysis:
        if failures:
            raise failures.pop()
        return analyse(*arguments)

    monkeypatch.setattr("rotor.study.point.analyse", starved)
    with ThreadPoolExecutor(1) as worker:
        assert run_study(file, worker, out=tmp_path / "out").good.all()
        failures.extend([error] * 5)
        with pytest.raises(
            RuntimeError, match="1 chunk stopped their workers, perhaps for lack of memory"
        ):
            run_study(file, worker, out=tmp_path / "again")
        assert run_study(file, worker, out=tmp_path / "again").good.all()


def test_files_have_units_and_provenance(
    tmp_path: Path, done: Callable[[StudyFolder, int], FinishedChunk]
):
    parquet: Any = importlib.import_module("pyarrow.parquet")
    store = stored(tmp_path / "out")
    for chunk in range(2):
        store.keep(chunk, done(store, chunk).content)
    schema = parquet.read_schema(tmp_path / "out" / "chunk-000000.parquet")
    assert schema.field("power_total_w").metadata == {b"unit": b"W"}
    about = {key.decode(): value.decode() for key, value in schema.metadata.items()}
    assert about["study"] == store.study.fingerprint
    assert about["package_version"] == "0.0"
    assert json.loads(about["units"])["mass_kg"] == "kg"
    assert json.loads(about["PANDAS_ATTRS"])["units"] == json.loads(about["units"])
    units = [
        QUANTITIES[f"stand_{key}"].unit
        for key in ("shaft_tilt_deg", "thrust_n", "hub_roll_nm", "density_kg_m3")
    ]
    assert units == ["°", "N", "N m", "kg/m³"]
    models = json.loads(about["models"])
    assert (models["inflow"], models["elements"], models["trim"], models["tip_loss"]) == (
        "pitt-peters", 12, "propulsive", True
    )  # fmt: skip
    results = read_results(tmp_path / "out")
    assert_array_equal(results.columns["point"], np.arange(6))
    assert parquet.read_table(tmp_path / "out").num_rows == 6  # As pandas reads a folder.


def test_show_is_text_and_json(
    tmp_path: Path, done: Callable[[StudyFolder, int], FinishedChunk], printed: Callable[..., str],
    answer: Callable[..., Any], refused: Callable[..., str],
):  # fmt: skip
    store, show = stored(tmp_path / "out"), ("study", "show", str(tmp_path / "out"))
    store.keep(0, done(store, 0).content)
    store.close()
    shown = answer(*show, "--uncertain", "mu")
    assert (shown["points"], shown["done"], shown["failed"]) == (6, 4, 0)
    assert shown["best"]["status"] == "converged"
    out = printed(*show, "--least", "power_induced_w")
    assert "least power_induced_w" in out
    assert "depends on, from the finished points" in out
    rows = list(csv.DictReader(io.StringIO(printed(*show, "--csv", "-"))))
    assert [float(row["point"]) for row in rows] == read_results(tmp_path / "out").columns[
        "point"
    ].tolist()
    assert min(float(row["power_total_w"]) for row in rows) == shown["best"]["power_total_w"]
    assert "noise" in refused(*show, "--least", "noise")


def results_of(**columns: Any) -> Results:
    axes = tuple(name for name in columns if name not in ("power_total_w", "status"))
    rows = len(columns["power_total_w"])
    made = {
        name: np.array(values, dtype=object if name == "kind" else float)
        for name, values in columns.items()
    }
    made |= {
        "point": np.arange(rows, dtype=float),
        "status": np.array(["converged"] * rows, dtype=object),
    }
    return Results({"points": rows}, axes, made)


def test_best_and_robust_best_by_hand():
    """Design b has the least of all, c the least worst case, a the least mean; d failed in one case."""
    powers = {"a": (1.0, 9.0), "b": (0.5, 12.0), "c": (5.5, 6.0), "d": (0.1, math.nan)}
    results = results_of(
        kind=[name for name in powers for _ in range(2)],
        mu=[0.1, 0.3] * 4,
        power_total_w=[power for pair in powers.values() for power in pair],
    )
    results.columns["status"][7] = "not-converged"
    assert best_row(results, "power_total_w") == 6
    robust = robust_best(results, "power_total_w", ("mu",))
    assert (robust.least_worst.design, robust.least_worst.worst) == ({"kind": "c"}, 6.0)
    assert (robust.least_mean.design, robust.least_mean.mean) == ({"kind": "a"}, 5.0)
    assert (robust.designs, robust.dropped, robust.least_mean.cases) == (3, 1, 2)


def test_effects_share_the_variance_by_the_formula():
    """f = 3x + y on a full grid: Var x-part : Var y-part = 9 : 1, no free parameter left for z."""
    grid = np.array(np.meshgrid([0.0, 1.0], [0.0, 1.0], [0.0, 1.0], indexing="ij")).reshape(3, -1)
    results = results_of(x=grid[0], y=grid[1], z=grid[2], power_total_w=3.0 * grid[0] + grid[1])
    found = {one.axis: one for one in main_effects(results, "power_total_w")}
    assert_allclose([found[name].share for name in "xyz"], [0.9, 0.1, 0.0], atol=1e-12)
    assert (found["x"].least_at, found["x"].most_at, found["x"].most) == (0.0, 1.0, 3.5)
    many = np.linspace(0.0, 1.0, 1000)
    fine = main_effects(results_of(x=many, power_total_w=many), "power_total_w")[0]
    # Tenths see all but 1/100 of a straight line's variance.
    assert_allclose(fine.share, 0.99, atol=1e-3)


def test_a_small_sample_is_not_reported_as_an_effect():
    """Power depends on x alone; with a level for each of sixteen points y would have all of the variance as well."""
    x, y = np.random.default_rng(0).random((2, 16))
    results = results_of(x=x, y=y, power_total_w=x)
    results.about["axes"] = {name: {"low": 0.0, "high": 1.0} for name in "xy"}
    found = {one.axis: one.share for one in main_effects(results, "power_total_w")}
    assert found["x"] > 0.5
    assert found["y"] < 0.2
    words = {"message": None, "twist": "linear:-8", "caveats": None}
    results.columns.update({name: np.full(16, word, dtype=object) for name, word in words.items()})
    assert "rough: 16 points of a sample; with fewer than 100, chance" in report(
        results, record(results)
    )


def test_show_gives_every_effect_in_the_unit_of_what_is_least():
    grid = np.array(np.meshgrid([0.0, 1.0], [0.0, 1.0], indexing="ij")).reshape(2, -1)
    results = results_of(x=grid[0], y=grid[1], power_total_w=1e6 + 2e5 * grid[0] + 1e5 * grid[1])
    words = {"message": None, "twist": "linear:-8", "caveats": None}
    results.columns.update({name: np.full(4, word, dtype=object) for name, word in words.items()})
    results.about["units"] = {"power_total_w": "W"}
    said = report(results, record(results))
    effects = [line for line in said.splitlines() if " % " in line]
    assert [line.count(" kW at ") for line in effects] == [2, 2]


def test_show_counts_the_caveats_of_points():
    """Those of the points by name, the most frequent first, and where their sentences are."""
    results = results_of(mu=[0.1, 0.2, 0.3, 0.4], power_total_w=[4.0, 1.0, 2.0, 3.0])
    caveats = ["stall", None, "", "controls, stall"]
    results.columns.update(
        message=np.full(4, None),
        twist=np.full(4, "linear:-8"),
        caveats=np.array(caveats, dtype=object),
    )
    shown = record(results)
    assert list(shown["caveats"].items()) == [("stall", 2), ("controls", 1)]
    said = " ".join(report(results, shown).split())
    assert (
        "caveats of points: stall at 2, controls at 1; python -m rotor solve --row DIR:1 says more"
        in said
    )


def test_one_ctrl_c_received_twice_counts_once():
    with interruptible() as stop:
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
        assert stop()


def test_hub_loads_and_frequencies_are_columns_of_blades_that_bend():
    text = SMALL.replace("[models]", "[models]\nbending = true").replace(
        "elements = 12\nazimuths = 24\n", ""
    )
    study = parse_study(text)
    rows = evaluate_points(study, 0, study.count)
    slow, fast = (
        next(row for row in rows if row["mu"] == mu and row["rate_deg"] == -8) for mu in (0.1, 0.3)
    )
    assert "index_percent" not in slow
    for row in (slow, fast):
        alone = solve(
            make_design(twist="linear:-8", mu=row["mu"], inflow="pitt-peters", bending=True)
        )
        assert row["caveats"] == ", ".join(caveat.name for caveat in alone.caveats)
    assert "no-hub-loads" in slow["caveats"]
    design = make_design(twist="linear:-8", mu=0.3, inflow="pitt-peters", bending=True)
    loads = hub_loads(solve(design))
    assert_allclose(
        (fast["index_percent"], fast["hub_fz_n"]), (loads.index, loads.amplitudes["fz"]), rtol=1e-4
    )
    assert 2.7 < slow["flap_2_per_rev"] < 2.9
    names = {column.name for column in columns_of(study)}
    assert {"index_percent", "hub_mx_nm", "torsion_1_per_rev"} <= names


SMALLER = {
    "hover_cruise.toml": {'"-30:2:2"': '"-30:2:8"'},
    "hundred_thousand.toml": {"100_000": "48"},
    "two_segment.toml": {
        '"0.10:0.35:0.05"': "[0.1, 0.35]", "[0, 1000, 2000]": "[2000]", "[7000, 8322.4, 9500]": "[7000, 9500]",
    },
}  # fmt: skip
"""What makes a shipped study shorter, its limits kept: 300 points of 3468, 48 and 20."""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "shorter"),
    [*SMALLER.items(), pytest.param("hover_cruise.toml", {}, marks=pytest.mark.nightly)],
)
def test_shipped_studies_run_to_their_end(name: str, shorter: dict[str, str], tmp_path: Path):
    """Exit code 0: every point converged."""
    text = asset_path("studies").joinpath(name).read_text(encoding="utf-8")
    for long, short in shorter.items():
        assert long in text
        text = text.replace(long, short)
    file = tmp_path / name
    file.write_text(text, encoding="utf-8")
    assert main(["study", str(file), "--out", str(tmp_path / "out"), "--workers", "1"]) == 0
    assert read_results(tmp_path / "out").good.all()
