// Ids alone, for images whose colors are rendered on their own.
flat in uint id;

layout(location = 1) out uint instance;

void main() { instance = id; }
