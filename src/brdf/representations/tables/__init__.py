"""Grids of nodes over angles: bases, warps, encodings, filters, and the one class that holds them."""
