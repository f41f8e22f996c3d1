"""Figures and tables of the thesis, rebuilt: each with its statement, our number and the resulting verdict.

`python -m rotor reproduce OUT`. One topic per file; each figure is a function that returns a `Report`.
Of chapters 4–6 only the captions are known, so those results are not compared.
"""
