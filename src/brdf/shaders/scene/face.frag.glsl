// The number of the face that is seen: see surface.seen.glsl.
flat in int face;
out vec4 seen;

void main() { seen = vec4(float(face + 1), 0.0, 0.0, 1.0); }
