// One more sample, for the sum of them all: drawn with blending that adds.
uniform sampler2D drawn;
out vec4 colour;

void main() { colour = texelFetch(drawn, ivec2(gl_FragCoord.xy), 0); }
