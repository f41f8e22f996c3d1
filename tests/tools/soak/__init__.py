"""`python -m tests.tools.soak`: many browsers drag a slider for minutes; reports delays, lost updates and memory.

`wire` speaks the page's protocol, `visitor` is a browser without a screen, `run` starts a server and sends visitors,
`figures` judges what they saw: no lost update, flat memory, how long an edit took to be seen.
"""
