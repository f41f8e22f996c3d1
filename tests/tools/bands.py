"""Fit the errors of the model to the measured powers again, into assets/doubt.toml: `python -m tests.tools.bands`.

To be run when a computed power has moved, before `make trust`.
"""

import re

from rotor.support.assets import asset_path
from rotor.validation.doubt import MODEL, fitted, points_and_bands


def with_sizes(text: str, sizes: tuple[float, ...]) -> str:
    """The text of assets/doubt.toml with other sizes of `MODEL`, in per cent to the next half."""
    for name, size in zip(MODEL, sizes, strict=True):
        text = re.sub(
            rf"(\[{name}\]\nwords = .*\nsize = )[\d.]+", rf"\g<1>{round(200.0 * size) / 2}", text
        )
    return text


if __name__ == "__main__":
    path, sizes = asset_path("doubt.toml"), fitted(points_and_bands())
    path.write_text(with_sizes(path.read_text(encoding="utf-8"), sizes), encoding="utf-8")
    print(", ".join(f"{name} {100.0 * size:.1f}" for name, size in zip(MODEL, sizes, strict=True)))
