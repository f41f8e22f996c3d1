"""The commands: what reads the flags of each, its words in the list, and examples of it. Reading one reads no other."""

COMMANDS: dict[str, tuple[str, str, tuple[tuple[str, str], ...]]] = {
    "solve": (
        "solve.add_parser",
        "trim one design: power, controls and caveats",
        (
            (
                "The UH-60A with 8° of linear washout, and how uncertain its power is",
                "--mu 0.3 --twist linear:-8 --doubt",
            ),
            ("An R22 in hover without tip loss", "--rotor r22 --hover --off tip-loss"),
            ("Hub loads of bending blades; the design is kept in a file", "--mu 0.3 --bending --save mine.json"),
        ),
    ),
    "sweep": (
        "tables.add_sweep",
        "power of one or more twists over speed, mass, altitude or another flight quantity",
        (
            ("Two twists over speed, also as CSV", "--mu 0:0.3:0.1 --twist linear:-8 linear:-14 --csv power.csv"),
            ("Power over altitude at 80 kt", "--speed-kt 80 --altitude-m 0:2000:1000"),
        ),
    ),
    "front": (
        "tables.add_front",
        "trade-off curve of least power against vibration, by active or static twist",
        (
            (
                "2/rev twist of at most 2° with bending blades",
                "--mu 0.3 --bending --harmonics 2 --reach-deg 2 --points 2",
            ),
        ),
    ),
    "waterfall": (
        "tables.add_waterfall",
        "power of each physical effect, such as tip loss, flapping or reverse flow",
        (("At µ 0.3", "--mu 0.3"),),
    ),
    "optimise": (
        "optimise.add_parser",
        "twist of least power or vibration, how flat the optimum is, and what it saves",
        (
            ("Least power of two segments", "--concept two-segment --mu 0.3 --starts 2"),
            (
                "Least mean power of hover and µ 0.3, half the time each",
                "--objective hover-cruise --mu 0.3 --rate-deg -20,0",
            ),
        ),
    ),
    "schedule": (
        "schedule.add_parser",
        "best twist at each flight condition, best fixed blade, and gain of changing twist in flight",
        (("Linear twist in hover and at µ 0.15 and 0.3", "--concept linear --mu 0:0.3:0.15 --starts 1 --processes 1"),),
    ),
    "study": (
        "study.add_parser",
        "many designs from one file, on one machine or a cluster",
        (
            ("Check a shipped study and estimate its time", "two_segment.toml --dry-run"),
            ("Run it on four processes", "two_segment.toml --out results --workers 4"),
            ("Its best point", "show results"),
        ),
    ),
    "actuator": (
        "actuator.add_parser",
        "twist that an actuator can reach between two flight conditions, its limits and net saving",
        (
            ("From hover to µ 0.3 with four plies per skin", "--actuator MFC_P1 --plies 4 --to-mu 0.3"),
            ("All actuators", "--table 5.1"),
        ),
    ),
    "reproduce": (
        "reproduce.add_parser",
        "rebuild every figure and table of the thesis that can be rebuilt",
        (("One figure", "thesis --figure 3.11"),),
    ),
    "validate": (
        "validate.add_parser",
        "compare with every measured point of rotors that were tested",
        (("One rotor in hover", "knight-hefner-3"),),
    ),
    "airfoil": (
        "tables.add_airfoil",
        "show section data",
        (("Slopes, stall and drag over Mach number", "show sc1095"), ("One point", "show sc1095 --mach 0.7 --alpha 4")),
    ),
    "warm": ("warm.add_parser", "compile all kernels, once after installing", (("After installing", ""),)),
}
