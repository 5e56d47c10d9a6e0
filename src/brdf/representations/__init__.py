"""Reflectances held as arrays: gridded tables and their presets."""
