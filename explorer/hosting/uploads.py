"""What a browser may upload: how much, in how many parts, of which type. Pure.

The page's server keeps every part in memory until the last has come, and believes whatever size is claimed.
"""

LARGEST = 4 * 2**20
"""[bytes]: ten times the largest deck of section data anybody publishes."""
_PARTS = 64
"""The page sends parts of half a megabyte; a million small ones would take a hundred times their size."""
_OF_TYPE = {".parquet": 32 * 2**20}
"""[bytes] the same for files that are larger by nature: results of a study, some hundred thousand designs."""
AT_ONCE = 2
"""Files on their way from one page."""


def refusal(name: str, size: int, parts: int, under_way: int, accepts: str) -> str | None:
    """Why a file is not taken, in a sentence; None where it is. `accepts`: as in HTML, ".json,.toml" or "*/*"."""
    most = next((largest for ending, largest in _OF_TYPE.items() if name.lower().endswith(ending)), LARGEST)
    if size > most:
        return f"{_cut(name)} has {size / 2**20:.1f} MB: {most // 2**20} MB are the most."
    if not _fits(name, accepts):
        return f"{_cut(name)} is not of a type that is read here: choose a {accepts.replace(',', ' or ')} file."
    if under_way >= AT_ONCE:
        return f"{_cut(name)} must wait until the files before it have arrived: press again then."
    if size < 0 or not 0 <= parts <= _PARTS:
        return f"{_cut(name)} comes in {parts} parts: {_PARTS} are the most."
    return None


def _fits(name: str, accepts: str) -> bool:
    """Whether the ending is one of those listed; types without a dot say nothing about names."""
    endings = [item.strip().lower() for item in accepts.split(",")]
    return any(not item.startswith(".") or name.lower().endswith(item) for item in endings)


def _cut(name: str) -> str:
    return repr(name if len(name) <= 60 else name[:57] + "…")
