"""What both command lines print, say on stderr, write to files and end with."""

import contextlib
import csv
import io
import os
import shlex
from pathlib import Path
from typing import Any

from .designs import ROTORS
from .record import Record, named

COARSE = "--inflow uniform --elements 12 --azimuths 24"
"""A model that takes no time, for commands that solve many designs."""
LINEAR = "--inflow drees"
NAMES = (
    "solve", "sweep", "front", "waterfall", "optimise", "schedule", "study", "actuator", "reproduce", "validate",
    "airfoil", "warm", "completion",
)  # fmt: skip
SECTIONS = (
    "sc1095", "sc1094r8", "naca0012", "naca63a015", "naca64208", "naca64118", "naca64528", "naca64935", "goe429",
    "naca0015re242k", "oa209", "naca23012tab", "naca23012tab-model", "sc1095-thesis",
)  # fmt: skip

FILES = {
    "mission.csv": "mu,hours,mass_kg\n0,1,8000\n0.2,2,8322.4\n0.3,0.5,7800\n",
    "twist.txt": "0.2 6\n0.5 2\n0.75 0\n1.0 -3\n",
    "trims.toml": """
title = "Small"
[axes]
mu = [0.1, 0.2, 0.3]
rate_deg = [-16, -8]
mass_kg = [7000, 9000]
[fixed]
concept = "linear"
[models]
inflow = "uniform"
elements = 12
azimuths = 24
[show]
least = "power_total_w"
uncertain = ["mass_kg"]
""",
    "sample.toml": """
title = "A sample"
[axes]
mu = { low = 0.1, high = 0.3 }
rate_deg = { low = -16, high = 0 }
[fixed]
concept = "linear"
[models]
inflow = "uniform"
elements = 12
azimuths = 24
[sample]
method = "sobol"
count = 16
seed = 1
""",
    "optima.toml": """
title = "Optima"
[axes]
mu = [0.1, 0.3]
[fixed]
concept = "linear"
[models]
inflow = "uniform"
elements = 12
azimuths = 24
[optimum]
starts = 1
rate_deg = [-20, 0]
""",
    "no.toml": "title = 3\n",
    "no.json": '{"mass": 7000}\n',
    "no.csv": "speed,hours\n0.2,1\n",
    "no.txt": "0.2 3\n0.1 4\n",
    "broken.toml": "a = [1, 2\n",
}
"""Files that commands read, in the folder of each."""

