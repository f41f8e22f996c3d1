"""What cannot be: each call, text, file and command that is refused, and words of its one sentence."""

import shlex
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest

import rotor
from rotor.actuator.installation import with_actuator
from rotor.airfoil.sections import load_section
from rotor.design.active_twist import ActiveTwist, Harmonic
from rotor.design.twist import LinearTwist, parse_twist, shipped_twist
from rotor.files.design_file import design_from_record
from rotor.files.rotor_file import read_aircraft
from rotor.optimisation.concepts import CONCEPTS, find_concept, restrict
from rotor.optimisation.limits import ChangeLimit, Limits
from rotor.optimisation.objective import (
    Objective,
    WeightedCondition,
    hover_and_cruise,
    read_mission,
)
from rotor.optimisation.search import Search
from rotor.study.study_file import parse_study
from rotor.support.assets import asset_path

WRONG = {
    "rotor.make_design(twist=-12)": (TypeError, 'twist -12 is not a twist: write "linear:-12"'),
    "rotor.make_design(twist='-12')": (ValueError, "twist '-12' is not known: write linear:-12"),
    "rotor.make_design(twist=lambda r: 0 * r)": (
        TypeError,
        'is not a twist: write a text such as "linear:-12"',
    ),
    "rotor.make_design(mu='fast')": (
        TypeError,
        "mu is 'fast', not a number: write for example mu=0.3",
    ),
    "rotor.make_design(mu=2)": (ValueError, "advance ratio 2 is outside 0…0.6"),
    "rotor.make_design(mu=0.2, hover=True)": (
        ValueError,
        "mu=0.2 and hover=True each set the speed",
    ),
    "rotor.make_design(hover='yes')": (TypeError, "hover is 'yes': write hover=True"),
    "rotor.make_design(mass_kg='8 t')": (TypeError, "mass_kg is '8 t', not a number"),
    "rotor.make_design(climb_m_s='fast')": (TypeError, "climb_m_s is 'fast', not a number"),
    "rotor.make_design(preset='thesis', climb_m_s=3)": (ValueError, "document's equations"),
    "rotor.make_design(mass_kg=9.5)": (
        ValueError,
        "mass 9.5 kg is outside 100…50000 kg: 9.5 t is 9500 kg",
    ),
    "rotor.make_design(mass_kg=90000)": (
        ValueError,
        "mass 90000 kg is outside 100…50000 kg: choose a value inside",
    ),
    "rotor.make_design(rotor='UH-60A')": (
        ValueError,
        "rotor 'UH-60A' is not known; did you mean 'uh60a'?",
    ),
    "rotor.make_design(twist='liner:-8')": (
        ValueError,
        "twist 'liner:-8' is not known; did you mean 'linear'?",
    ),
    "rotor.make_design(twist='UH-60A')": (ValueError, "did you mean 'uh60a'?"),
    "rotor.make_design(elements='many')": (TypeError, "elements is 'many', not a whole number"),
    "rotor.make_design(azimuths=24.5)": (TypeError, "azimuths is 24.5, not a whole number"),
    "rotor.make_design(bending='yes')": (TypeError, "bending is 'yes': write bending=True"),
    "rotor.make_design(inflow=3)": (TypeError, "inflow is 3, not a text"),
    "rotor.make_design(airfoils=3)": (TypeError, "airfoils is 3, not a text"),
    "rotor.make_design(off=['swirl'])": (TypeError, "off is ['swirl'], not a text"),
    "rotor.make_design(case='x.json')": (
        TypeError,
        "case is 'x.json', not a design: give what rotor.load_design",
    ),
    "rotor.make_design(models='best')": (TypeError, "models is 'best', not rotor.Models"),
    "rotor.make_design(stand='wind')": (TypeError, "stand is 'wind', not a dictionary"),
    "rotor.make_design(masskg=8)": (TypeError, "no argument 'masskg'; did you mean 'mass_kg'?"),
    "rotor.make_design(delta_isa=20)": (
        TypeError,
        "no argument 'delta_isa': write isa_offset_c=20",
    ),
    "rotor.sweep(design, mass_kg=['heavy'])": (TypeError, "heavy"),
    "design.at(mass=8000)": (TypeError, "no argument 'mass'; did you mean 'mass_kg'?"),
    "rotor.sweep(design, twist=['linear:-8'])": (
        TypeError,
        "'twist': write rotor.sweep([design.with_twist(",
    ),
    "design.at(twist='linear:-8')": (TypeError, "no argument 'twist': write design.with_twist(…)"),
    "design.at(rotor='s61')": (
        TypeError,
        "no argument 'rotor': write rotor.make_design(case=design, rotor=…)",
    ),
    "rotor.make_design(rotor=60)": (TypeError, "rotor 60 is not a rotor"),
    "rotor.make_design(rotor='xv15', drag_area_m2=3)": (
        ValueError,
        "drag_area_m2 3 has no effect on a test stand",
    ),
    "rotor.make_design(preset='best')": (
        ValueError,
        "preset 'best' is not known: use flight or thesis",
    ),
    "rotor.parse_twist('builtin')": (ValueError, "twist 'builtin' needs a rotor"),
    "rotor.solve('uh60a')": (TypeError, "design is 'uh60a': give what rotor.make_design"),
    "rotor.solve(design, start=design)": (TypeError, "give an earlier solution or leave it out"),
    "rotor.sweep(design, mu=0.2)": (TypeError, "give a list, for example mu=[0.1, 0.2, 0.3]"),
    "rotor.sweep(design)": (TypeError, "a sweep over nothing: give one of mu, speed_kt, mass_kg"),
    "rotor.sweep(design, mu=[0.1], mass_kg=[8000])": (
        TypeError,
        "a sweep over mu and mass_kg: give one of",
    ),
    "rotor.Limits(rate_deg=-20)": (
        TypeError,
        "give the steepest and the flattest, for example (-20, 0)",
    ),
    "rotor.Limits(change_deg=-1)": (ValueError, "change limit -1° is negative: give 0 or more"),
    "rotor.optimise(design, limits=2.0)": (
        TypeError,
        "limits is 2.0: give rotor.Limits(rate_deg=(-20, 0))",
    ),
    "rotor.optimise(design, conditions=0.3)": (TypeError, "give pairs of advance ratio and weight"),
    "rotor.optimise(design, conditions=[(rotor.make_design(rotor='r22'), 1)])": (
        ValueError,
        "use one rotor",
    ),
    "rotor.schedule(design, mu=0.1)": (TypeError, "mu is 0.1: give a list of advance ratios"),
    "rotor.schedule(design, mu=[0.1], concepts='linear')": (
        TypeError,
        "give a list, concepts=['linear']",
    ),
    "rotor.solve(solution)": (TypeError, ": give what rotor.make_design"),
    "rotor.with_actuator('MFC_P1', design)": (
        TypeError,
        "design is 'MFC_P1': give what rotor.make_design",
    ),
    "rotor.SweepTable((design,))": (TypeError, "give what rotor.solve returns"),
    "design.save('none/a.json')": (OSError, "none/a.json'"),
    "rotor.distribution(design)": (TypeError, "give what rotor.solve returns"),
    "rotor.hub_loads('x')": (TypeError, "solution is 'x': give what rotor.solve returns"),
    "rotor.hub_loads(design)": (TypeError, "give what rotor.solve returns"),
    "rotor.doubt(design)": (TypeError, "give what rotor.solve returns"),
    "rotor.optimise(design, 3)": (
        TypeError,
        'concept is 3, not a text: write for example "linear"',
    ),
    "rotor.optimise(design, starts='many')": (TypeError, "starts is 'many': give a whole number"),
    "rotor.plot_power(design)": (TypeError, "plot_power got Design: give what rotor.sweep returns"),
    "design.save('a.toml')": (
        ValueError,
        "'a.toml' ends in .toml, but what is written is JSON: write 'a.json'",
    ),
    "rotor.plot_field(solution, 'noise')": (
        ValueError,
        "field 'noise' is not known: use one of alpha",
    ),
    "rotor.vibration_front(bent, points=1)": (ValueError, "1 points"),
    "rotor.vibration_front(bent, reach_deg=0.0)": (ValueError, "reach 0°"),
    "rotor.vibration_front(bent, 'screw')": (ValueError, "screw"),
    "rotor.t_matrix(bent, (2, 9))": (ValueError, "9/rev"),
    "rotor.t_matrix(bent.at(mu=0.1))": (ValueError, "below µ 0.2"),
    "rotor.t_matrix(design.at(mu=0.3))": (ValueError, "--bending"),
    "rotor.t_matrix(bent, (2,)).response('3:1:0')": (ValueError, "no 3/rev"),
    "stand({'ct_over_sigma': 0.07, 'flapping': 'hub-moments'}, rotor='pca2')": (
        ValueError,
        "on blades hinged at",
    ),
    "stand({'ct_over_sigma': 0.07, 'hub_roll_nm': 5.0}, rotor='hart2')": (
        ValueError,
        "set flapping to hub-moments",
    ),
    "stand({**MOMENTS, 'cyclic_1c_deg': 1.0}, rotor='hart2')": (
        ValueError,
        "needed to trim the hub moments",
    ),
    "stand({**MOMENTS, 'hub_roll_nm': 20.0}, rotor='hart2', mu=0.0)": (
        ValueError,
        "in hover the rotor is balanced",
    ),
    "stand({})": (ValueError, "none of them"),
    "stand({'thrust_n': 1.0, 'collective_deg': 2.0})": (ValueError, "thrust_n and collective_deg"),
    "stand({'ct_over_sigma': 0.5})": (ValueError, "outside 0…0.25"),
    "stand({'collective_deg': 5.0, 'cyclic_1c_deg': 1.0})": (
        ValueError,
        "needed to trim the flapping",
    ),
    "stand({'collective_deg': '5'})": (ValueError, "give a number"),
    "stand({'pitch': 5.0})": (ValueError, "is not known"),
}

