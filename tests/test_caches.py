"""What cached functions of the solver read: their arguments, and nothing that may ever be chosen otherwise."""

import ast
import re
from pathlib import Path

import numpy as np

from rotor.support.arrays import Array, bytes_cache

ROTOR = Path(__file__).parent.parent / "rotor"
FIXED = {
    "sizes of tables": "N_ALPHA N_MACH ALPHA_STEP MACH_STEP _STATIONS AREA_RADII LIFT_ORDER DRAG_ORDER",
    "places of channels, forces, waves and columns": """
        CHANNELS FORCES HOVER_PAIRS UP UR UT TH RATE FX FZ FR COS SIN STEADY ONE ZERO ATTACHED NEGATIVE POSITIVE ONSET
        SLOPE SWIRL SWIRL_SLOPE STATE_NAMES _DERIVED SLOPES RATES BENDING SW SV KW KV GW GV MW MV _PUSHED
    """,
    "names and sources of assets": """
        SECTION_NAMES TABLE_NAMES THESIS_NAME _OUTLINES _MEASURED _SLOPE _SOURCE _TUNNEL_SOURCE
    """,
    "nature, and published tables": """
        GRAVITY LEAST_SEPARATION WIDEST _CENTRE _LAGS _LAG_MACH REVERSE_FLOW_DEG
    """,
}


def test_a_choice_of_the_solver_reaches_a_cached_function_as_an_argument():
    """Were it read from its module, another choice would get what was kept for the first."""
    allowed = set(" ".join(FIXED.values()).split())
    read = set[tuple[str, str]]()
    for folder in ("airfoil", "design", "dynamics", "aero", "engine", "columns", "trim"):
        for file in sorted((ROTOR / folder).rglob("*.py")):
            for function in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                if isinstance(function, ast.FunctionDef) and any(
                    re.search(r"\b(lru_|bytes_)?cache\b", ast.unparse(one)) for one in function.decorator_list
                ):
                    inside = (node for line in function.body for node in ast.walk(line))
                    names = {node.id for node in inside if isinstance(node, ast.Name)}
                    read |= {(function.name, name) for name in names if re.fullmatch(r"_?[A-Z][A-Z0-9_]+", name)}
    assert read
    assert sorted((function, name) for function, name in read if name not in allowed) == []
    assert sorted(allowed - {name for _, name in read}) == []


def test_large_results_are_kept_by_their_bytes():
    made = list[int]()

    @bytes_cache(3 * 800)
    def hundred(number: int) -> Array:
        made.append(number)
        return np.full(100, float(number))

    for number in (1, 2, 3, 1, 4, 1, 2):  # 4 pushes out 2, which was used longest ago; 2 then 3.
        assert hundred(number)[0] == number
    assert made == [1, 2, 3, 4, 2]

    @bytes_cache(10)
    def large(number: int) -> Array:
        made.append(number)
        return np.zeros(100)

    assert large(7) is large(7)
    assert made[-2:] == [2, 7]
