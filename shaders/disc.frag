#version 330 core
// A disc with a soft edge, from its signed distance, and an outline that shows a white disc on white ground.
in vec2 offset;
flat in float radius;
flat in vec2 look;

out vec4 colour;

const float outline_width = 0.18;  // of the radius
const float widest_outline = 2.0;  // px
const float outline_shade = 0.45;
const float hatch_shade = 0.75;

// Coverage of a pixel by a disc of that radius, px.
float coverage(float r, float distance) { return clamp(r - distance + 0.5, 0.0, 1.0); }

// Diagonal lines that run on from disc to disc; the share of this pixel that they cover.
float hatch() {
  float period = max(0.8 * radius, 3.0);
  float across = (gl_FragCoord.x + gl_FragCoord.y) * 0.70710678;
  float distance = abs(fract(across / period) - 0.5) * period;
  return clamp(0.15 * period - distance + 0.5, 0.0, 1.0);
}

void main() {
  float distance = length(offset);
  float outer = coverage(radius, distance);
  if (outer <= 0.0) discard;
  float inner = coverage(radius - min(outline_width * radius, widest_outline), distance);
  bool hatched = look.y > 0.5;
  float fill = hatched ? hatch_shade * hatch() : look.x;
  float rim = hatched ? hatch_shade : max(look.x, outline_shade);
  float shade = mix(rim, fill, inner / outer);
  colour = vec4(vec3(1.0 - shade), outer);
}
