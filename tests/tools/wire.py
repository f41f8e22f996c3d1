"""The page's protocol as its client speaks it: subprotocol, frames of messages in, single messages out."""

from importlib.metadata import version
from typing import Any

import msgspec.msgpack
import zstandard

SUBPROTOCOL = f"viser-v{version('viser')}"
"""What a client of the served page asks for; the server refuses others."""
_HEADER = 8
_ALIGNMENT = 8

Message = dict[str, Any]


def decode(frame: bytes) -> list[Message]:
    """The messages of one frame: sizes, compressed metadata, then raw arrays, each at a multiple of 8 bytes.

    Arrays come back as `memoryview`s of their bytes. ValueError where the frame is none.
    """
    size = int.from_bytes(frame[:_HEADER], "little")
    packed = int.from_bytes(frame[_HEADER : 2 * _HEADER], "little")
    begin = 2 * _HEADER
    try:
        body = zstandard.ZstdDecompressor().decompress(
            frame[begin : begin + packed], max_output_size=size
        )
        content = msgspec.msgpack.decode(body)
    except (zstandard.ZstdError, msgspec.DecodeError) as error:
        raise ValueError(f"A frame of {len(frame)} bytes cannot be read: {error}") from error
    arrays: list[memoryview] = []
    at = begin + packed
    for length in content.get("binaryBufferLengths", ()):
        at += -at % _ALIGNMENT
        arrays.append(memoryview(frame)[at : at + length])
        at += length
    return [_filled(message, arrays) for message in content["messages"]]


def encode(kind: str, **fields: Any) -> bytes:
    """One message to the server."""
    return msgspec.msgpack.encode({"type": kind, **fields})


def _filled(value: Any, arrays: list[memoryview]) -> Any:
    """The value with arrays where the metadata only counted them."""
    if isinstance(value, dict):
        if "__binary_index" in value:
            return arrays[value["__binary_index"]]
        return {key: _filled(item, arrays) for key, item in value.items()}
    if isinstance(value, list):
        return [_filled(item, arrays) for item in value]
    return value
