// Where light is reflected, and in which frame.
struct Point {
    vec3 at;      // in the world; light is sought from here
    mat3 frame;   // columns: tangent, bitangent, normal; the normal is on the viewer's side
    vec3 wo;      // unit direction to the viewer in the frame, wo.z > 0
    vec2 uv;
    bool missed;
};

const float GRAZING = 0.01;  // least cosine between normal and view: interpolated normals bend away beyond the horizon

vec3 orthogonal(vec3 a, vec3 n) { return a - dot(a, n) * n; }

// The point's frame and wo. The tangent need not be orthogonal yet; without a usable one the circles of latitude serve.
Point in_frame(vec3 at, vec3 normal, vec3 tangent, vec3 ray, vec2 uv) {
    float slant = dot(normal, -ray);
    if (slant < GRAZING) normal = normalize(normal - (GRAZING - slant) * ray);
    tangent = orthogonal(tangent, normal);
    if (dot(tangent, tangent) < 1e-6) {
        tangent = vec3(normal.z, 0.0, -normal.x);
        if (dot(tangent, tangent) < 1e-6) tangent = orthogonal(vec3(1.0, 0.0, 0.0), normal);
    }
    tangent = normalize(tangent);
    mat3 frame = mat3(tangent, cross(normal, tangent), normal);
    vec3 wo = -ray * frame;
    return Point(at, frame, normalize(vec3(wo.xy, max(wo.z, 1e-4))), uv, false);
}
