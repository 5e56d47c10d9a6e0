// The ray through the sample's place in the pixel.
void pixel_ray(out vec3 origin, out vec3 ray) {
    vec2 pixel = vec2(gl_FragCoord.x - 0.5, picture_size.y - gl_FragCoord.y - 0.5) + sample_place;
    vec2 place = (2.0 * pixel - picture_size) / picture_size.y * vec2(camera_half, -camera_half);
    vec3 across = camera_frame * vec3(place, 0.0);
    origin = camera_position + (camera_parallel ? across : vec3(0.0));
    ray = camera_parallel ? -camera_frame[2] : normalize(across - camera_frame[2]);
}
