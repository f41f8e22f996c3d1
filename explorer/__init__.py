"""The browser page: widgets → `Design` → `solve` → `Solution` → pictures, plots, read-outs.

The straight path and what every part shares stands here; each part of the page has a folder. Modules that make arrays,
text and decisions know no viser; those that may are listed in `tests/test_layers.py`. Long work goes the same way round
by processes: wishes → `Search` → `jobs.tasks` in a worker → `search.run` → frames, charts, words. `session` shows a
search's designs in place of the sliders' until they are applied or discarded.

World axes: x aft (ψ = 0), y to starboard (ψ = 90°, the advancing side), z up, in metres, origin at the rotor centre.
"""
