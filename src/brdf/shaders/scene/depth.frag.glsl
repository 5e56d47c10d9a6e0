// Depth is written as it is.
void main() {}
