#version 330 core
in vec2 place;
flat in float line_length;
flat in float reach;
flat in vec4 ink;

out vec4 colour;

void main() {
  float distance = length(vec2(place.x - clamp(place.x, 0.0, line_length), place.y));
  colour = ink * clamp(reach - distance + 0.5, 0.0, 1.0);
}
