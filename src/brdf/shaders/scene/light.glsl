// Lights without extent.

const int MOST_LIGHTS = 8;
uniform int light_count;
uniform vec4 light_place[MOST_LIGHTS];       // unit direction to the light and 0, or its position and 1
uniform vec3 light_irradiance[MOST_LIGHTS];  // on a surface that faces it; of a position, at distance 1

struct Light {
    vec3 toward;      // unit vector from the point
    float distance;   // 0: the point is where the light is, and gets nothing from it
    vec3 irradiance;  // on a surface that faces it
};

// Light number i as seen from a point.
Light light_at(int i, vec3 at) {
    if (light_place[i].w == 0.0) return Light(light_place[i].xyz, 1e30, light_irradiance[i]);
    vec3 offset = light_place[i].xyz - at;
    float distance = length(offset);
    if (distance == 0.0) return Light(vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0));
    return Light(offset / distance, distance, light_irradiance[i] / (distance * distance));
}
