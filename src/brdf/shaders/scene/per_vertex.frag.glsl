// A shading map's picture for the interpolated average. MATERIAL takes that in the place of a direction.

in float average;
out vec4 colour;

void main() {
    Point point = surface();
    Light light = light_at(0, point.at);
    vec3 value = finite(MATERIAL(vec3(0.0, 0.0, 1.0), vec3(average, 0.0, 1.0), point.uv) * light.irradiance);
    colour = vec4(shadowed(point.at, light.toward, light.distance) ? vec3(0.0) : value, 1.0);
}
