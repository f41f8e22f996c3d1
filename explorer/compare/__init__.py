"""A and B: what is pinned, and both side by side."""
