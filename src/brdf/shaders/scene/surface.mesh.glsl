// A mesh, shaded while its triangles are drawn.

flat in int face;
in vec2 weights;

Point surface() {
    vec3 p = list_texel(mesh_faces, face * 6).xyz;
    vec3 edge_1 = list_texel(mesh_faces, face * 6 + 1).xyz - p, edge_2 = list_texel(mesh_faces, face * 6 + 2).xyz - p;
    return point_on(face, weights, camera_ray(p + weights.x * edge_1 + weights.y * edge_2));
}
