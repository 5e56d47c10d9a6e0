// The corners of a mesh's triangles, three vertices a face and no vertex buffer.

uniform sampler2D mesh_faces;  // see surface.mesh.glsl
uniform vec2 camera_depths;    // nearest and farthest distance along the view that the mesh reaches

invariant gl_Position;  // the pass for depth alone comes to the same
flat out int face;
out vec2 weights;  // of the second and third corner

// The corner's place on the screen; returns its texel.
int place_corner() {
    int corner = gl_VertexID % 3;
    face = gl_VertexID / 3;
    weights = vec2(corner == 1, corner == 2);
    vec3 p = list_texel(mesh_faces, face * 6 + corner).xyz;
    vec3 seen = (p - camera_position) * camera_frame;
    float w = camera_parallel ? 1.0 : -seen.z;
    float near = camera_depths.x, far = camera_depths.y;
    float depth = camera_parallel ? (-2.0 * seen.z - near - far) / (far - near)
                                  : ((near + far) * -seen.z - 2.0 * near * far) / (far - near);
    vec2 place = seen.xy / camera_half * vec2(picture_size.y / picture_size.x, 1.0);
    vec2 shift = (0.5 - sample_place) * vec2(2.0, -2.0) / picture_size;  // the sample comes to the pixel's middle
    gl_Position = vec4(place + shift * w, depth, w);
    return face * 6 + corner;
}