SOLVE = (
    "solve",
    "solve --json",
    "solve --hover",
    "solve --hover --doubt",
    "solve --rotor r22 --hover --off tip-loss",
    "solve --mu 0.3 --twist linear:-8 --doubt",
    "solve --mu 0.3 --twist linear:-8 --doubt --json",
    "solve --mu 0.3 --bending",
    "solve --mu 0.3 --bending --doubt --json",
    "solve --distribution",
    f"solve --distribution --json {COARSE}",
    "solve --hover --distribution",
    "solve --preset thesis --twist ideal --json",
    "solve --mu 0.5 --mass-kg 11000",
    "solve --mu 0.5 --mass-kg 11000 --json --distribution",
    "solve --hover --mass-kg 20000 --altitude-m 4000 --json",
    "solve --hover --climb-m-s -8",
    "solve --mu 0.05 --climb-m-s=-9",
    f"solve --speed-kt 120 --isa-offset-c 20 --altitude-m 1000 --rotor-speed-percent 98 --load-factor 1.1 {LINEAR}",
    f"solve --drag-area-m2 2 --off compressibility,swirl,stall {LINEAR}",
    f"solve --off flapping,elastic-twist --json {LINEAR}",
    f"solve --twist-per-rev 2:1.5:90,3:0.5:0 --json {LINEAR}",
    f"solve --pitch-per-rev 2:1:30 {LINEAR}",
    f"solve --airfoils sc1094r8,sc1095-thesis@0.5 {LINEAR}",
    f"solve --twist table:twist.txt {LINEAR}",
    f"solve --twist builtin+linear:-2 {LINEAR}",
    "solve --twist linear:-30 --inflow uniform",
    "solve --inflow local-momentum",
    "solve --inflow closed-form --hover",
    "solve --mu 0.03 --low-speed wake",
    f"solve --loss-on inflow {LINEAR}",
    "solve --trim wind-tunnel --shaft-tilt-deg 5 --ct-over-sigma 0.075 --tip-mach 0.6 --json",
    "solve --trim free-rotor --collective-deg 2 --mu 0.3 --doubt",
    "solve --trim controls --collective-deg 7 --cyclic-1s-deg -4 --density 1.1",
    "solve --trim wind-tunnel --thrust-n 60000 --hover",
    "solve --rotor knight-hefner-3 --hover --ct-over-sigma 0.01 --altitude-m 900",
    "solve --rotor hart2 --mu 0.15 --flapping hub-moments --hub-roll-nm 20 --ct-over-sigma 0.06",
    f"solve --carry MFC_P1,drive=77 {LINEAR}",
    f"solve --carry MFC_P1,drive=77 --json {LINEAR}",
    "solve --mu 0.3 --twist linear:-8 --save mine.json; solve --case mine.json --mu 0.2; solve --case mine.json --json",
    f"solve --carry MFC_P1 --save carried.json {LINEAR}; solve --case carried.json",
    "solve --row STUDY:1",
    *(f"solve --rotor {rotor} --mu 0.2 --doubt" for rotor in ROTORS),
    f"solve --carry MFC_P1,drive=50 --mu 0.3 --save flown.json {LINEAR}; solve --case flown.json --doubt",
)
SWEEP = (
    "sweep --mu 0.1:0.3:0.1 --twist linear:-8 linear:-16 --csv sweep.csv",
    f"sweep --mu 0.2,0.25 --twist linear:-8 builtin --relative-to linear:-8 {COARSE}",
    f"sweep --speed-kt 60:100:20 --csv - {COARSE}",
    f"sweep --mu 0.2 --mass-kg 7000,8000 --json {COARSE}",
    f"sweep --hover --isa-offset-c 0:20:20 {COARSE}",
    f"sweep --rotor s61 --mu 0.1,0.2 --twist linear:-30 {COARSE}",
    f"sweep --mu 0.2 --climb-m-s=-4:4:4 {COARSE}",
    f"sweep --mu 0.3,0.5 --mass-kg 11000 {LINEAR}",
    f"sweep --rotor xv15 --mu 0.1,0.2 --ct-over-sigma 0.08 {COARSE}",
    f"sweep --rotor knight-hefner-3 --hover --altitude-m 0,900 {COARSE}",
)
TABLES = (
    "waterfall --mu 0.3",
    f"waterfall --json {LINEAR}",
    "waterfall --hover",
    f"waterfall --rotor bo105 --mu 0.2 {LINEAR}",
    f"front --mu 0.3 --bending --harmonics 2 --reach-deg 2 --points 2 {LINEAR}",
    f"front --mu 0.3 --bending --concept linear --points 3 --json {LINEAR}",
    f"front --mu 0.25 --bending --points 3 --csv front.csv {LINEAR}",
    *(f"airfoil show {name}" for name in SECTIONS),
    *(f"airfoil show {name} --json" for name in SECTIONS[:3]),
    "airfoil show sc1095 --mach 0.7 --alpha 4",
    "airfoil show sc1095 --mach 0.7 --alpha 4 --json",
    "airfoil show sc1095-thesis --mach 0.3 --alpha 4 --json",
)
SEARCHES = (
    f"optimise --mu 0.3 --starts 2 {LINEAR}",
    f"optimise --mu 0.3 --starts 2 --json {LINEAR}",
    f"optimise --concept two-segment --mu 0.3 --starts 2 --rate-deg -20,0 {LINEAR}",
    f"optimise --concept two-segment-two-airfoils --starts 1 --json {COARSE}",
    f"optimise --concept three-segment-free --starts 1 --no-band {COARSE}",
    f"optimise --concept quadratic --starts 1 --on-top --change-deg 2 {COARSE}",
    f"optimise --concept free-form --starts 1 --no-band --json {COARSE}",
    f"optimise --objective hover-cruise --mu 0.3 --hover-share 0.3 --starts 1 {COARSE}",
    f"optimise --mission mission.csv --starts 1 {COARSE}",
    f"optimise --objective induced --starts 1 {COARSE}",
    f"optimise --objective vibration --mu 0.3 --bending --starts 1 {LINEAR}",
    f"optimise --mu 0.3 --bending --index-percent 2 --starts 1 --json {LINEAR}",
    f"optimise --mu 0.3 --stalled-percent 1 --mass-kg 9000 --starts 1 {LINEAR}",
    f"optimise --actuator MFC_P1 --plies 4 --starts 1 {LINEAR}",
    f"optimise --doubt --starts 1 {LINEAR}",
    "optimise --hover --starts 1",
    f"optimise --concept two-segment --division 0.4 --bound outboard_rate=-20,0 --starts 1 {COARSE}",
    f"optimise --mu 0.2 --climb-m-s=-14 --starts 1 --no-band {LINEAR}",
    f"schedule --concept linear --mu 0:0.3:0.15 --starts 1 --processes 1 {COARSE}",
    f"schedule --concept linear quadratic --mu 0.1,0.3 --starts 1 --processes 1 --json {COARSE}",
    f"schedule --mission mission.csv --concept linear --starts 1 --processes 1 --csv schedule.csv {COARSE}",
)
STUDIES = (
    "study trims.toml --workers 1 --out small; study show small; study show small --json; "
    "study show small --csv all.csv --least power_profile_w --uncertain mu; study trims.toml --workers 1 --out small",
    "study sample.toml --workers 1 --out sampled; study show sampled; solve --row sampled:3",
    "study optima.toml --workers 1 --out best; study show best",
    "study sample.toml --dry-run",
)
ACTUATORS = (
    f"actuator {COARSE}",
    f"actuator --json {COARSE}",
    f"actuator --actuator MFC_P1 --plies 4 --concept two-segment --division 0.5 {COARSE}",
    f"actuator --blade new --stiffness 0.5 --angle-deg 40 --span 0.3:0.9 --chord 0.1:0.7 {COARSE}",
    f"actuator --against best-fixed --mission mission.csv {COARSE}",
    f"actuator --rotor bo105 {COARSE}",
    "actuator --table 5.1",
    "actuator --table 5.1 --json",
    f"actuator --what-would-pay --plot line.svg {COARSE}",
    f"actuator --what-would-pay --json {COARSE}",
)
CHECKS = (
    "validate knight-hefner-3",
    "validate xv15-hover xv15-forward-15deg --json",
    "validate pca2 --plot drawn",
    "validate xv15-forward-0deg --inflow drees",
    "validate 2mrts-inflow",
    "validate hart2-airloads --json",
    "validate flown-power",
    "validate uh60a-constants sc1095 glasgow-loops",
    "validate theory --page pages",
    "validate castles-gray-hover --page pages",
    "reproduce out --figure 3.3 --figure 2.7 --processes 1",
    "reproduce out --table 3.1 --figure 3.11 --processes 1",
)
HELP = (
    "",
    "--help",
    "--version",
    "completion",
    *(f"{name} --help" for name in NAMES),
)
REFUSED = (
    "solv", "solve --mu 9", "solve --mu fast", "solve --mu nan", "solve --mu 0.2 --hover", "solve --mass-kg 9.5",
    "solve --no-such-flag", "solve --twst linear:-8", "solve --twist linaer:-8", "solve --twist -12",
    "solve --twist linear:8 --twist ''", "solve --twist table:nowhere.txt", "solve --twist table:no.txt",
    "solve --twist segments:-3,-4@1.2", "solve --twist spline:1,2@0.2,0.8", "solve --rotor r44",
    "solve --rotor none.toml", "solve --rotor broken.toml", "solve --rotor no.toml", "solve --case none.json",
    "solve --case no.json", "solve --case trims.toml", "solve --inflow magic", "solve --low-speed fly",
    "solve --off noise", "solve --airfoils sc1095,sc1094r8", "solve --airfoils nosection", "solve --elements many",
    "solve --elements 3", "solve --azimuths 7", "solve --preset best", "solve --preset thesis --climb-m-s 4",
    "solve --pitch-per-rev 1:1:0", "solve --pitch-per-rev 3:1", "solve --twist-per-rev 2:21:0",
    "solve --ct-over-sigma 0.07", "solve --trim controls --thrust-n 20", "solve --trim glide",
    "solve --trim wind-tunnel --ct-over-sigma 0.5", "solve --trim wind-tunnel --ct-over-sigma 0.07 --hub-roll-nm 5",
    "solve --trim free-rotor --hover --ct-over-sigma 0.07", "solve --row STUDY", "solve --row STUDY:9999",
    "solve --row nowhere:1", "solve --row STUDY:1 --case a.json", "solve --save a.toml", "solve --save none/a.json",
    "solve --carry MFC", "solve --carry MFC_P1,drive=120", "solve --carry MFC_P1,plies=40",
    "solve --rotor s61 --carry MFC_P1", "sweep", "sweep --mu 0.4:0.1:0.1", "sweep --mu 0.1 --speed-kt 80",
    "sweep --mu 0.1:0.3:0.1 --mass-kg 7000:8000:500", "sweep --mu 0.1:0.2:0.1 --csv - --json",
    "sweep --mu 0.1 --twist linear:-8 --relative-to builtin", "front --mu 0.3", "front --mu 0.1 --bending",
    "front --mu 0.3 --bending --harmonics two", "front --mu 0.3 --bending --points 1", "optimize --hover",
    "optimise --concept wavy", "optimise --concept two-segment --division half", "optimise --objective noise",
    "optimise --hover-share 0.5", "optimise --bound angle=1,2", "optimise --bound rate=1", "optimise --rate-deg 3",
    "optimise --change-deg 1 --actuator MFC_P1", "optimise --plies 3", "optimise --starts 0",
    "optimise --mission no.csv", "optimise --mission none.csv", "optimise --objective hover-cruise --hover",
    "optimise --doubt --mission mission.csv", "optimise --trim free-rotor --ct-over-sigma 0.06",
    "schedule --hover", "schedule --processes 0", "schedule --plies 3", "study nowhere.toml", "study no.toml",
    "study broken.toml", "study trims.toml small", "study trims.toml --workers 0", "study show nowhere",
    "study show", "validate xv16", "validate xv15-hover --inflow drees", "reproduce out --processes 0",
    "reproduce out --figure 9.9", "reproduce out --figure 2.1", "reproduce out --trust --figure 3.3",
    "actuator --actuator MFC_P", "actuator --plies 0", "actuator --from-mu 0.3", "actuator --span 0.2",
    "actuator --chord 0.5:0.1", "actuator --blade retrofit --stiffness 0.5", "actuator --blade new --stiffness 5",
    "actuator --angle-deg 0", "actuator --plot line.svg", "actuator --share 2", "actuator --table 5.3",
    "actuator --concept two-segment --division 1.5", "airfoil show sc1096", "airfoil build sc1095",
    "airfoil show sc1095 --mach 0.7", "airfoil show sc1095 --mach 5 --alpha 1",
)  # fmt: skip
"""Bad input of each kind."""
COMMANDS = HELP + SOLVE + SWEEP + TABLES + SEARCHES + STUDIES + ACTUATORS + CHECKS + REFUSED

