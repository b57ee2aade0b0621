#version 330 core
// One quad for each disc, half a pixel larger than the disc, so that its soft edge fits.
layout(location = 0) in vec3 disc;   // centre x, y and radius, m, in the frame of the bed
layout(location = 1) in vec2 style;  // shade; hatched or not

uniform vec2 size;    // of the picture, px
uniform vec3 camera;  // px per m; where the bed's origin lies, px from the left and from the top

out vec2 offset;        // from the centre, px
flat out float radius;  // px
flat out vec2 look;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  vec2 centre = camera.yz + camera.x * vec2(disc.x, -disc.y);
  radius = camera.x * disc.z;
  offset = corner * (radius + 0.5);
  look = style;
  // Row 0 of the target is the top of the picture.
  gl_Position = vec4((centre + offset) / size * 2.0 - 1.0, 0.0, 1.0);
}
