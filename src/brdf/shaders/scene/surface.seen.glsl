// A mesh, shaded once a pixel: its triangles have been drawn already, and left their numbers. So small triangles cost no
// more than large ones, and the point is where the ray meets the triangle, not where a rasteriser's grid has it.

uniform sampler2D seen_faces;  // 1 + the number of the face, 0 for none

Point surface() {
    vec3 origin, ray;
    pixel_ray(origin, ray);
    int face = int(texelFetch(seen_faces, ivec2(gl_FragCoord.xy), 0).x + 0.5) - 1;
    bool missed = face < 0;
    if (missed) face = 0;
    vec3 p = list_texel(mesh_faces, face * 6).xyz;
    vec3 edge_1 = list_texel(mesh_faces, face * 6 + 1).xyz - p, edge_2 = list_texel(mesh_faces, face * 6 + 2).xyz - p;
    vec3 across = cross(ray, edge_2), from = origin - p;
    float volume = dot(edge_1, across);
    vec2 weights = volume == 0.0 ? vec2(1.0 / 3.0) : vec2(dot(from, across), dot(ray, cross(from, edge_1))) / volume;
    weights = clamp(weights, 0.0, 1.0);  // on outlines the ray may pass the triangle by
    Point point = point_on(face, weights / max(weights.x + weights.y, 1.0), ray);
    point.missed = missed;
    return point;
}
