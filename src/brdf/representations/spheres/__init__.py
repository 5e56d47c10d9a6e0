"""Pictures of spheres as a representation of isotropic reflectance."""
