#version 330 core
// A disc with a soft edge, from its signed distance, and a rim that makes a white disc visible on a white background.
in vec2 offset;
flat in float radius;
flat in vec4 fill_colour;
flat in vec4 rim_colour;

out vec4 colour;  // premultiplied alpha

const float rim_width = 0.18;  // share of the radius
const float widest_rim = 2.0;  // px

// Coverage of a pixel by a disc of radius r (px).
float coverage(float r, float distance) { return clamp(r - distance + 0.5, 0.0, 1.0); }

void main() {
  float distance = length(offset);
  float outer = coverage(radius, distance);
  float inner = coverage(radius - min(rim_width * radius, widest_rim), distance);
  colour = inner * fill_colour + (outer - inner) * rim_colour;
}
