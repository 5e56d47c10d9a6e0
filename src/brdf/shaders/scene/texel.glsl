// Number `index` of the texels of a texture that holds a list, row by row, by its centre: the filter is NEAREST.
const int LIST_WIDTH_BITS = 11;  // rows of 2048 texels, which every card takes; a shorter list is one row

vec4 list_texel(sampler2D list, int index) {
    ivec2 i = ivec2(index & ((1 << LIST_WIDTH_BITS) - 1), index >> LIST_WIDTH_BITS);
    return textureLod(list, (vec2(i) + 0.5) / vec2(textureSize(list, 0)), 0.0);
}
