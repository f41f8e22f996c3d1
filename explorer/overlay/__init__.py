"""The bridge between Python and the page's own scripts."""
