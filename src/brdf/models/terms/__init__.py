"""The parts microfacet models are made of: slope distributions, masking, Fresnel reflectance."""
