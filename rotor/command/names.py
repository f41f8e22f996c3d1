"""The commands: what reads the flags of each, and its words in the list. Reading one reads no other."""

COMMANDS = {
    "solve": ("solve.add_parser", "trims one design: power, controls and caveats"),
    "sweep": (
        "tables.add_sweep",
        "power of one or more twists over speed, mass, altitude or another quantity of flight",
    ),
    "front": ("tables.add_front", "least power for less and less vibration, by active or static twist"),
    "waterfall": ("tables.add_waterfall", "power of tip loss, flapping, reverse flow …, one after another"),
    "optimise": ("optimise.add_parser", "twist of least power or vibration, width of the optimum, saving"),
    "schedule": ("schedule.add_parser", "optimum twist per condition, best fixed blade, gain of in-flight twist"),
    "envelope": (
        "envelope.add_parser",
        "largest load factor and mass over speed, top speed and ceiling, by stall and engines",
    ),
    "study": ("study.add_parser", "many designs from one file, on one machine or a cluster"),
    "stability": ("stability.add_parser", "damping of the blade's modes, margins to flutter and divergence"),
    "actuator": (
        "actuator.add_parser",
        "attainable twist, limits and net saving of an actuator between two flight conditions",
    ),
    "reproduce": ("reproduce.add_parser", "rebuilds every figure and table of the thesis that can be rebuilt"),
    "validate": ("validate.add_parser", "compares with every measured point of rotors that were tested"),
    "airfoil": ("tables.add_airfoil", "shows section data"),
    "warm": ("warm.add_parser", "compiles all kernels, once after installing"),
}
