"""Velocity that the vortex filaments of all blades induce, with its exact derivatives by every node.

The wake of a hovering rotor is steady seen from a blade and the same behind each blade. So a filament is a row of nodes
(r, z) at wake azimuths χ = j Δχ behind its blade, and targets lie on the same azimuths. With a target on the x-axis of
its own frame, the components x, y, z of the velocity are radial, in the direction of rotation, and up.

A straight segment from A to B of circulation Γ, with r1 = x − A, r2 = x − B, induces

    v = Γ/4π · (r1 × r2) s/D,    s = (|r1| + |r2|)(1 − cos(r1, r2)),    D² = |r1 × r2|⁴ + r_c⁴ |r2 − r1|⁴,

the law of Biot and Savart with the core of Vatistas (Vatistas, Kozel & Mih, Experiments in Fluids 11, 1991, n = 2).
"""

import math
from typing import Any

import numpy as np

from rotor.arrays import Array
from rotor.compiled import compiled

_TINY = 1e-40
_FOUR_PI = 4.0 * math.pi


# Sums in any order, so that the loop over segments uses vector instructions; nothing is assumed of NaN or infinity.
_compile = compiled(error_model="numpy", fastmath={"contract", "reassoc", "nsz", "arcp"})


@_compile
def filament_velocity(target: Any, x: Array, y: Array, z: Array, source: Array, first: int, velocity: Any) -> None:
    """Add to `velocity` (3,) what one filament of unit circulation induces.

    target: (r, z, square of the target's own core). x, y, z: nodes of the filament in the target's frame. source:
    square of the core of each segment. first: number of the first segment that counts.
    """
    tx, tz, own = target[0], target[1], target[2]
    vx = 0.0
    vy = 0.0
    vz = 0.0
    for j in range(first, len(x) - 1):
        ax = tx - x[j]
        ay = -y[j]
        az = tz - z[j]
        bx = tx - x[j + 1]
        by = -y[j + 1]
        bz = tz - z[j + 1]
        a = math.sqrt(ax * ax + ay * ay + az * az + _TINY)
        b = math.sqrt(bx * bx + by * by + bz * bz + _TINY)
        cx = ay * bz - az * by
        cy = az * bx - ax * bz
        cz = ax * by - ay * bx
        square = cx * cx + cy * cy + cz * cz
        lx = ax - bx
        ly = ay - by
        lz = az - bz
        length = lx * lx + ly * ly + lz * lz
        core = source[j] + own
        d = math.sqrt(square * square + core * core * length * length + _TINY)
        g = (a + b) * (1.0 - (ax * bx + ay * by + az * bz) / (a * b)) / d
        vx += g * cx
        vy += g * cy
        vz += g * cz
    velocity[0] += vx / _FOUR_PI
    velocity[1] += vy / _FOUR_PI
    velocity[2] += vz / _FOUR_PI


