"""Arrays of pixels → PNG files."""

import io

import numpy as np
from numpy.typing import NDArray
from PIL import Image

Bytes = NDArray[np.uint8]


def encode_png(pixels: Bytes, entries: Bytes, effort: int = 1) -> bytes:
    """A palette PNG: `pixels` of shape (rows, columns), `entries` RGBA of shape (256, 4), `effort` of zlib 0…9.

    A quarter of the size and a tenth of the time of a true-colour PNG.
    """
    image = Image.fromarray(pixels)
    image.putpalette(entries[:, :3].tobytes())
    file = io.BytesIO()
    image.save(file, "PNG", compress_level=effort, transparency=entries[:, 3].tobytes())
    return file.getvalue()


def encode_rgba(pixels: Bytes) -> bytes:
    """A true-colour PNG of shape (rows, columns, 4)."""
    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG", compress_level=1)
    return file.getvalue()
