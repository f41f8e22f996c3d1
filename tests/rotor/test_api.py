"""The public API: the examples of its docstrings, tables and pictures, and no side effects of importing."""

import csv
import doctest
import inspect
import json
import math
import pathlib
import re
import subprocess
import sys
import urllib.request
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import pyarrow
import pytest
from matplotlib import pyplot
from numpy.testing import assert_allclose

import explorer
import rotor
import rotor.command.validate
from rotor.__main__ import main
from rotor.design.twist import LinearTwist, PiecewiseLinearTwist, parse_twist
from rotor.support.units import KNOT
from rotor.trim.analysis import power_gradient

matplotlib.use("Agg")
ROOT = Path(__file__).parent.parent.parent


@pytest.fixture(scope="module")
def design() -> rotor.Design:
    return rotor.make_design(twist="linear:-12", mu=0.2)


@pytest.fixture(scope="module")
def solution(design: rotor.Design) -> rotor.Solution:
    return rotor.solve(design).require()


@pytest.fixture(scope="module")
def failed(design: rotor.Design) -> rotor.Solution:
    found = rotor.solve(design.at(hover=True, mass_kg=18_000))
    assert not found.converged
    return found


@pytest.mark.slow
def test_the_page_of_a_design_is_served_until_it_is_stopped():
    """Notebooks on this machine may show it in a frame."""
    page = explorer.show(rotor.make_design(twist="linear:-12", mu=0.2), browser=False)
    try:
        answer = urllib.request.urlopen(page.address, timeout=60)
        assert answer.status == 200
        assert (
            "frame-ancestors 'self' http://localhost:*" in answer.headers["Content-Security-Policy"]
        )
        assert page.address in page._repr_html_()
    finally:
        page.stop()
    with pytest.raises(OSError, match="refused"):
        urllib.request.urlopen(page.address, timeout=60)


EXPLAINED = (
    "make_design",
    "solve",
    "solve_many",
    "sweep",
    "optimise",
    "schedule",
    "run_study",
    "doubt",
)


