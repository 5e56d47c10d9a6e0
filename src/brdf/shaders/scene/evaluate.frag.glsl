// f(wi, wo) [1/sr] for a list of directions, one a pixel.
uniform sampler2D given_wi, given_wo;  // unit vectors; u and v of the place in their last components
out vec4 value;

void main() {
    ivec2 i = ivec2(gl_FragCoord.xy);
    vec4 wi = texelFetch(given_wi, i, 0), wo = texelFetch(given_wo, i, 0);
    value = vec4(MATERIAL(wi.xyz, wo.xyz, vec2(wi.w, wo.w)), 1.0);
}
