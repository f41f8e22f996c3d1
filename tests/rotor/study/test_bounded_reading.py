"""Results that a visitor uploads are read within bounds of memory and time."""

import importlib
import io
import multiprocessing
import random
import sys
import threading
import time
from multiprocessing import get_context
from multiprocessing.connection import Connection

import pyarrow as arrow
import pyarrow.parquet as parquet
import pytest

from rotor.assets import package_version
from rotor.study.chunks import StudyProvenance, evaluate_chunk
from rotor.study.results import limit_memory, read_bounded, read_file
from rotor.study.study_file import parse_study
from tests.rotor.study.test_study import SMALL

PROVENANCE = StudyProvenance(package_version(), None, "")
linux = pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")


def result_file(rows: int) -> bytes:
    """A result of a study in which all rows are equal, so that it packs to almost nothing."""
    study = parse_study(SMALL)
    small = evaluate_chunk(study, 0, PROVENANCE).content
    table = parquet.read_table(io.BytesIO(small)).slice(0, 1)
    many = table.take(arrow.array([0] * rows))
    out = io.BytesIO()
    parquet.write_table(many, out, compression="zstd")
    return out.getvalue()


@pytest.mark.slow
@linux
def test_a_file_that_unpacks_to_more_than_allowed_is_refused_with_a_sentence():
    content = result_file(1_000_000)
    assert len(content) < 1_000_000
    with pytest.raises(ValueError, match="too much memory"):
        read_bounded(content, "bomb.parquet", memory=60_000_000)
    with pytest.raises(ValueError, match="too long to read"):
        read_bounded(content, "slow.parquet", patience=0.0)


@pytest.mark.slow
def test_good_and_foreign_files_are_read_as_before():
    content = result_file(3)
    assert read_bounded(content, "good.parquet").rows == 3
    with pytest.raises(ValueError, match=r"'letter\.txt' is not a Parquet file"):
        read_bounded(b"dear", "letter.txt")


def read_forged(contents: list[bytes], answer: Connection) -> None:
    """Read each file with bounded memory; send what came of it."""
    results: list[str] = []
    importlib.import_module("pyarrow.parquet")
    limit_memory(500_000_000)
    for content in contents:
        try:
            read_file(content, "forged.parquet")
            results.append("read")
        except MemoryError:
            results.append("memory")
        except ValueError as error:
            results.append(str(error))
        except Exception as error:
            results.append(f"escaped: {error!r}")
    answer.send(results)


@pytest.mark.slow
@linux
def test_forged_files_are_read_or_refused_in_one_process_that_lives_on():
    """Sizes, offsets, counts and types are overwritten at random, half of them in the footer."""
    good, draw = result_file(2000), random.Random(1)
    footer = int.from_bytes(good[-8:-4], "little")
    forged: list[bytes] = []
    for _ in range(200):
        content = bytearray(good)
        places = draw.choice((range(4, 200), range(len(good) - 8 - footer, len(good) - 4), range(4, len(good))))
        for _ in range(draw.choice((1, 2, 4))):
            content[draw.choice(places)] = draw.choice((0, 127, 128, 255, draw.randrange(256)))
        forged.append(bytes(content))
    ours, theirs = get_context("spawn").Pipe(duplex=False)
    process = get_context("spawn").Process(target=read_forged, args=(forged, theirs))
    process.start()
    theirs.close()
    results = ours.recv() if ours.poll(100.0) else []
    process.join(10.0)
    assert len(results) == len(forged)
    assert [text for text in results if text.startswith("escaped")] == []
    assert "read" in results
    assert any("is not a Parquet file" in text for text in results)


@pytest.mark.slow
@linux
def test_one_file_is_read_at_a_time_for_all_pages_together():
    """So that many uploads at once need no more memory than one."""
    content, most = result_file(100_000), 0
    readers = [threading.Thread(target=read_bounded, args=(content, f"{k}.parquet")) for k in range(3)]
    for reader in readers:
        reader.start()
    while any(reader.is_alive() for reader in readers):
        most = max(most, sum(child.name == "parquet" for child in multiprocessing.active_children()))
        time.sleep(0.01)
    assert most == 1
