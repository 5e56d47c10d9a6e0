"""Photographs of a flat sample under a lamp that moves along an arc."""
