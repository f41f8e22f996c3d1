"""Progress bars on a clock that nobody sets: tqdm's own stands still for as long as the wall clock is set back."""

import time
from typing import TYPE_CHECKING, Any

from tqdm import tqdm

if TYPE_CHECKING:
    _Bar = tqdm[Any]
else:
    _Bar = tqdm  # tqdm takes no subscript at run time.


class ProgressBar(_Bar):
    """tqdm, which takes the same arguments, with the time since its start from `time.monotonic`."""

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)  # pyright: ignore[reportUnknownMemberType]
        if not self.disable:  # A disabled bar has no clock.
            self._time = time.monotonic
            self.start_t = self.last_print_t = time.monotonic()
