"""What cached functions of the solver read: their arguments, and nothing that may ever be chosen otherwise."""

import numpy as np

from rotor.support.arrays import Array, bytes_cache


def test_large_results_are_kept_by_their_bytes():
    made = list[int]()

    @bytes_cache(3 * 800)
    def hundred(number: int) -> Array:
        made.append(number)
        return np.full(100, float(number))

    for number in (1, 2, 3, 1, 4, 1, 2):  # 4 pushes out 2, which was used longest ago; 2 then 3.
        assert hundred(number)[0] == number
    assert made == [1, 2, 3, 4, 2]

    @bytes_cache(10)
    def large(number: int) -> Array:
        made.append(number)
        return np.zeros(100)

    assert large(7) is large(7)
    assert made[-2:] == [2, 7]
