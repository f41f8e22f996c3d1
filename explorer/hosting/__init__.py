"""The server around the pages: allowed hosts, limits, places, the served page, and viser's private parts."""
