// A pinhole camera, or an orthographic one, as brdf.render.Camera: pixels count from the top left corner.

uniform vec3 camera_position;
uniform mat3 camera_frame;   // columns: to the right, up, backwards (from the target to the camera)
uniform float camera_half;   // tangent of half the vertical field of view; orthographic: half the picture's height
uniform bool camera_parallel;
uniform vec2 picture_size;   // in pixels
uniform vec2 sample_place;   // within the pixel, from its top left corner; (0.5, 0.5) is the middle

// The direction from the camera of the light that arrives from p.
vec3 camera_ray(vec3 p) {
    return camera_parallel ? -camera_frame[2] : normalize(p - camera_position);
}
