// What a material reflects towards the camera: linear radiance, and 1 where the shape covers the sample.
out vec4 colour;

void main() {
    Point point = surface();
    if (point.missed) discard;
    colour = vec4(from_lights(point) + from_environment(point), 1.0);
}
