"""Many designs: sweeps and the power waterfall (`series`), and studies of up to a million on a machine or a cluster.

A study file names axes, fixed values and models; each point is a trim or an optimum. Points are computed in chunks of
neighbours, so that each trim starts from the previous one. Chunks run on any executor, and each is stored as a Parquet
file as soon as it is finished. The result of a chunk depends on the study file only.
"""
