#version 330 core
// Triangles of the widgets.
layout(location = 0) in vec2 position;  // px from the left and from the top
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 look;  // straight alpha

uniform vec4 frame;  // left, top, width and height of the viewport, px; height < 0 if row 0 is at the bottom

out vec2 place;
out vec4 ink;

void main() {
  place = texel;
  ink = look;
  vec2 share = (position - frame.xy) / abs(frame.zw) * 2.0 - 1.0;
  gl_Position = vec4(share.x, share.y * sign(frame.w), 0.0, 1.0);
}
