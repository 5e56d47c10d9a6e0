// Lights without extent. MATERIAL(wi, wo, uv) is the reflectance f [1/sr], COSINE(z) its cosine factor.

const int MOST_LIGHTS = 8;
uniform int light_count;
uniform vec4 light_place[MOST_LIGHTS];       // unit direction to the light and 0, or its position and 1
uniform vec3 light_irradiance[MOST_LIGHTS];  // on a surface that faces it; of a position, at distance 1

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
        vec3 offset = light_place[i].xyz - light_place[i].w * point.at;
        float distance = light_place[i].w > 0.0 ? length(offset) : 1e30;
        if (distance == 0.0) continue;
        vec3 world = light_place[i].w > 0.0 ? offset / distance : offset;
        vec3 wi = normalize(world * point.frame);
        if (!reaches(wi)) continue;
        vec3 irradiance = light_irradiance[i] / (light_place[i].w > 0.0 ? distance * distance : 1.0);
        vec3 value = finite(MATERIAL(wi, point.wo, point.uv) * irradiance * COSINE(wi.z));
        if (value != vec3(0.0) && visible(point, wi, world, distance)) radiance += value;
    }
    return radiance;
}
