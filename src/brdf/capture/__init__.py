"""Photographs to representations: pictures of a coated sphere, pictures of a flat sample under a moving lamp."""
