"""Panels of the page as functions: from what is known now to what stands on the page. No viser, no threads, no tabs."""
