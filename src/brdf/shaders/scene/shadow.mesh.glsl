// Whether the mesh stands between a point and a light: rays through a tree of boxes, in depth-first order, so that no
// stack is needed. Two texels a node: (least corner, first face of a leaf, or -1 within the tree), (greatest corner,
// number of faces of a leaf, or the node to go on with where the box is missed).

uniform sampler2D mesh_nodes;
uniform int mesh_node_count;  // 0: nothing casts shadows

bool meets_box(vec3 origin, vec3 inverse, vec3 least, vec3 greatest, float reach) {
    vec3 a = (least - origin) * inverse, b = (greatest - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    return max(max(near.x, near.y), max(near.z, 0.0)) <= min(min(far.x, far.y), min(far.z, reach));
}

bool meets_face(vec3 origin, vec3 ray, int face, float reach) {
    vec3 p = list_texel(mesh_faces, face * 6).xyz;
    vec3 edge_1 = list_texel(mesh_faces, face * 6 + 1).xyz - p, edge_2 = list_texel(mesh_faces, face * 6 + 2).xyz - p;
    vec3 across = cross(ray, edge_2), from = origin - p;
    float volume = dot(edge_1, across);
    if (volume == 0.0) return false;
    vec3 turned = cross(from, edge_1);
    float u = dot(from, across) / volume, v = dot(ray, turned) / volume, t = dot(edge_2, turned) / volume;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t < reach;
}

bool shadowed(vec3 origin, vec3 ray, float distance) {
    vec3 inverse = 1.0 / mix(ray, vec3(1e-20), equal(ray, vec3(0.0)));
    float reach = max(distance - 2.0 * mesh_nudge, 0.0);
    for (int node = 0; node < mesh_node_count;) {
        vec4 least = list_texel(mesh_nodes, 2 * node), greatest = list_texel(mesh_nodes, 2 * node + 1);
        bool met = meets_box(origin, inverse, least.xyz, greatest.xyz, reach);
        int first = int(least.w), last = first + int(greatest.w);
        if (first >= 0 && met)
            for (int i = first; i < last; i++)
                if (meets_face(origin, ray, i, reach)) return true;
        node = met || first >= 0 ? node + 1 : int(greatest.w);
    }
    return false;
}
