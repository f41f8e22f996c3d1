"""The compiled loops of the disk's picture against their plain forms."""

import io
import zlib

import numpy as np
import pytest
from PIL import Image

from explorer.picture.disk_image import encode_png, levels_of
from explorer.picture.polar import Sums, angles_of_attack
from explorer.picture.regions import mark_line


def test_sums_of_full_matrices_and_of_rows_with_one_term():
    rng = np.random.default_rng(3)
    along, around, field = rng.normal(size=(5, 4)), rng.normal(size=(6, 7)), rng.normal(size=(4, 6))
    along[2, 1:] = 0.0
    made = Sums(along, around, np.float64)([field, 2.0 * field])
    assert np.allclose(made[0], along @ field @ around, rtol=0.0, atol=1e-14)
    assert np.allclose(made[1], 2.0 * made[0], rtol=0.0, atol=1e-14)


def test_angle_of_attack_in_all_quadrants():
    u_t, u_p = (axis.astype(np.float32) for axis in np.meshgrid(np.linspace(-1.0, 1.0, 21), np.linspace(-0.9, 1.0, 23)))
    made = angles_of_attack(np.full_like(u_t, 0.25), u_t, u_p)
    assert np.abs(made - (0.25 - np.arctan2(u_p, u_t))).max() < 5e-7


class TestLine:
    @pytest.mark.parametrize("half_width", [0.001, 0.012, 0.03])
    def test_a_line_of_even_width_whatever_the_slope(self, half_width: float):
        """Zero at 0.6 R, rising ever more steeply around the disk; thin ones take the points on one side of it."""
        r, azimuths = np.linspace(0.1, 1.0, 226), 180
        slope = 1.0 + np.linspace(0.0, 0.4, azimuths)
        values = ((r[:, None] - 0.601) * slope).astype(np.float32)
        codes = np.zeros(values.shape, np.uint8)
        mark_line(codes, 7, values, np.ones(values.shape, np.bool_), half_width, r)
        middle = codes[:, 1:-1]  # Slope and so width jump where the turn closes.
        assert set(np.unique(codes)) == {0, 7}
        assert np.abs(np.nonzero(middle)[0] * 0.004 + 0.1 - 0.601).max() < half_width + 0.004
        width = np.count_nonzero(middle, axis=0) * 0.004
        assert np.abs(width - max(2.0 * half_width, 0.004)).max() <= 0.0041

    def test_none_where_values_only_touch_zero_nor_where_it_is_not_wanted(self):
        r = np.linspace(0.1, 1.0, 91)
        touching = np.tile(((r - 0.5) ** 2)[:, None], (1, 60)).astype(np.float32)
        codes = np.zeros(touching.shape, np.uint8)
        mark_line(codes, 7, touching + np.float32(1e-6), np.ones(codes.shape, np.bool_), 0.03, r)
        mark_line(codes, 7, touching - np.float32(0.01), np.zeros(codes.shape, np.bool_), 0.03, r)
        assert not codes.any()


def test_levels_span_the_range_and_hold_what_is_beyond():
    made = levels_of(np.array([[-9.0, 0.0, 0.5, 1.0, 9.0]]), 0.0, 1.0, 101)
    assert made.tolist() == [[1, 1, 51, 101, 101]]


def test_a_palette_png_is_read_as_written():
    rng = np.random.default_rng(5)
    pixels, entries = rng.integers(0, 256, (31, 17), np.uint8), rng.integers(0, 256, (256, 4), np.uint8)
    made = encode_png(pixels, entries)
    assert np.array_equal(np.asarray(Image.open(io.BytesIO(made)).convert("RGBA")), entries[pixels])
    assert zlib.crc32(made[12:29]) == int.from_bytes(made[29:33])  # Of the header; Pillow does not look at all of them.
