#version 330 core
// Triangles of the furniture: glyphs of the atlas, and plain areas (u < 0).
layout(location = 0) in vec2 position;  // px from the left and from the top
layout(location = 1) in vec3 texel;     // u, v; shade

uniform vec2 size;  // of the picture, px

out vec3 look;

void main() {
  look = texel;
  gl_Position = vec4(position / size * 2.0 - 1.0, 0.0, 1.0);
}
