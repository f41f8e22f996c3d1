"""The browser page: widgets → `Design` → `solve` → `Solution` → pictures, plots, read-outs.

Modules that make arrays, text and decisions know no viser; `app`, `session`, `scene`, `overlays`, `camera`, `charts`,
`controls`, the `*_panel`s, `actuator_controls`, `actuator_scene` and `viser_compat` do. Long work goes the same way
round by processes: wishes → `Search` → `tasks` in `jobs` → `search_run` → frames, charts, words. `session` shows a
search's designs in place of the sliders' until they are applied or discarded.

World axes: x aft (ψ = 0), y to starboard (ψ = 90°, the advancing side), z up, in metres, origin at the rotor centre.
"""
