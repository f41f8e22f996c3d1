"""Studies: from one design to a million, on one machine or many.

A study file names axes, fixed values and models; each point of it is a trim or an optimum. Points are worked off in
chunks of neighbours, so that each trim starts from the one before; chunks run on Dask, and each is a Parquet file as
soon as it is done. What a chunk answers depends on the study file alone, not on who works it off or when.
"""