ALIKE = {
    "parse({!r})": {
        "linear:x": "'x'", "linear:nan": "'nan'", "linear:": "linear:-8", "quadratic:3": "quadratic:6,-14",
        "segments:-3,-4": "1 break", "segments:-3,-4,-5@0.7,0.4": "ascend", "segments:-3,-4@1.2": "between 0 and 1",
        "wavy:3": "'wavy:3' is not known", "table:nowhere.txt": "does not exist", "": "is not known",
        "table:": "names no file: write table:FILE", "ideal:x": "for example ideal:6.4",
        "segments:-3,-4@x": "for example segments:-12,-4@0.5", "builtin:3": "write builtin or builtin+linear:-2",
        "r22:-8": "numbers, which r22 does not take", "spline:1,2@0.2,0.8": "four or more",
        "spline:1,2,3,4@0.2,0.1,0.8,1": "ascend",
    },
    "parse('table:' + written({!r}))": {
        "0.2 3\n0.1 4\n": "ascend", "0.2 3\n0.3 x\n": "line 2", "0.5 1\n": "two or more", "0.2 3\n7 4\n": "line 2",
    },
    "rotor.make_design(pitch_per_rev={})": {
        "'1:1:0'": "is cyclic pitch", "'9:1:0'": "9/rev is outside 1…8", "'2.5:1:0'": "needs a whole number",
        "'3:10.5:0'": "10.5° at 3/rev is outside 0…10°", "'3:1'": "'3:1' is not understood: write N:DEG:PHASE",
        "'3:1:inf'": "two finite angles", "'3:1:0,3:1:0'": "3/rev twice",
        "','.join(['3:1:0'] * 100_000)": "3/rev twice", "3": "pitch_per_rev is 3: write",
        "{'per_rev': 3}": "write N:DEG:PHASE", "[None]": "is not understood",
    },
    "design_from_record({})": {
        "{'mass': 7000}": "unknown key 'mass'; did you mean 'mass_kg'?", "{'mass_kg': 'heavy'}": "'heavy'",
        "{'dynamic_stall': 'auto'}": "dynamic_stall is 'auto', not true or false",
        "{'flapping': 0}": "flapping is 0, not true or false", "{'twist': 3}": "twist is 3, not a text",
        "{'inflow': 'magic'}": "'magic'", "{'low_speed': 'fly'}": "use hover or wake",
        "{'format': 'rotor-explorer design', 'version': 1}": "version 1: this program reads",
        "{'rotor': {'main': 'a.toml'}}": "'rotor' does not name or hold a rotor: write one of uh60a, r22, s61",
        "{'rotor': '/etc/passwd'}": "rotor '/etc/passwd' is not known: use uh60a",  # Paths: on the command line alone.
        "{'active_twist': 3}": "'active_twist' is 3",
        "{'active_twist': {'harmonics': [{'per_rev': 1 + n % 8, 'amplitude_deg': 1} for n in range(100_000)]}}":
            "1/rev twice",
        "{'trim': 'wind-tunnel'}": "needs the inputs", "{'stand': [1]}": "design file key",
        "{'trim': 'thrust', 'stand': {'collective_deg': 5.0}}": "does not use",
        "{'trim': 'controls', 'stand': {'ct_over_sigma': 0.07}}": "needs a collective",
        "{'trim': 'free-rotor', 'advance_ratio': 0.0, 'stand': {'ct_over_sigma': 0.07}}": "needs wind",
        "{'trim': 'wind-tunnel', 'preset': 'thesis', 'stand': {'ct_over_sigma': 0.07}}": "axial flow",
        "{'trim': 'glide', 'stand': {'ct_over_sigma': 0.07}}": "is not known",
    },
    "with_actuator(rotor.make_design(), {!r})": {
        "MFC": "not known", "MFC_P1,drve=77": "has 'drve=77'", "MFC_P1,drive=": "has 'drive='",
        "MFC_P1,drive=nan": "has 'drive=nan'", "MFC_P1,drive=120": "from −100 to 100 %",
        "MFC_P1,span=0.3": "two ends", "MFC_P1,drive=1:2:3": "3 drives do not fit 1 segments",
        "MFC_P1,plies=40": "40 plies",
    },
    "read_mission(written({!r}), rotor.make_design())": {
        "": "is empty", "mu,hours\n": "no flight conditions", "speed,hours\n0.2,1\n": "line 1 reads 'speed,hours'",
        "mass_kg\n8000\n": "only mu is required", "mu,hours\n0.2,1\nfast,1\n": "line 3: mu is 'fast'",
        "mu,hours\n0.2,0\n": "line 2: 0 hours", "mu,climb_m_s\n0.2,1\n0.2,900\n": "line 3: rate of climb 900 m/s",
    },
    "Search(design, CONCEPTS['linear'], {})": {
        "starts=0": "0 starts", "seed=-1": "seed -1", "limits=Limits(bounds=(('angle', 0, 1),))": "no parameter",
        "limits=Limits(bounds=(('rate', 0.1, 0.0),))": "allow no value",
    },
    "find_concept({})": {
        "'wavy'": "'wavy' is not known", "'linear', [0.5]": "cannot take 1 division",
        "'two-segment', [0.99]": "outside 0.25…0.92", "'three-segment', [0.8, 0.4]": "must ascend",
    },
    "sprung({!r})": {
        "hub = 'gimballed'\nflap_spring_nm_rad = 5.0": "flap_spring_nm_rad on a hub that is 'gimballed'",
        "hub = 'articulated'\nprecone_deg = 2.5": "precone_deg on a hub that is 'articulated'",
    },
    "load_section({!r})": dict.fromkeys(
        ("sc1095-thesis:", "sc1095-thesis:free:x:1:2", "sc1095-thesis:glued:0.3:-10:15", "sc1095-thesis2"),
        "no polynomials named",
    ),
    "{}": {
        "load_section('sc1095-thesis:tripped:0.55:-10:15')": "Mach 0.55",
        "read_mission(Path('none.csv'), rotor.make_design())": "does not exist",
        "read_mission(written('mu,climb_m_s\\n0.2,5\\n'), rotor.make_design(preset='thesis'))": "line 2: rate",
        "restrict(CONCEPTS['quadratic'], {'rate': 0.0})": "no parameter 'rate'",
        "restrict(CONCEPTS['linear'], {'rate': 0.0})": "no free parameter left",
        "Limits(rate=(0.1, 0.0))": "steepest first", "Limits(stalled=2.0)": "200 %",
        "Limits(index=0.0)": "0 % of the vibration index",
        "ChangeLimit(LinearTwist(0.0), (0.0, 1.0), (0.1,))": "one angle",
        "Objective('shaft', (WeightedCondition(rotor.FlightCondition(0.2, 8000.0)),))": "'shaft' is not known",
        "Objective('total', ())": "give at least one",
        "hover_and_cruise(design, 1.5, 0.3)": "hover share 1.5",
        "ActiveTwist((Harmonic(2, 0.01),) * 100_000)": "2/rev twice",
        "ActiveTwist((), (0.5,), (1.0,))": "give 2 or more pairs",
        "rotor.make_design(twist_per_rev='2:21:0')": "outside 0…20°",
        "parse_study('[axes]\\npitch_per_rev = [\"1:1:0\"]\\n')": "line 2: root pitch at 1/rev",
        "with_actuator(rotor.make_design(rotor='s61'), 'MFC_P1')": "structure of the Sikorsky S-61",
        "with_actuator(with_actuator(design, 'MFC_P1'), 'MFC_P1')": "carry MFC P1 at 0 V already",
        "rotor.make_design(case=with_actuator(design, 'MFC_P1'), preset='thesis')": "leave rotor and preset",
    },
}  # fmt: skip
"""Calls that are alike, and what is wrong in each: a `ValueError`."""
ROWS = {
    **WRONG,
    **{
        call.format(what): (ValueError, words)
        for call, rows in ALIKE.items()
        for what, words in rows.items()
    },
}

