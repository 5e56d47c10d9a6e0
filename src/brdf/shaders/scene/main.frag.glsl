// What a material reflects towards the camera: linear radiance, and 1 where the shape covers the sample. With
// LIGHTS_ALONE defined there is no light from all around, and a smaller program.
out vec4 colour;

void main() {
    Point point = surface();
    if (point.missed) discard;
    colour = vec4(from_lights(point), 1.0);
#ifndef LIGHTS_ALONE
    colour.rgb += from_environment(point);
#endif
}
