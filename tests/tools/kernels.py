"""Which kernels of OpenBLAS this processor can run: `python -m tests.tools.kernels NAME …` prints those names.

A process of its own tries each, for a kernel with instructions that the processor lacks ends it. What it does instead
is said on stderr.
"""

import os
import subprocess
import sys

TRY = """
import numpy as np, scipy.linalg, threadpoolctl
for kind in (np.float32, np.float64):
    matrix = np.random.default_rng(1).standard_normal((300, 300)).astype(kind)
    for solve in (np.linalg.solve, scipy.linalg.solve):
        assert np.allclose(solve(matrix, matrix @ matrix), matrix, atol=0.1)
print(*{one["architecture"] for one in threadpoolctl.threadpool_info() if one["user_api"] == "blas"})
"""


def runs(name: str) -> str:
    """The kernels with which the processor computes when asked for these; empty where it cannot."""
    environment = {**os.environ, "OPENBLAS_CORETYPE": name}
    done = subprocess.run(
        [sys.executable, "-c", TRY], env=environment, capture_output=True, text=True
    )
    return "" if done.returncode else done.stdout.strip()


if __name__ == "__main__":
    found = {name: runs(name) for name in sys.argv[1:]}
    for name, kernels in found.items():
        if kernels != name:
            print(
                f"{name}: " + (f"those of {kernels}" if kernels else "left out, cannot run here"),
                file=sys.stderr,
            )
    print(*(name for name, kernels in found.items() if kernels))