COMMANDS = {
    "solve --mu 0.2 --hover": "--hover",
    "optimize --hover": "did you mean 'optimise'?",
    "solve --twst linear:-8": "did you mean '--twist'?",
    "sweep --mu 0.4:0.1:0.1": "write 0.4:0.1:-0.1 or 0.1:0.4:0.1",
    "sweep": "give one range",
    "sweep --mu 0.1:0.3:0.1 --mass-kg 7000:8000:500": "give one range",
    "sweep --mu 0.1 --speed-kt 80": "give one range",
    "sweep --mu 0.1:0.2:0.1 --csv - --json": "both print",
    "sweep --mu 0.1 --twist linear:-8 --relative-to builtin": "use linear:-8",
    "schedule --hover": "--hover is not a flag of this command; see",
    "solve --trim controls --thrust-n 20": "needs a collective",
    "solve --ct-over-sigma 0.07": "add --trim wind-tunnel",
    "solve --preset thesis --climb-m-s 4": "leave the rate of climb out",
    "solve --pitch-per-rev 1:1:0": "cyclic pitch",
    "solve --rotor r44": "rotor 'r44' is not known: use uh60a, r22, s61, gazelle",
    "solve --rotor none.toml": "rotor file 'none.toml' does not exist",
    "solve --rotor none.tml": "rotor file 'none.tml' does not exist: give a shipped rotor's name",
    "solve --row STUDY": "give a study's folder and a point, as DIR:17",
    "solve --row STUDY:9999": "no finished point 9999: give one of 0…527",
    "solve --row nowhere:1": "holds no study",
    "solve --row STUDY:1 --case a.json": "use one of them",
    "solve --save a.toml": "a.toml",
    "airfoil show sc1095 --mach 0.7": "needs both --mach and --alpha",
    "airfoil build sc1095": "'build' is not a known value: use show",
    "optimise --concept two-segment --division half": "'half' is not understood",
    "optimise --hover-share 0.5": "add --objective hover-cruise",
    "optimise --bound angle=1,2": "does not name a parameter",
    "optimise --change-deg 1 --actuator MFC_P1": "give one of them",
    "optimise --concept linear --trim free-rotor --ct-over-sigma 0.06": "takes no power from its shaft",
    "schedule --plies 3": "add --actuator",
    "schedule --processes 0": "0 processes",
    "study nowhere.toml": "two_segment.toml",
    "study two_segment.toml DIR": "study show DIR",
    "study two_segment.toml --workers 0": "1…1024",
    "study show nowhere": "nowhere",
    "front --mu 0.3 --bending --harmonics two": "write for example 2,3",
    "validate xv16": "set 'xv16' is not known: use one of xv15-hover",
    "validate xv15-hover --inflow drees": "hover inflow 'drees' is not known: use one of annulus",
    "reproduce OUT --processes 0": "0 processes",
    "reproduce OUT --figure 9.9": "3.11",
    "reproduce OUT --figure 2.1": "figure 2.1 is a drawing in the thesis (stream tube in hover)",
    "actuator --plot line.svg": "add --what-would-pay",
    "actuator --actuator MFC_P": "actuator 'MFC_P' is not known; did you mean 'MFC_P2'? use one of MFC_P1",
    "actuator --concept two-segment --division 1.5": "division 1.5 of concept two-segment is outside",
    "actuator --plies 0": "0 plies",
    "actuator --from-mu 0.3": "the mission has one flight condition",
    "actuator --span 0.2": "active span '0.2' is not understood",
    "actuator --chord 0.5:0.1": "active chord 0.5…0.1",
    "actuator --blade retrofit --stiffness 0.5": "retrofit keeps the blade",
    "actuator --blade new --stiffness 5": "stiffness 5",
    "actuator --angle-deg 0": "fibre angle 0",
}

