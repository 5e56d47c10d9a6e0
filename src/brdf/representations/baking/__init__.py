"""Reflectance -> table: at the nodes, by least squares, within a budget of bytes."""
