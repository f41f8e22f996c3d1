"""Text of the page: tooltips, units, read-outs, status, names of designs, and why power changed."""
