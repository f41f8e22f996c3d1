"""Numbers as people and programs write them in outlines, polars and decks."""

import math
import re

_NUMBER = re.compile(r"[+-]?(?:\d+[.,]?\d*|[.,]\d+)(?:e[+-]?\d{1,3})?")
_GROUPED = re.compile(r"[1-9]\d{0,2}([ ,'’])\d{3}(?:\1\d{3})*|[1-9]\d{0,2}(?:\.\d{3}){2,}")
_TIMES = {"k": 1e3, "thousand": 1e3, "million": 1e6, "millions": 1e6, "mio": 1e6}
STATED = (
    r"([+−-]?[0-9.,]+(?:[ '’][0-9]{3}(?![0-9.]))*"
    r"(?: ?(?:(?:[x×*·] ?10 ?\^?|[ed]) ?[+−-]? ?[0-9]+|(?:k|thousand|mio|millions?)\b))?)"
)
"""Pattern of a number in a sentence, in lower case; see `number_stated`."""


def number_of(word: str) -> float | None:
    """A finite number, also with a decimal comma, a Fortran exponent (1.5D-02) or a minus sign of print (U+2212); None
    for another word."""
    plain = word.strip().lower().replace("−", "-").replace("d", "e") if len(word) <= 40 else ""
    if _NUMBER.fullmatch(plain) is None:
        return None
    value = float(plain.replace(",", "."))
    return value if math.isfinite(value) else None


def number_stated(words: str) -> float | None:
    """A number of a sentence, as `STATED` finds it: also with separators (500,000), a factor (0.5 million) or the parts
    of an exponent apart (3.000 e 6, 5x10^5); None for other words."""
    text, factor = words.strip(" .,'’"), 1.0
    if match := re.fullmatch(r"(.*?) ?([a-z]+)", text):
        text, factor = match[1], _TIMES.get(match[2], math.nan)
    power = re.sub(r" ?[x×*·] ?10 ?\^? ?", "e", text).replace("−", "-")
    if "e" not in power and "d" not in power and _GROUPED.fullmatch(text):
        return factor * float(re.sub(r"\D", "", text))
    value = number_of(re.sub(r" ?([ed]) ?([+-]?) ?", r"\1\2", power))
    return None if value is None else factor * value
