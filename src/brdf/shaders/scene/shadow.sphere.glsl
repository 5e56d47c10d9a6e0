// The sphere casts no shadow on itself above any point's horizon.
bool shadowed(vec3 origin, vec3 ray, float distance) { return false; }