TIMED = "elapsed"
"""What the names of columns with times begin with."""
PAGE_COMMANDS = (
    "--help", "--version", "report --help", "blade --help", "repotr", "--port x", "--port 70000", "--host ''",
    "--allow-host a/b", "--max-sessions 0", "--design none.json --no-browser", "report none.json",
    "report no.json --out report.pdf", "report no.json", "blade none.json", "blade no.json",
)  # fmt: skip
"""Words after `python -m explorer`; none of them starts a server."""


def write(record: Record) -> None:
    """Each command in a folder of its own, where the files that commands read are."""
    for words in COMMANDS:
        record.scenario(f"rotor {words}".strip(), run, "rotor", words)
    for words in PAGE_COMMANDS:
        record.scenario(f"explorer {words}", run, "explorer", words)


def run(record: Record, program: str, words: str) -> None:
    """Keep what commands print, their exit codes and the files that they leave; `; ` stands between two commands."""
    main = named(f"{program}.__main__.main")
    study = named("rotor.support.assets.asset_path")("studies") / "hover_cruise_264"
    folder = Path(f"command {len(list(Path().iterdir()))}").resolve()
    folder.mkdir()
    os.chdir(folder)
    for name, text in FILES.items():
        Path(name).write_text(text, "utf-8")
    steps = words.split("; ")
    first = f"{program} {steps[0]}".strip()
    for number, one in enumerate(steps, start=1):
        name = first if number == 1 else f"{first}/{number} {one}"
        out = io.StringIO()
        error = io.StringIO()
        arguments = [word.replace("STUDY", str(study)) for word in shlex.split(one)]
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
            record.ask(f"{name}/exit code", main, arguments)
        record.keep(f"{name}/stdout", out.getvalue())
        record.keep(f"{name}/stderr", error.getvalue())
    for path in sorted(Path().rglob("*")):
        if path.is_file() and path.name not in FILES:
            record.keep(f"{first}/file {path}", content(path))
    os.chdir(folder.parent)


def content(path: Path) -> str | bytes | dict[str, Any]:
    """A file's text without times, the columns of a table, or the bytes of what has neither."""
    if path.suffix == ".parquet":
        table = named("pyarrow.parquet.read_table")(path).to_pydict()
        return {name: values for name, values in table.items() if not name.startswith(TIMED)}
    try:
        text = path.read_text("utf-8")
    except UnicodeDecodeError:
        return path.read_bytes()
    return without_times(text) if path.suffix == ".csv" else text


def without_times(text: str) -> str:
    """A table without the columns of times."""
    rows = list(csv.reader(text.splitlines()))
    timed = {number for number, name in enumerate(rows[0]) if name.startswith(TIMED)}
    if not timed:
        return text
    kept = [[cell for number, cell in enumerate(row) if number not in timed] for row in rows]
    return "\n".join(",".join(row) for row in kept)