@_compile
def filament_slopes(
    target: Any, x: Array, y: Array, z: Array, cos: Array, sin: Array, source: Array, first: int,
    velocity: Any, by_target: Any, by_core: Any, growth: Array, start: Array, end: Array,
) -> None:  # fmt: skip
    """The same with derivatives, all added to the arrays given.

    cos, sin: of the azimuth of each node, seen from the target. by_target (6,): velocity by the target's r and z.
    by_core (3,): by a factor on `growth`, the part of `source` that grows. start, end, (6, segments): velocity by r and
    z of each segment's first and last node.
    """
    tx, tz, own = target[0], target[1], target[2]
    vx = 0.0
    vy = 0.0
    vz = 0.0
    rx = 0.0
    ry = 0.0
    rz = 0.0
    zx = 0.0
    zy = 0.0
    zz = 0.0
    qx = 0.0
    qy = 0.0
    qz = 0.0
    for j in range(first, len(x) - 1):
        ax = tx - x[j]
        ay = -y[j]
        az = tz - z[j]
        bx = tx - x[j + 1]
        by = -y[j + 1]
        bz = tz - z[j + 1]
        a = math.sqrt(ax * ax + ay * ay + az * az + _TINY)
        b = math.sqrt(bx * bx + by * by + bz * bz + _TINY)
        ia = 1.0 / a
        ib = 1.0 / b
        cx = ay * bz - az * by
        cy = az * bx - ax * bz
        cz = ax * by - ay * bx
        square = cx * cx + cy * cy + cz * cz
        lx = ax - bx
        ly = ay - by
        lz = az - bz
        length = lx * lx + ly * ly + lz * lz
        core = source[j] + own
        q = core * core
        invd = 1.0 / math.sqrt(square * square + q * length * length + _TINY)
        dot = ax * bx + ay * by + az * bz
        s = (a + b) * (1.0 - dot * ia * ib)
        g = s * invd
        vx += g * cx
        vy += g * cy
        vz += g * cz
        # ∂s/∂r1 = e1 − e2 − (r2 − (r2·e1) e1)/|r1|, and the same with the ends exchanged.
        ka = dot * ia * ia * ia
        kb = dot * ib * ib * ib
        sax = ax * ia - bx * ib - bx * ia + ka * ax
        say = ay * ia - by * ib - by * ia + ka * ay
        saz = az * ia - bz * ib - bz * ia + ka * az
        sbx = bx * ib - ax * ia - ax * ib + kb * bx
        sby = by * ib - ay * ia - ay * ib + kb * by
        sbz = bz * ib - az * ia - az * ib + kb * bz
        # ∂D/∂r1 = 2 (|c|² r2 × c + q l² l)/D, ∂D/∂r2 = 2 (|c|² c × r1 − q l² l)/D; g = s/D.
        w = 2.0 * g * invd * invd
        m = w * square
        n = w * q * length
        gax = sax * invd - m * (by * cz - bz * cy) - n * lx
        gay = say * invd - m * (bz * cx - bx * cz) - n * ly
        gaz = saz * invd - m * (bx * cy - by * cx) - n * lz
        gbx = sbx * invd - m * (cy * az - cz * ay) + n * lx
        gby = sby * invd - m * (cz * ax - cx * az) + n * ly
        gbz = sbz * invd - m * (cx * ay - cy * ax) + n * lz
        # Along x and z of the target: both ends move away together.
        h = gax + gbx
        rx += cx * h
        ry += cy * h - g * bz + g * az
        rz += cz * h + g * by - g * ay
        h = gaz + gbz
        zx += cx * h - g * by + g * ay
        zy += cy * h + g * bx - g * ax
        zz += cz * h
        h = -g * core * length * length * invd * invd * growth[j]
        qx += h * cx
        qy += h * cy
        qz += h * cz
        # First node along its radius d = (cos, sin, 0): r1 changes by −d; d × r2 = (sin bz, −cos bz, cos by − sin bx).
        h = gax * cos[j] + gay * sin[j]
        start[0, j] -= cx * h + g * sin[j] * bz
        start[1, j] -= cy * h - g * cos[j] * bz
        start[2, j] -= cz * h + g * (cos[j] * by - sin[j] * bx)
        start[3, j] -= cx * gaz - g * by
        start[4, j] -= cy * gaz + g * bx
        start[5, j] -= cz * gaz
        # Last node: r1 × d = (−sin az, cos az, sin ax − cos ay).
        h = gbx * cos[j + 1] + gby * sin[j + 1]
        end[0, j] -= cx * h - g * sin[j + 1] * az
        end[1, j] -= cy * h + g * cos[j + 1] * az
        end[2, j] -= cz * h + g * (sin[j + 1] * ax - cos[j + 1] * ay)
        end[3, j] -= cx * gbz + g * ay
        end[4, j] -= cy * gbz - g * ax
        end[5, j] -= cz * gbz
    velocity[0] += vx / _FOUR_PI
    velocity[1] += vy / _FOUR_PI
    velocity[2] += vz / _FOUR_PI
    by_target[0] += rx / _FOUR_PI
    by_target[1] += ry / _FOUR_PI
    by_target[2] += rz / _FOUR_PI
    by_target[3] += zx / _FOUR_PI
    by_target[4] += zy / _FOUR_PI
    by_target[5] += zz / _FOUR_PI
    by_core[0] += qx / _FOUR_PI
    by_core[1] += qy / _FOUR_PI
    by_core[2] += qz / _FOUR_PI


