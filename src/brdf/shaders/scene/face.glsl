// A mesh: six texels a face, (corner, u) for its three corners, then (normal there, v).

uniform sampler2D mesh_faces;
uniform bool mesh_has_uv;
uniform float mesh_nudge;  // by which rays start off the surface

vec3 unit(vec3 a) { float l = length(a); return l > 0.0 ? a / l : vec3(0.0); }

// On the smooth surface that the normals describe, not in the face: there no facet shadows its neighbour [Hanika2021].
// `weights` are those of the second and third corner.
Point point_on(int face, vec2 weights, vec3 ray) {
    vec3 b = vec3(1.0 - weights.x - weights.y, weights);
    vec4 p[3], q[3];
    for (int c = 0; c < 3; c++) {
        p[c] = list_texel(mesh_faces, face * 6 + c);
        q[c] = list_texel(mesh_faces, face * 6 + 3 + c);
    }
    vec3 edge_1 = p[1].xyz - p[0].xyz, edge_2 = p[2].xyz - p[0].xyz;
    vec3 at = b.x * p[0].xyz + b.y * p[1].xyz + b.z * p[2].xyz;
    vec3 flat_normal = unit(cross(edge_1, edge_2));
    vec3 smooth_normal = unit(b.x * q[0].xyz + b.y * q[1].xyz + b.z * q[2].xyz);
    if (dot(smooth_normal, smooth_normal) < 0.5) smooth_normal = flat_normal;
    if (dot(flat_normal, smooth_normal) < 0.0) flat_normal = -flat_normal;
    float side = dot(flat_normal, ray) < 0.0 ? 1.0 : -1.0;  // faces have the same material on both sides
    vec3 lifted = at;
    for (int c = 0; c < 3; c++) {
        vec3 normal = q[c].xyz * side;
        lifted -= b[c] * min(dot(at - p[c].xyz, normal), 0.0) * normal;
    }
    vec3 tangent = vec3(0.0);
    vec2 uv = vec2(0.0);
    if (mesh_has_uv) {
        vec2 t0 = vec2(p[0].w, q[0].w), t1 = vec2(p[1].w, q[1].w) - t0, t2 = vec2(p[2].w, q[2].w) - t0;
        uv = t0 + b.y * t1 + b.z * t2;
        float turn = t1.x * t2.y - t2.x * t1.y >= 0.0 ? 1.0 : -1.0;
        tangent = unit(turn * (t2.y * edge_1 - t1.y * edge_2));
    }
    return in_frame(lifted + mesh_nudge * side * flat_normal, smooth_normal * side, tangent, ray, uv);
}
