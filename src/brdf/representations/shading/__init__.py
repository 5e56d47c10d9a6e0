"""Photographs of a flat sample as a map of shades, compressed and enlarged."""
