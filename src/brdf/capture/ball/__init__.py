"""Photographs of a ball -> pictures of spheres and a slice stack."""
