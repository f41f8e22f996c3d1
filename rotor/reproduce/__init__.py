"""Figures and tables of the thesis, rebuilt: each with its statement, our number and the resulting verdict.

`python -m rotor reproduce OUT`. One topic per file; each figure is a function that returns a `Report`.
Of chapters 4–6 only the captions are known, so those results are not compared.
"""

from rotor.reproduce.catalogue import ENTRIES as ENTRIES
from rotor.reproduce.catalogue import find_entry as find_entry
from rotor.reproduce.report import Agreement as Agreement
from rotor.reproduce.report import Report as Report
