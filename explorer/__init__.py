"""The browser page: widgets → `Design` → `solve` → `Solution` → pictures, plots, read-outs.

Modules that make arrays and text (`colours`, `fields`, `polar`, `disk_image`, `outlines`, `meshes`, `poses`, `view`,
`plots`, `readout`, `state`, `worker`) know no viser; `scene`, `charts`, `controls`, `session`, `app` and
`viser_compat` do. Of the Actuator tab (`actuator_*`) only its `panel`, `controls` and `scene` do.

World axes: x aft (ψ = 0), y to starboard (ψ = 90°, the advancing side), z up, in metres, origin at the rotor centre.
"""
