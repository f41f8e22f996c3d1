"""Arrays of pixels → PNG files."""

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]


def encode_png(pixels: Bytes, entries: Bytes, effort: int = 1) -> bytes:
    """A palette PNG: `pixels` of shape (rows, columns), `entries` RGBA of shape (256, 4), `effort` of zlib 0…9.

    A quarter of the size and a tenth of the time of a true-colour PNG. Pillow would take half as long again,
    and hold the interpreter lock while it packs.
    """
    rows, columns = pixels.shape
    lines = np.zeros((rows, columns + 1), dtype=np.uint8)  # Each begins with its filter: none.
    lines[:, 1:] = pixels
    return b"".join(
        (
            b"\x89PNG\r\n\x1a\n",
            _chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 3, 0, 0, 0)),
            _chunk(b"PLTE", entries[:, :3].tobytes()),
            _chunk(b"tRNS", entries[:, 3].tobytes()),
            _chunk(b"IDAT", zlib.compress(lines.tobytes(), effort)),
            _chunk(b"IEND", b""),
        )
    )


def _chunk(kind: bytes, content: bytes) -> bytes:
    """Length, kind, content and check sum."""
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(content, zlib.crc32(kind)))
