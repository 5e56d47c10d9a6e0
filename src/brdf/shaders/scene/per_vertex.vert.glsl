// Under one light, at a corner: what the reflectance says of the luminance of the surface as a whole, per irradiance.
// Interpolated over the face it chooses a shading map's picture [Kautz2004, section 4.1].

out float average;

const float LEAST_COSINE = 0.01;  // of the view: on outlines some corners of a visible face are turned away

void main() {
    int texel = place_corner();
    vec3 p = list_texel(mesh_faces, texel).xyz, normal = list_texel(mesh_faces, texel + 3).xyz;
    vec3 tangent = normalize(cross(abs(normal.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), normal));
    mat3 frame = mat3(tangent, cross(normal, tangent), normal);
    vec3 wi = normalize(light_at(0, p).toward * frame);
    vec3 wo = normalize(camera_parallel ? camera_frame[2] : camera_position - p) * frame;
    wo = normalize(vec3(wo.xy, max(wo.z, LEAST_COSINE)));
    average = dot(MATERIAL(wi, wo, vec2(0.0)), vec3(0.2126, 0.7152, 0.0722)) * COSINE(wi.z);
}
