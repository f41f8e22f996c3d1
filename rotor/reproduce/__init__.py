"""The document's figures and tables, rebuilt: each with its statement, our number and a verdict decided by it.

`python -m rotor reproduce OUT`. One chapter section a file; each figure is a function that returns a `Report`.
Chapters 4–6 of the document are known to us by their captions only, so nothing there is compared: ours stands alone.
"""

from rotor.reproduce.catalogue import ENTRIES as ENTRIES
from rotor.reproduce.catalogue import find_entry as find_entry
from rotor.reproduce.report import Agreement as Agreement
from rotor.reproduce.report import Report as Report
