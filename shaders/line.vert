#version 330 core
// One quad per straight line with round ends.
layout(location = 0) in vec4 ends;  // x, y of both ends, m, in the frame of the bed
layout(location = 1) in float half_width;  // m
layout(location = 2) in vec4 look;

uniform vec2 size;    // size of the picture, px
uniform vec3 camera;  // px per m; origin of the bed, px from the left and from the top
uniform vec2 turn;    // cosine and sine of the clockwise rotation of the bed
uniform vec4 clip;    // visible part of a rotated bed: x_min, x_max, y_min, y_max, m

out vec2 place;             // coordinates along and across the line, px
flat out float line_length;  // px
flat out float reach;        // half width, px
flat out vec4 ink;

const float thinnest = 0.35;  // px; thinner lines are invisible

vec2 project(vec2 p) { return camera.yz + camera.x * vec2(turn.x * p.x + turn.y * p.y, turn.y * p.x - turn.x * p.y); }

void main() {
  vec2 from = project(ends.xy);
  vec2 along = project(ends.zw) - from;
  line_length = length(along);
  vec2 direction = line_length > 0.0 ? along / line_length : vec2(1.0, 0.0);
  reach = max(camera.x * half_width, thinnest);
  ink = vec4(look.rgb * look.a, look.a);
  float border = reach + 0.5;
  place.x = (gl_VertexID & 1) == 0 ? -border : line_length + border;
  place.y = (gl_VertexID >> 1) == 0 ? -border : border;
  vec2 position = from + place.x * direction + place.y * vec2(-direction.y, direction.x);
  gl_Position = vec4(position / size * 2.0 - 1.0, 0.0, 1.0);
  vec2 back = (position - camera.yz) / camera.x;
  vec2 bed = vec2(turn.x * back.x + turn.y * back.y, turn.y * back.x - turn.x * back.y);
  gl_ClipDistance[0] = bed.x - clip.x;
  gl_ClipDistance[1] = clip.y - bed.x;
  gl_ClipDistance[2] = bed.y - clip.z;
  gl_ClipDistance[3] = clip.w - bed.y;
}
