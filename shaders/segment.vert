#version 330 core
// One quad for each straight line with round ends.
layout(location = 0) in vec4 ends;   // x, y of both ends, px from the left and from the top
layout(location = 1) in vec2 style;  // half width, px; shade

uniform vec2 size;  // of the picture, px

out vec2 place;             // along the line and across it, px
flat out float line_length;  // px
flat out vec2 look;

void main() {
  vec2 along = ends.zw - ends.xy;
  line_length = length(along);
  vec2 direction = line_length > 0.0 ? along / line_length : vec2(1.0, 0.0);
  float reach = style.x + 0.5;
  place.x = (gl_VertexID & 1) == 0 ? -reach : line_length + reach;
  place.y = (gl_VertexID >> 1) == 0 ? -reach : reach;
  look = style;
  vec2 position = ends.xy + place.x * direction + place.y * vec2(-direction.y, direction.x);
  gl_Position = vec4(position / size * 2.0 - 1.0, 0.0, 1.0);
}
