// The angle of (x, y) from +x in (-pi, pi], to 4e-7: the functions that drivers have are off by up to 4e-4.
float angle_of(float y, float x) {
    float across = abs(y), along = abs(x), large = max(across, along), small = min(across, along);
    bool is_diagonal = small > 0.41421356 * large;
    float t = (is_diagonal ? small - large : small) / max(is_diagonal ? small + large : large, 1e-37), z = t * t;
    float angle = t * (1.0 + z * (-0.33332797 + z * (0.19974394 + z * (-0.1385136 + z * 0.079845696))));
    angle = is_diagonal ? angle + 0.78539819 : angle;
    angle = across > along ? 1.5707964 - angle : angle;
    angle = x < 0.0 ? 3.1415927 - angle : angle;
    return y < 0.0 ? -angle : angle;
}