@_compile
def cylinder_velocity(r: float, zeta: float, radius: float, points: int) -> Any:
    """v_r and v_z of a half-infinite vortex cylinder of unit strength per length, and their slopes by r, ζ and radius.

    The cylinder reaches from z = 0 down; its vorticity turns against the rotor, as that of tip vortices does. The
    target is ζ above its upper end. The integral along the cylinder is done; that around it takes `points` midpoints of
    the half circle:

        v_r = −R/4π ∫ cos θ/S dθ,    v_z = −R/4π ∫ (R − r cos θ)/(S (S + ζ)) dθ,    S² = R² + r² − 2Rr cos θ + ζ².
    """
    vr = 0.0
    vr_r = 0.0
    vr_z = 0.0
    vr_b = 0.0
    vz = 0.0
    vz_r = 0.0
    vz_z = 0.0
    vz_b = 0.0
    for k in range(points):
        cos = math.cos((k + 0.5) * math.pi / points)
        inward = radius - r * cos
        s = math.sqrt(radius * radius + r * r - 2.0 * radius * r * cos + zeta * zeta)
        s_r = (r - radius * cos) / s
        s_z = zeta / s
        s_b = inward / s
        vr += cos / s
        vr_r -= cos / (s * s) * s_r
        vr_z -= cos / (s * s) * s_z
        vr_b -= cos / (s * s) * s_b
        h = s * (s + zeta)
        by_s = -inward / (h * h) * (2.0 * s + zeta)
        vz += inward / h
        vz_r += -cos / h + by_s * s_r
        vz_z += by_s * s_z - inward * s / (h * h)
        vz_b += 1.0 / h + by_s * s_b
    scale = -radius / (2.0 * points)
    return (
        scale * vr, scale * vz, scale * vr_r, scale * vz_r, scale * vr_z, scale * vz_z,
        scale * vr_b - vr / (2.0 * points), scale * vz_b - vz / (2.0 * points),
    )  # fmt: skip


