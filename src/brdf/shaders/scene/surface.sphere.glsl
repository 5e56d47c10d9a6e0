// The exact unit sphere about the origin, met by the ray of the pixel.

const float PI = 3.14159265;

Point surface() {
    vec3 origin, ray;
    pixel_ray(origin, ray);
    float nearest = dot(origin, ray);
    vec3 offset = origin - nearest * ray;  // its length decides; the usual discriminant would cancel far away
    float closest = dot(offset, offset), reach = -nearest - sqrt(max(1.0 - closest, 0.0));
    vec3 normal = normalize(origin + reach * ray);
    vec2 uv = vec2(fract(angle_of(normal.x, normal.z) / (2.0 * PI)), 1.0 - angle_of(length(normal.xz), normal.y) / PI);
    Point point = in_frame(normal, normal, vec3(0.0), ray, uv);
    point.missed = closest > 1.0 || reach <= 0.0;
    return point;
}
