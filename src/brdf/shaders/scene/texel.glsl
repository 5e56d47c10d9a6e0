// Number `index` of the texels of a texture that holds a list, row by row.
vec4 mesh_texel(sampler2D list, int index) {
    int width = textureSize(list, 0).x;
    return texelFetch(list, ivec2(index % width, index / width), 0);
}
