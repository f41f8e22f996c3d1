"""`python -m explorer soak`: many browsers at once, each dragging, for minutes; what it did to them and to the server.

`wire` speaks the page's protocol, `visitor` is a browser without a screen, `run` starts a server and sends visitors,
`figures` judges what they saw: no lost update, flat memory, how long an edit took to be seen.
"""
