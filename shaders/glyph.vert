#version 330 core
// Triangles of the furniture: glyphs of the atlas, and filled areas (u < 0).
layout(location = 0) in vec2 position;  // px from the left and from the top
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 look;

uniform vec2 size;  // size of the picture, px

out vec2 place;
out vec4 ink;

void main() {
  place = texel;
  ink = vec4(look.rgb * look.a, look.a);
  gl_Position = vec4(position / size * 2.0 - 1.0, 0.0, 1.0);
}
