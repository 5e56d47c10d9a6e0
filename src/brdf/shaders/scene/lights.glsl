// What lights reflect. MATERIAL(wi, wo, uv) is the reflectance f [1/sr], COSINE(z) its cosine factor.

// What of a finite value counts: no pixel is ever infinite or undefined.
vec3 finite(vec3 value) { return mix(vec3(0.0), value, lessThan(abs(value), vec3(1e30))); }

bool reaches(vec3 wi) { return TRANSMITS || wi.z > 0.0; }

// Light that comes through the surface from behind is not shadowed: the shape counts as a thin sheet there.
bool visible(Point point, vec3 wi, vec3 world, float distance) {
    return wi.z <= 0.0 || !shadowed(point.at, world, distance);
}

vec3 from_lights(Point point) {
    vec3 radiance = vec3(0.0);
    for (int i = 0; i < light_count; i++) {
        Light light = light_at(i, point.at);
        vec3 wi = normalize(light.toward * point.frame);
        if (light.distance == 0.0 || !reaches(wi)) continue;
        vec3 value = finite(MATERIAL(wi, point.wo, point.uv) * light.irradiance * COSINE(wi.z));
        if (value != vec3(0.0) && visible(point, wi, light.toward, light.distance)) radiance += value;
    }
    return radiance;
}
