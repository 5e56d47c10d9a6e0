void main() { place_corner(); }