@pytest.mark.parametrize("name", EXPLAINED)
def test_the_example_of_a_docstring_runs(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    names = {"rotor": rotor, "pathlib": pathlib}
    (example,) = doctest.DocTestFinder(recurse=False).find(
        inspect.unwrap(getattr(rotor, name)), name, globs=names
    )
    assert example.examples
    results = doctest.DocTestRunner().run(example)
    assert results.failed == 0


def test_a_schedule_is_that_of_each_speed_and_never_worse_than_the_fixed_blade(
    design: rotor.Design,
):
    made = rotor.make_design(case=design, inflow="uniform")
    found = rotor.schedule(made, mu=[0.3, 0.1], hours=[2.0, 1.0])
    gain = found.in_flight_gain("linear")
    alone, at_three = rotor.optimise(made.at(mu=0.3), "linear").best, found.at(1, "linear")
    assert gain
    assert 0.0 <= gain.gain < 0.05 * gain.fixed
    assert alone
    assert at_three
    assert at_three.best
    assert_allclose(at_three.best.power, alone.power, rtol=1e-6)
    with pytest.raises(ValueError, match="1 hours for 2 advance ratios: give one for each"):
        rotor.schedule(made, mu=[0.1, 0.2], hours=[1.0])


def test_an_optimum_over_weighted_speeds_within_limits(design: rotor.Design):
    """Its power is the weighted mean of the trims, and no other twist inside the limits takes less."""
    made = rotor.make_design(case=design, inflow="pitt-peters")
    weights = {0.1: 1.0, 0.3: 3.0}
    limits = rotor.Limits(rate_deg=(-9, 0), stalled_percent=50)
    found = rotor.optimise(
        made, "linear", conditions=list(weights.items()), limits=limits, starts=2
    )

    def mean(twist: str) -> float:
        return (
            sum(
                w * rotor.solve(made.at(mu=mu).with_twist(twist)).power.total
                for mu, w in weights.items()
            )
            / 4.0
        )

    assert_allclose(found.best.power, mean(found.best.twist), rtol=1e-7)
    assert found.best.power <= min(mean(f"linear:{rate}") for rate in (-9, -6, -3)) * (1 + 1e-9)
    at_design = [(made.at(mu=0.1), 1.0), (0.3, 3.0)]
    again = rotor.optimise(made, "linear", conditions=at_design, limits=limits, starts=2)
    assert again.best == found.best
    small = rotor.optimise(made, "linear", limits=rotor.Limits(change_deg=1.0), starts=2)
    change = small.twist(1.0) - small.twist(0.13) - made.twist(1.0) + made.twist(0.13)
    assert abs(math.degrees(change)) < 1.02


@pytest.mark.parametrize("inflow", ["pitt-peters", "lifting-line"])
def test_power_settles_on_finer_grids(inflow: str, tmp_path: Path):
    """Twice the elements halve the distance to the finest at least; the grid is kept in a design file."""
    powers = {
        n: rotor.solve(rotor.make_design(mu=0.3, inflow=inflow, elements=n)).power.total
        for n in (12, 24, 96)
    }
    assert abs(powers[24] - powers[96]) < 0.6 * abs(powers[12] - powers[96])
    fine = rotor.make_design(mu=0.3, inflow=inflow, elements=32, azimuths=36)
    assert rotor.solve(fine).disk.alpha.shape == (32, 36)
    fine.save(tmp_path / "fine.json")
    assert rotor.load_design(tmp_path / "fine.json") == fine
    with pytest.raises(ValueError, match="3 blade elements are outside"):
        rotor.make_design(elements=3)
    assert (
        rotor.make_design(inflow="pitt-peters", elements=200, azimuths=200).models.elements == 200
    )
    with pytest.raises(ValueError, match="at most 128 and 480, and 3000 points in all; 24 × 24 is"):
        rotor.make_design(elements=200, azimuths=200)


class TestDesign:
    def test_speed_in_knots_and_arguments_left_out(self, design: rotor.Design):
        assert_allclose(design.at(speed_kt=100.0).airspeed, 100.0 * KNOT, rtol=1e-14)
        assert (
            rotor.make_design(speed_kt=100.0).condition
            == rotor.make_design().at(speed_kt=100.0).condition
        )
        changed = design.at(mass_kg=9000)
        assert (changed.condition.mass, changed.condition.advance_ratio) == (9000.0, 0.2)
        assert design.at(hover=True).hovering
        assert design.at() == design
        assert design.at(altitude_m=1000).twist == design.twist

    def test_twist_is_a_law_or_its_spec(self, design: rotor.Design):
        law = LinearTwist(math.radians(-9.0))
        assert design.with_twist(law) == design.with_twist("linear:-9")
        assert design.with_twist("builtin").twist == design.rotor.builtin_twist
        assert design.with_twist("ideal") == rotor.make_design(twist="ideal", mu=0.2)


class TestSolution:
    def test_an_unconverged_solution_refuses_its_power(self, failed: rotor.Solution):
        with pytest.raises(RuntimeError, match=r"did not converge.*last_power"):
            _ = failed.power
        assert failed.last_power.total > 0.0
        assert rotor.solution_record(failed)["power_w"]["total"] is None

    def test_saved_design_loads_and_keeps_its_numbers(
        self, solution: rotor.Solution, tmp_path: Path
    ):
        path = tmp_path / "a.json"
        rotor.save_solution(solution, path)
        assert rotor.load_design(path) == solution.design
        saved = json.loads(path.read_text(encoding="utf-8"))["solution"]
        assert saved["power_w"]["total"] == solution.power.total

    def test_plots(self, solution: rotor.Solution, design: rotor.Design):
        axes = rotor.plot_field(solution, "alpha")
        assert "Angle of attack" in axes.get_title()
        table = rotor.sweep(design, [0.1, 0.2])
        axes = rotor.plot_power(table)
        drawn = {line.get_label(): line.get_ydata() for line in axes.lines}
        assert_allclose(drawn["total"], [one.power.total / 1e3 for one in table])
        other = rotor.sweep(design.with_twist("linear:-4"), [0.1, 0.2])
        wanted = ["UH-60A, linear:−12", "UH-60A, linear:−4"]
        assert [line.get_label() for line in rotor.plot_power(table, other).lines] == wanted
        several = rotor.sweep([design, design.with_twist("linear:-4")], [0.1, 0.2])
        assert [line.get_label() for line in rotor.plot_power(several).lines] == wanted
        pyplot.close("all")


class TestSweep:
    def test_the_table_and_what_other_libraries_read(self, tmp_path: Path):
        """Numbers are numbers with the unit in the name, and a power that does not exist is null or an empty cell."""
        table = rotor.sweep(
            rotor.make_design(mass_kg=11_000, **QUICK), mu=(mu for mu in (0.2, 0.5))
        )
        assert len(table) == len(list(table)) == 2
        row: dict[str, Any] = dict(zip(table.columns, table.rows[0], strict=True))
        assert row["mu"] == 0.2
        assert_allclose(row["speed_kt"], table[0].design.airspeed / KNOT)
        assert row["power_total_w"] == table[0].power.total
        read = pyarrow.table(table.to_dict())
        assert tuple(read.column_names) == table.columns
        assert (
            str(read.schema.field("power_total_w").type)
            == str(read.schema.field("mu").type)
            == "double"
        )
        assert read.column("power_total_w").to_pylist() == [row["power_total_w"], None]
        table.to_csv(tmp_path / "p.csv")
        with (tmp_path / "p.csv").open(encoding="utf-8", newline="") as file:
            good, bad = csv.DictReader(file)
        assert tuple(good) == table.columns
        assert float(good["power_total_w"]) == row["power_total_w"]
        assert (bad["power_total_w"], bad["status"]) == ("", table[1].status.value)

    def test_several_designs_and_rotors_are_told_apart(self, design: rotor.Design):
        table = rotor.sweep([design, rotor.make_design(rotor="r22")], [0.1, 0.2])
        assert [row[:2] for row in table.rows[:2]] == [("UH-60A", "linear:-12")] * 2
        assert len(set(table.labels)) == 2
        assert "Robinson R22" in table.labels[2]
        for one in table:
            assert_allclose(one.power.total, rotor.solve(one.design).power.total, rtol=1e-8)

    def test_over_speed_mass_and_altitude(self, design: rotor.Design):
        """Each is the same trim as that of `Design.at`, and the chart is drawn over what varies."""
        axes: dict[str, Any] = {
            "speed_kt": [60, 90],
            "mass_kg": [7000, 9000],
            "altitude_m": [0, 2000],
        }
        for name, values in axes.items():
            table = rotor.sweep(design, **{name: values})
            assert [row[table.columns.index(name)] for row in table.rows] == pytest.approx(values)
            for one, value in zip(table, values, strict=True):
                assert one.design == design.at(**{name: value})
        drawn = rotor.plot_power(rotor.sweep(design, mass_kg=[7000, 9000]))
        assert drawn.get_xlabel() == "Mass [kg]"
        assert_allclose(drawn.lines[0].get_xdata(), [7000, 9000])
        pyplot.close("all")

    def test_power_relative_to_one_of_the_designs(self, design: rotor.Design):
        table = rotor.sweep([design, design.with_twist("linear:-4")], isa_offset_c=[-10, 20])
        changed = table.relative_to("linear:-4")
        powers = [one.power.total for one in table]
        by_hand = [
            100.0 * (power / powers[k] - 1.0) for power, k in zip(powers, (2, 3, 2, 3), strict=True)
        ]
        assert changed.changes == pytest.approx(by_hand)
        assert changed.to_dict()["change_percent"] == list(changed.changes)
        assert by_hand[0] != 0.0 == by_hand[2]
        drawn = rotor.plot_power(changed)
        assert drawn.get_ylabel() == "Power relative to UH-60A, linear:-4 [%]"
        assert_allclose(drawn.lines[0].get_ydata(), by_hand[:2])
        pyplot.close("all")
        with pytest.raises(
            ValueError,
            match="'linear:-5' is none of the designs of this sweep: use UH-60A, linear:-12; ",
        ):
            table.relative_to("linear:-5")

    def test_a_pandas_frame_with_units_and_an_error_without_pandas(
        self, design: rotor.Design, monkeypatch: pytest.MonkeyPatch
    ):
        table = rotor.sweep(design.at(mass_kg=11_000), [0.2, 0.5])
        frame = table.to_dataframe()
        assert tuple(frame.columns) == table.columns
        assert frame["power_total_w"].dtype == frame["mu"].dtype == "float64"
        assert frame["power_total_w"].isna().tolist() == [False, True]
        units = frame.attrs["units"]
        known = {"speed_kt": "kt", "mass_kg": "kg", "power_total_w": "W", "twist_deg_per_r": "°/R"}
        assert known.items() <= units.items()
        assert not {"rotor", "mu", "pitch_per_rev", "message"} & units.keys()
        monkeypatch.setitem(sys.modules, "pandas", None)
        with pytest.raises(ImportError, match=r"a data frame needs pandas: pip install pandas"):
            table.to_dataframe()


def test_a_notebook_shows_tables(design: rotor.Design):
    """Every number of the text is in the markup, and no text is taken for markup."""
    solution, band = (
        rotor.solve(rotor.make_design(mu=0.2, twist=f"linear:{rate}")) for rate in (-8, -12)
    )
    shown = solution._repr_html_()
    assert f">{solution.power.total / 1e3:.1f}<" in shown
    assert f">{solution.power.tail / 1e3:.1f}<" in shown
    refused = rotor.solve(design.at(mass_kg=30_000))
    assert "<table" not in refused._repr_html_()
    found = rotor.doubt(solution, band)
    assert all(f">{row.power / 1e3:+.2f}<" in found._repr_html_() for row in found.rows)
    table = rotor.SweepTable((solution, refused))._repr_html_()
    assert table.count("<tr>") == 3
    assert f">{solution.power.total:.5g}<" in table


def test_a_gradient_by_the_numbers_of_a_twist_law():
    """The exact slope is the difference of two trims."""
    design = rotor.make_design(mu=0.2, twist="segments:-12,-6@0.6")
    law, step = design.twist, math.radians(0.01)
    assert isinstance(law, PiecewiseLinearTwist)
    gradient = rotor.power_gradient(rotor.solve(design))
    with pytest.raises(TypeError, match="twist uh60a has no numbers to change"):
        gradient.by_parameters(parse_twist("uh60a"))
    for k, slope in enumerate(gradient.by_parameters(law)):
        ends = [list(law.values) for _ in range(2)]
        ends[0][k], ends[1][k] = ends[0][k] - step, ends[1][k] + step
        low, high = (rotor.solve(design.with_twist(law.of(*end))).power.total for end in ends)
        assert_allclose(slope, (high - low) / (2.0 * step), rtol=2e-3)


def test_near_misses_name_what_is_meant(design: rotor.Design):
    one: Any = design
    with pytest.raises(AttributeError, match="did you mean 'optimise'"):
        _ = rotor.optimize
    with pytest.raises(TypeError, match=r"give several in a list, or write rotor.solve\(design\)"):
        rotor.solve_many(one)
    with pytest.raises(TypeError, match="the actuator's name comes first"):
        rotor.actuator.try_actuator(one, one)
    assert len(str(inspect.signature(rotor.solve))) < 500
    assert "0x" not in str(inspect.signature(rotor.hub_loads))


IMPORT = """
import json, logging, os, signal, sys, warnings
import numpy, scipy.linalg, scipy.sparse, scipy.special  # SciPy adds filters for warnings of its own.
from threadpoolctl import threadpool_info, threadpool_limits
threadpool_limits(limits=3, user_api="blas")

def state():
    return {
        "threads": {one["filepath"]: one["num_threads"] for one in threadpool_info()},  # They come in any order.
        "warnings": [repr(one) for one in warnings.filters],
        "signals": [repr(signal.getsignal(one)) for one in sorted(signal.valid_signals())],
        "environment": dict(os.environ),
        "logging": (logging.getLogger().level, [repr(one) for one in logging.getLogger().handlers]),
        "numpy": (numpy.geterr(), numpy.get_printoptions()["precision"]),
        "python": (sys.getrecursionlimit(), sys.getswitchinterval(), repr(sys.excepthook), os.getcwd(), sys.path[:]),
    }

before = state()
import rotor, explorer
names = [name for name, value in state().items() if value != before[name]] + ["viser"] * ("viser" in sys.modules)
solved = rotor.solve(rotor.make_design()).converged
print(json.dumps([names, solved, [name for name in ("threads", "environment") if state()[name] != before[name]]]))
"""


@pytest.mark.slow
def test_import_does_not_change_blas_threads_and_solve_restores_them():
    """BLAS threads, warning filters, signal handlers, environment, logging, NumPy's and Python's own settings.

    Nor does it load the page's server.
    """
    done = subprocess.run(
        [sys.executable, "-c", IMPORT], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert json.loads(done.stdout) == [[], True, []]


# Pictures without matplotlib, and numbers of results


WANTS = "a picture needs matplotlib: pip install matplotlib"
QUICK: dict[str, Any] = {"inflow": "uniform", "elements": 12, "azimuths": 24}


def test_twist_is_a_number_in_tables():
    designs = [rotor.make_design(twist=f"linear:{rate}", **QUICK) for rate in (-4, -12)]
    table = rotor.sweep(designs, mu=[0.2]).to_dict()
    assert_allclose(np.array(table["twist_deg_per_r"], dtype=float), [-4.0, -12.0])


def test_a_picture_without_matplotlib_is_one_sentence(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
):
    """The commands say it before they compute."""
    solution = rotor.solve(rotor.make_design(**QUICK))
    monkeypatch.setattr(rotor.command.validate, "compare", None)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    for name in ("matplotlib.figure", "matplotlib.pyplot"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    with pytest.raises(ImportError, match=re.escape(WANTS)):
        rotor.plot_field(solution)
    for words in (
        ["validate", "xv15-hover", "--plot", str(tmp_path)],
        ["reproduce", str(tmp_path / "out")],
    ):
        assert main(words) == 2
        assert capsys.readouterr().err.endswith(f"{WANTS}\n")
    assert not (tmp_path / "out").exists()


def test_gradient_along_a_twist_law():
    design = rotor.make_design(mu=0.2, twist="linear:-4")
    slope = power_gradient(rotor.solve(design)).along(parse_twist("linear:1"))
    ends = [rotor.solve(design.with_twist(f"linear:{rate}")).power.total for rate in (-4.05, -3.95)]
    assert_allclose(slope, (ends[1] - ends[0]) / 0.1, rtol=1e-3)