@_compile
def wake_velocities(
    radius: Array, height: Array, strength: Array, bound: Array, pitch: Array, pitch_slope: Array, free: int,
    cos: Array, sin: Array, blades: int, target: Array, azimuth: Any, family: Any, source: Array, growth: Array,
    near: int, bound_core: float, points: int, slopes: bool,
) -> Any:  # fmt: skip
    """Velocities at targets, (targets, 3): radial, in the direction of rotation, up; and their derivatives.

    radius, height: r and z of the nodes, (filaments, nodes); node 0 on the blade. strength: circulation of the
    filaments, positive as that of a tip vortex; bound: of the strips of the lifting line between them. Beyond node
    `free`, filaments have the constant `pitch` (filaments,) per radian, whose slope by z of the last free node less
    that one turn before is pitch_slope; at their ends begin vortex cylinders. cos, sin: of the azimuth steps of a turn.
    target: (r, z, square of its own core), (targets, 3); azimuth: its step behind the blade; family: the filament it is
    on, or −1 for a point of the lifting line, where segments before node `near` of its own blade do not act: the fine
    near wake stands for them. The innermost filament, at the root, does not act on itself.

    Derivatives: by node (targets, 3, filaments, free + 1, 2), the strengths included; by the target's own r and z
    (targets, 2, 3); by strength and by bound circulation (targets, 3, filaments or strips); by a factor on growth
    (targets, 3).
    """
    filaments, nodes = radius.shape
    turn = len(cos)
    shift = turn // blades
    count = len(target)
    velocity = np.zeros((count, 3))
    by_strength = np.zeros((count, 3, filaments))
    by_bound = np.zeros((count, 3, filaments - 1))
    rows = count if slopes else 1
    by_node = np.zeros((rows, 3, filaments, free + 1, 2))
    by_target = np.zeros((rows, 6))
    by_core = np.zeros((rows, 3))

    # Nodes as seen from a target that is s steps behind the same blade.
    x = np.empty((filaments, turn, nodes))
    y = np.empty((filaments, turn, nodes))
    seen_cos = np.empty((turn, nodes))
    seen_sin = np.empty((turn, nodes))
    for s in range(turn):
        for j in range(nodes):
            k = (s - j) % turn
            seen_cos[s, j] = cos[k]
            seen_sin[s, j] = sin[k]
            for f in range(filaments):
                x[f, s, j] = radius[f, j] * cos[k]
                y[f, s, j] = radius[f, j] * sin[k]

    start = np.zeros((6, nodes - 1))
    end = np.zeros((6, nodes - 1))
    end_x = np.empty(2)
    end_y = np.empty(2)
    end_z = np.zeros(2)
    end_cos = np.empty(2)
    end_sin = np.empty(2)
    bound_source = np.full(1, bound_core)
    no_growth = np.zeros(1)
    bound_start = np.zeros((6, 1))
    bound_end = np.zeros((6, 1))
    unit = np.zeros(3)
    unit_target = np.zeros(6)
    unit_core = np.zeros(3)

    for t in range(count):
        for f in range(filaments):
            if f == 0 and family[t] == 0:
                continue
            unit[:] = 0.0
            unit_target[:] = 0.0
            unit_core[:] = 0.0
            start[:] = 0.0
            end[:] = 0.0
            for b in range(blades):
                s = (azimuth[t] + b * shift) % turn
                first = near if b == 0 and family[t] < 0 else 0
                if slopes:
                    filament_slopes(
                        target[t], x[f, s], y[f, s], height[f], seen_cos[s], seen_sin[s], source[f], first,
                        unit, unit_target, unit_core, growth[f], start, end,
                    )  # fmt: skip
                else:
                    filament_velocity(target[t], x[f, s], y[f, s], height[f], source[f], first, unit)
            last = nodes - 1
            per_length = blades / (2.0 * math.pi * pitch[f])
            found = cylinder_velocity(target[t, 0], target[t, 1] - height[f, last], radius[f, last], points)
            unit[0] += per_length * found[0]
            unit[2] += per_length * found[1]
            for c in range(3):
                by_strength[t, c, f] = unit[c]
                velocity[t, c] += strength[f] * unit[c]
            if not slopes:
                continue
            unit_target[0] += per_length * found[2]
            unit_target[2] += per_length * found[3]
            unit_target[3] += per_length * found[4]
            unit_target[5] += per_length * found[5]
            for c in range(6):
                by_target[t, c] += strength[f] * unit_target[c]
            for c in range(3):
                by_core[t, c] += strength[f] * unit_core[c]
                by_pitch = 0.0
                by_last_r = 0.0
                by_last_z = 0.0
                for j in range(nodes):
                    along_r = 0.0
                    along_z = 0.0
                    if j < last:
                        along_r += start[c, j]
                        along_z += start[3 + c, j]
                    if j > 0:
                        along_r += end[c, j - 1]
                        along_z += end[3 + c, j - 1]
                    along_r *= strength[f] / _FOUR_PI
                    along_z *= strength[f] / _FOUR_PI
                    if j < free:
                        by_node[t, c, f, j, 0] = along_r
                        by_node[t, c, f, j, 1] = along_z
                    else:
                        by_last_r += along_r
                        by_last_z += along_z
                        by_pitch -= along_z * (j - free)
                step = 2.0 * math.pi / turn
                by_pitch *= step
                if c != 1:
                    k = 0 if c == 0 else 1
                    by_last_r += strength[f] * per_length * found[6 + k]
                    by_last_z -= strength[f] * per_length * found[4 + k]
                    by_pitch += strength[f] * per_length * (found[4 + k] * step * (last - free) - found[k] / pitch[f])
                by_node[t, c, f, free, 0] = by_last_r
                by_node[t, c, f, free, 1] = by_last_z + by_pitch * pitch_slope[f]
                by_node[t, c, f, free - turn, 1] -= by_pitch * pitch_slope[f]
        if family[t] < 0:
            continue  # The lifting lines of the other blades induce nothing normal to their own plane in sum.
        for k in range(filaments - 1):
            unit[:] = 0.0
            unit_target[:] = 0.0
            bound_start[:] = 0.0
            bound_end[:] = 0.0
            for b in range(blades):
                if b == 0 and azimuth[t] == 0:
                    continue
                s = (azimuth[t] + b * shift) % turn
                for e in range(2):
                    end_cos[e] = cos[s]
                    end_sin[e] = sin[s]
                    end_x[e] = radius[k + e, 0] * cos[s]
                    end_y[e] = radius[k + e, 0] * sin[s]
                if slopes:
                    filament_slopes(
                        target[t], end_x, end_y, end_z, end_cos, end_sin, bound_source, 0,
                        unit, unit_target, unit_core, no_growth, bound_start, bound_end,
                    )  # fmt: skip
                else:
                    filament_velocity(target[t], end_x, end_y, end_z, bound_source, 0, unit)
            for c in range(3):
                by_bound[t, c, k] = unit[c]
                velocity[t, c] += bound[k] * unit[c]
                if slopes:
                    by_node[t, c, k, 0, 0] += bound[k] * bound_start[c, 0] / _FOUR_PI
                    by_node[t, c, k + 1, 0, 0] += bound[k] * bound_end[c, 0] / _FOUR_PI
            if slopes:
                for c in range(6):
                    by_target[t, c] += bound[k] * unit_target[c]
    return velocity, by_node, by_target, by_strength, by_bound, by_core