BENT = rotor.make_design(mu=0.3, inflow="pitt-peters", bending=True)


@pytest.fixture(scope="module")
def design() -> rotor.Design:
    return rotor.make_design(twist="linear:-12", mu=0.2)


@pytest.fixture(scope="module")
def solution(design: rotor.Design) -> rotor.Solution:
    return rotor.solve(design).require()


def on_stand(stand: dict[str, Any], **given: Any) -> rotor.Design:
    return rotor.make_design(trim="wind-tunnel", stand=stand, **given)


def sprung(lines: str) -> rotor.Aircraft:
    """The Bo 105 with these lines in place of its hub, spring and precone."""
    own = ("flap_spring_nm_rad", "precone_deg", "hub =")
    text = asset_path("bo105.toml").read_text(encoding="utf-8").splitlines()
    kept = "\n".join(line for line in text if not line.startswith(own))
    return read_aircraft(
        "own.toml", {"own.toml": kept.replace("[main_rotor]", f"[main_rotor]\n{lines}", 1)}
    )


NAMES: dict[str, Any] = {
    "rotor": rotor, "Path": Path, "CONCEPTS": CONCEPTS, "bent": BENT, "stand": partial(on_stand, mu=0.1),
    "MOMENTS": {"thrust_n": 3300.0, "flapping": "hub-moments"},
    "parse": partial(parse_twist, builtin=shipped_twist("uh60a"), ideal_tip_pitch=lambda: 0.11),
    **{one.__name__: one for one in (
        with_actuator, load_section, ActiveTwist, Harmonic, LinearTwist, design_from_record, find_concept, restrict,
        ChangeLimit, Limits, Objective, WeightedCondition, hover_and_cruise, read_mission, Search, parse_study, sprung,
    )},
}  # fmt: skip
"""What the calls name, beside what a test makes."""


@pytest.mark.parametrize("call", ROWS, ids=lambda call: call[:80])
def test_a_call_fails_at_once(
    call: str, design: rotor.Design, solution: rotor.Solution, tmp_path: Path
):
    def written(text: str) -> str:
        (path := tmp_path / "bad.txt").write_text(text, encoding="utf-8")
        return str(path)

    kind, words = ROWS[call]
    names = {**NAMES, "design": design, "solution": solution, "written": written}
    with pytest.raises(kind) as caught:
        eval(call, names)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 400


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_ends_with_one_line(command: str, refused: Callable[..., str], tmp_path: Path):
    """And exit code 2."""
    study = str(asset_path("studies") / "hover_cruise_264")
    words = (
        word.replace("STUDY", study).replace("OUT", str(tmp_path)) for word in shlex.split(command)
    )
    assert COMMANDS[command] in refused(*words)
