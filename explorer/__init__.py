"""The browser page: widgets → `Design` → `solve` → `Solution` → pictures, plots, read-outs.

Modules that make arrays, text and decisions do not know viser; `tests/test_layers.py` lists those that may. Long work
runs in processes: `SearchRequest` → `Search` → `workers.tasks` in a process → `tabs.optimise.run` → frames and charts.
The session shows the designs of a search in place of the sliders' design until they are applied or discarded.

World axes: x aft (ψ = 0), y to starboard (ψ = 90°, the advancing side), z up, in metres, origin at the rotor centre.
"""
