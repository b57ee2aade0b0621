#version 330 core
// One triangle per disc, around a circle that is half a pixel larger to include the soft edge.
// A triangle covers a third more pixels than a square, but in software rendering a second triangle costs more.
layout(location = 0) in vec3 disc;  // centre x, y and radius, m, in the frame of the bed
layout(location = 1) in vec4 fill;
layout(location = 2) in vec4 rim;

uniform vec2 size;    // size of the picture, px
uniform vec3 camera;  // px per m; origin of the bed, px from the left and from the top
uniform vec2 turn;    // cosine and sine of the clockwise rotation of the bed
uniform vec4 clip;    // visible part of a rotated bed: x_min, x_max, y_min, y_max, m

out vec2 offset;        // position relative to the centre, px
flat out float radius;  // px
flat out vec4 fill_colour;  // premultiplied alpha, as for all output colours
flat out vec4 rim_colour;

void main() {
  vec2 corner = gl_VertexID == 0 ? vec2(0.0, -2.0) : vec2(gl_VertexID == 1 ? -1.7320508 : 1.7320508, 1.0);
  vec2 centre = camera.yz + camera.x * vec2(turn.x * disc.x + turn.y * disc.y, turn.y * disc.x - turn.x * disc.y);
  radius = camera.x * disc.z;
  offset = corner * (radius + 0.5);
  fill_colour = vec4(fill.rgb * fill.a, fill.a);
  rim_colour = vec4(rim.rgb * rim.a, rim.a);
  // Row 0 of the target is the top of the picture.
  gl_Position = vec4((centre + offset) / size * 2.0 - 1.0, 0.0, 1.0);
  vec2 place = disc.xy + vec2(turn.x * offset.x + turn.y * offset.y, turn.y * offset.x - turn.x * offset.y) / camera.x;
  gl_ClipDistance[0] = place.x - clip.x;
  gl_ClipDistance[1] = clip.y - place.x;
  gl_ClipDistance[2] = place.y - clip.z;
  gl_ClipDistance[3] = clip.w - place.y;
}
