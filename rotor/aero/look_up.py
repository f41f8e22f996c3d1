"""Look-up of section data at every azimuth of a row of blade elements: cells of the tables and their polynomials.

A cell's bicubic polynomial Σ a_kl u^k v^l has its sixteen coefficients side by side, the four of u^k in a row. Horner's
rule by u works on rows as vectors of four numbers, and then by v on the four of the result. The compiler makes no
such code of plain loops, so it is given here in the compiler's own terms; a computer without vectors of four splits
them.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir  # pyright: ignore[reportMissingTypeStubs]
from numba import types  # pyright: ignore[reportMissingTypeStubs]
from numba.extending import intrinsic  # pyright: ignore[reportMissingTypeStubs, reportUnknownVariableType]

from rotor.airfoil.bicubic import ALPHA_STEP, MACH_STEP, N_ALPHA, N_MACH
from rotor.arrays import Array
from rotor.compiled import compiled

_PI = math.pi
INVERSE_ALPHA = 1.0 / ALPHA_STEP
INVERSE_MACH = 1.0 / MACH_STEP
_CELL = 16
"""Coefficients of a cell's polynomial."""

_compile = compiled(error_model="numpy", fastmath={"contract"})


@_compile
def wrapped(angle: float) -> float:
    """The angle in [−π, π)."""
    return angle - 2.0 * _PI * math.floor((angle + _PI) * (0.5 / _PI))


@_compile
def places_along_alpha(alpha: Array, offset: float, cell: Any, place: Array) -> None:
    """Cells of the table and the places in them, from 0 to 1, of one row about the section's own chord."""
    for j in range(len(alpha)):
        x = (wrapped(alpha[j] - offset) + _PI) * INVERSE_ALPHA
        i = max(min(np.int32(x), np.int32(N_ALPHA - 1)), np.int32(0))  # Never outside, also where α is not a number.
        cell[j] = i
        place[j] = x - i


@_compile
def places_along_mach(mach: Array, cell: Any, place: Array, slope: Array) -> None:
    """The same along Mach, and ∂place/∂M: 0 beyond the table, where section data are constant; there is a caveat."""
    for j in range(len(mach)):
        y = min(mach[j] * INVERSE_MACH, N_MACH - 1e-9)
        i = max(min(np.int32(y), np.int32(N_MACH - 1)), np.int32(0))
        cell[j] = i
        place[j] = y - i
        slope[j] = INVERSE_MACH if mach[j] * INVERSE_MACH < N_MACH else 0.0


def _polynomial(*, slopes: bool) -> Callable[..., Any]:
    """What `intrinsic` needs: types, and the code that computes a cell's polynomial, with its slopes by u and v."""
    four, place = ir.VectorType(ir.DoubleType(), 4), ir.IntType(32)
    contracted = ("contract",)

    def polynomial(context: Any, tables: Any, first: Any, u: Any, v: Any) -> Any:
        del context, first, u, v
        result = types.UniTuple(types.float64, 3) if slopes else types.float64
        return result(tables, types.int64, types.float64, types.float64), code

    def code(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        def times_plus(a: Any, x: Any, b: Any) -> Any:
            return builder.fadd(builder.fmul(a, x, flags=contracted), b, flags=contracted)

        def horner(terms: list[Any], x: Any) -> tuple[Any, Any]:
            """Σ terms[k] x^k, and its slope."""
            value, slope = times_plus(terms[3], x, terms[2]), terms[3]
            for term in (terms[1], terms[0]):
                slope = times_plus(slope, x, value)
                value = times_plus(value, x, term)
            return value, slope

        def parts(vector: Any) -> list[Any]:
            return [builder.extract_element(vector, place(k)) for k in range(4)]

        tables, first, u, v = arguments
        data = context.make_array(signature.args[0])(context, builder, tables).data
        rows = builder.bitcast(builder.gep(data, [first]), four.as_pointer())
        terms = [builder.load(builder.gep(rows, [place(k)])) for k in range(4)]
        for term in terms:
            term.align = 8
        zeros = ir.Constant(ir.VectorType(place, 4), [0] * 4)
        u = builder.insert_element(ir.Constant(four, [0.0] * 4), u, place(0))
        u = builder.shuffle_vector(u, u, zeros)
        along, along_slope = horner(terms, u)
        value, by_v = horner(parts(along), v)
        if not slopes:
            return value
        by_u, _ = horner(parts(along_slope), v)
        return context.make_tuple(builder, signature.return_type, [value, by_u, by_v])

    return polynomial


surface: Any = intrinsic(_polynomial(slopes=True))
"""A cell's polynomial with its slopes by u and v, of (tables, first, u, v): it begins at coefficient `first`."""
height: Any = intrinsic(_polynomial(slopes=False))
"""The same without slopes."""


@_compile
def _start(tables: Any, which: int) -> Any:
    """Number of the first coefficient of a section, and by how much it grows with each cell along α and Mach."""
    along_mach = np.int64(tables.shape[3] * _CELL)
    along_alpha = np.int64(tables.shape[2]) * along_mach
    return np.int64(which) * tables.shape[1] * along_alpha, along_alpha, along_mach


@_compile
def look_up(
    tables: Any, which: int, at_alpha: Any, at_mach: Any, u: Array, v: Array, mach_slope: Array, share: float, out: Any
) -> None:
    """Blend a section into coefficients and slopes by α [rad] and Mach of one row, out[3 × coefficient] + 0, 1, 2.

    tables: (sections, α cells, Mach cells, coefficients, 4, 4); share: of this section, 1 for the first of two.
    """
    begin, along_alpha, along_mach = _start(tables, which)
    for j in range(len(u)):
        first = begin + at_alpha[j] * along_alpha + at_mach[j] * along_mach
        for k in range(tables.shape[3]):
            value, by_u, by_v = surface(tables, first + k * _CELL, u[j], v[j])
            by_alpha, by_mach = by_u * INVERSE_ALPHA, by_v * mach_slope[j]
            if share < 1.0:
                value = out[3 * k, j] + share * (value - out[3 * k, j])
                by_alpha = out[3 * k + 1, j] + share * (by_alpha - out[3 * k + 1, j])
                by_mach = out[3 * k + 2, j] + share * (by_mach - out[3 * k + 2, j])
            out[3 * k, j], out[3 * k + 1, j], out[3 * k + 2, j] = value, by_alpha, by_mach


@_compile
def look_up_values(
    tables: Any, which: int, at_alpha: Any, at_mach: Any, u: Array, v: Array, share: float, out: Any
) -> None:
    """As `look_up`, coefficients alone, out[coefficient]."""
    begin, along_alpha, along_mach = _start(tables, which)
    for j in range(len(u)):
        first = begin + at_alpha[j] * along_alpha + at_mach[j] * along_mach
        for k in range(tables.shape[3]):
            value = height(tables, first + k * _CELL, u[j], v[j])
            out[k, j] = out[k, j] + share * (value - out[k, j]) if share < 1.0 else value
