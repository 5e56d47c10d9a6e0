// Number `index` of the texels of a texture that holds a list, row by row.
const int LIST_WIDTH_BITS = 11;  // rows of 2048 texels, which every card takes; a shorter list is one row

vec4 list_texel(sampler2D list, int index) {
    return texelFetch(list, ivec2(index & ((1 << LIST_WIDTH_BITS) - 1), index >> LIST_WIDTH_BITS), 0);
}
