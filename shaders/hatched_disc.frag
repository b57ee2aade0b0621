#version 330 core
// A disc as in disc.frag, hatched in the colour of the rim. A separate shader, so that other discs are not slowed down.
in vec2 offset;
flat in float radius;
flat in vec4 fill_colour;
flat in vec4 rim_colour;

out vec4 colour;  // premultiplied alpha

const float rim_width = 0.18;  // share of the radius
const float widest_rim = 2.0;  // px

// Coverage of a pixel by a disc of radius r (px).
float coverage(float r, float distance) { return clamp(r - distance + 0.5, 0.0, 1.0); }

// Coverage of this pixel by diagonal lines, which continue from disc to disc.
float hatch() {
  float period = max(0.8 * radius, 3.0);
  float across = (gl_FragCoord.x + gl_FragCoord.y) * 0.70710678;
  float distance = abs(fract(across / period) - 0.5) * period;
  return clamp(0.15 * period - distance + 0.5, 0.0, 1.0);
}

void main() {
  float distance = length(offset);
  float outer = coverage(radius, distance);
  float inner = coverage(radius - min(rim_width * radius, widest_rim), distance);
  inner *= 1.0 - hatch();
  colour = inner * fill_colour + (outer - inner) * rim_colour;
}
