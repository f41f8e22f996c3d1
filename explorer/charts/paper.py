"""What a picture is drawn on: its size in pixels, its ground, and how its words are arranged."""

from dataclasses import dataclass

SIZES = {
    "1280 × 720": (1280, 720),
    "1920 × 1080": (1920, 1080),
    "3840 × 2160": (3840, 2160),
    "2000 × 2000": (2000, 2000),
}
SMALLEST, LARGEST = 300, 4096
"""[px], along either edge: below, words cannot be read; above, some browsers have no canvas."""


@dataclass(frozen=True)
class Paper:
    """What a picture is drawn on."""

    width: int
    height: int
    """[px]"""
    dark: bool = False
    transparent: bool = False

    def __post_init__(self) -> None:
        for edge in (self.width, self.height):
            if not SMALLEST <= edge <= LARGEST:
                raise ValueError(
                    f"A picture of {self.width} × {self.height} pixels cannot be made: "
                    f"keep both edges within {SMALLEST}…{LARGEST}."
                )
        if not 0.4 <= self.width / self.height <= 3.0:
            raise ValueError(
                f"{self.width} × {self.height} leaves no room for words beside the disk: "
                "keep the longer edge within two and a half times the shorter."
            )

    @property
    def unit(self) -> float:
        """Hundredth part of what the words and the disk are measured by [px]."""
        return min(self.width, self.height) / 100.0

    @property
    def beside(self) -> bool:
        """Whether words stand beside the picture, or above and below it."""
        return self.width >= 1.35 * self.height
