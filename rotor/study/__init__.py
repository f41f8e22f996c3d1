"""Studies: from one design to a million, on one machine or a cluster.

A study file names axes, fixed values and models; each point is a trim or an optimum. Points are computed in chunks of
neighbours, so that each trim starts from the previous one. Chunks run on Dask, and each is stored as a Parquet file as
soon as it is finished. The result of a chunk depends on the study file only.
"""

from rotor.study.findings import best_row, effects, robust_best
from rotor.study.results import Results, design_of_row, read_results
from rotor.study.study import Study
from rotor.study.study_file import read_study

__all__ = (
    "Results",
    "Study",
    "best_row",
    "design_of_row",
    "effects",
    "read_results",
    "read_study",
    "robust_best",
)
